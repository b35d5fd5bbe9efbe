#include "look/json_writer.h"

#include <fmt/format.h>

#include <cmath>

#include "look/json.h"

namespace sateen {

namespace {
// Bytes of the UTF-8 sequence that starts `text`; 0 where there is none (RFC 3629, no surrogates, nothing overlong).
size_t sequence_length(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const size_t length = lead >= 0xc2 && lead < 0xe0   ? 2
                        : lead >= 0xe0 && lead < 0xf0 ? 3
                        : lead >= 0xf0 && lead < 0xf5 ? 4
                                                      : 0;
  for (size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  if ((lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xed && byte(1) >= 0xa0) || (lead == 0xf0 && byte(1) < 0x90) ||
      (lead == 0xf4 && byte(1) >= 0x90))
    return 0;
  return length;
}
}  // namespace

std::string valid_utf8(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const size_t length = sequence_length(text);
    out += length ? text.substr(0, length) : std::string_view("\xef\xbf\xbd");
    text.remove_prefix(length ? length : 1);
  }
  return out;
}

void JsonWriter::begin_item() {
  if (after_key_ || open_.empty()) {
    after_key_ = false;
    return;
  }
  Level& level = open_.back();
  text_ += level.empty ? "" : ",";
  if (!flat_) text_ += "\n" + std::string(2 * open_.size(), ' ');
  if (flat_ && !level.empty) text_ += " ";
  level.empty = false;
}

JsonWriter& JsonWriter::put(std::string_view token) {
  begin_item();
  text_ += token;
  return *this;
}

JsonWriter& JsonWriter::open_object() {
  put("{");
  open_.push_back({false, true});
  return *this;
}

JsonWriter& JsonWriter::open_list() {
  put("[");
  open_.push_back({true, true});
  return *this;
}

JsonWriter& JsonWriter::close() {
  const Level level = open_.back();
  open_.pop_back();
  if (!flat_ && !level.empty) text_ += "\n" + std::string(2 * open_.size(), ' ');
  text_ += level.list ? "]" : "}";
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  put(json_quote(valid_utf8(name)) + ": ");
  after_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) {
  return put(json_quote(valid_utf8(text)));
}
JsonWriter& JsonWriter::value(bool b) {
  return put(b ? "true" : "false");
}
JsonWriter& JsonWriter::value(double number) {
  return std::isfinite(number) ? put(fmt::format("{}", number)) : null();
}
JsonWriter& JsonWriter::value(float number) {
  return std::isfinite(number) ? put(fmt::format("{}", number)) : null();
}

}  // namespace sateen
