#include "look/json_writer.h"

#include <fmt/format.h>

#include <cmath>

#include "base/printable.h"
#include "look/json.h"

namespace sateen {

std::string valid_utf8(std::string_view text) {
  std::string out;
  for (size_t at = 0, length = 0; at < text.size(); at += length ? length : 1) {
    length = character_length(text, at);
    out += length ? text.substr(at, length) : std::string_view("\xef\xbf\xbd");
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
