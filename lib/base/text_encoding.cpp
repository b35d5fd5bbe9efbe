#include "base/text_encoding.h"

namespace sateen {

std::string wide_text_complaint(std::string_view text) {
  const std::string expected = ", expected UTF-8 or plain ASCII text";
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) return "is UTF-16 text" + expected;
  if (text.size() >= 4 && text.find('\0') < 4) return "is UTF-16 text, or no text at all" + expected;
  return {};
}

std::string_view without_dos_end(std::string_view text) {
  constexpr std::string_view padding("\x1a\0 \t\r\n", 6);
  const size_t last = text.find_last_not_of(padding);
  const size_t end = text.find('\x1a', last == std::string_view::npos ? 0 : last + 1);
  return end == std::string_view::npos ? text : text.substr(0, end);
}

}  // namespace sateen
