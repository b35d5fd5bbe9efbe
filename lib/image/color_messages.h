#pragma once
#include <functional>
#include <string>

namespace sateen {

/// From now on `hear` gets what OpenColorIO says of a config, such as keys that it does not know, each without a line
/// break; without this OpenColorIO writes it to standard error as it stands in the file. Not while a config is read.
void hear_color_messages(std::function<void(const std::string& message)> hear);

}  // namespace sateen
