#pragma once
#include <concepts>
#include <string>
#include <string_view>
#include <vector>

namespace sateen {

/// Writes one JSON text, indented. Calls must nest properly; numbers keep every bit, those that are not finite become
/// null, and bytes that are not UTF-8 become U+FFFD, so that the text is always valid.
///   JsonWriter w; w.open_object().key("spp").value(64).key("files").open_list().value("a.png").close().close();
class JsonWriter {
 public:
  explicit JsonWriter(bool on_one_line = false) : flat_(on_one_line) {}

  JsonWriter& open_object();
  JsonWriter& open_list();
  JsonWriter& close();  ///< the object or list opened last
  JsonWriter& key(std::string_view name);
  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
  JsonWriter& value(bool b);
  JsonWriter& value(double number);
  JsonWriter& value(float number);
  template <std::integral Whole>
  requires(!std::same_as<Whole, bool>) JsonWriter& value(Whole number) { return put(std::to_string(number)); }
  JsonWriter& null() { return put("null"); }
  /// key and value in one.
  template <class Value>
  JsonWriter& member(std::string_view name, const Value& v) {
    return key(name).value(v);
  }

  const std::string& text() const { return text_; }

 private:
  JsonWriter& put(std::string_view token);
  void begin_item();

  struct Level {
    bool list = false, empty = true;
  };
  bool flat_, after_key_ = false;
  std::vector<Level> open_;
  std::string text_;
};

/// The text with every byte that is not part of valid UTF-8 replaced by U+FFFD.
std::string valid_utf8(std::string_view text);

}  // namespace sateen
