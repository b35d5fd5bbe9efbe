#pragma once
#include <string>
#include <string_view>

#include "image/file.h"

namespace sateen {

/// One line an attribute, `name = value`, in the order of the names: how PNG, JPEG and TIFF, whose own fields differ,
/// carry them in their description. Text is quoted with \" \\ \n escaped, real numbers always show a point or an e.
std::string to_text(const Attributes& attributes);

/// The reverse. Lines of any other shape are passed over: another program may have added its own.
Attributes attributes_from_text(std::string_view text);

}  // namespace sateen
