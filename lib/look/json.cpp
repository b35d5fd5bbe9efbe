#include "look/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>

#include "look/json_syntax.h"

namespace sateen {

namespace {

// Hands out the text byte by byte and tells how many bytes were taken: the parser reports values without places.
class CountingIterator {
 public:
  using iterator_category = std::forward_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, size_t* consumed) : at_(at), consumed_(consumed) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*consumed_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  size_t* consumed_;
};

JsonPlace place_of(const JsonDocument& document, size_t begin, size_t end) {
  const auto next = std::upper_bound(document.line_starts.begin(), document.line_starts.end(), begin);
  const size_t line = size_t(next - document.line_starts.begin());
  const size_t line_end = next == document.line_starts.end() ? document.text.size() + 1 : *next;
  return {int(line), int(begin - document.line_starts[line - 1]) + 1,
          end <= line_end ? std::max(int(end - begin), 1) : 1};
}

bool is_number_byte(char c) {
  return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
}

class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(JsonDocument& document, const size_t& consumed) : document_(document), consumed_(consumed) {}

  bool null() override { return add(JsonValue::Kind::null, consumed_ - 4, consumed_) != nullptr; }
  bool boolean(bool value) override {
    JsonValue* added = add(JsonValue::Kind::boolean, consumed_ - (value ? 4 : 5), consumed_);
    if (added) added->boolean = value;
    return added != nullptr;
  }
  bool number_integer(number_integer_t) override { return add_number(); }
  bool number_unsigned(number_unsigned_t) override { return add_number(); }
  bool number_float(number_float_t, const string_t&) override { return add_number(); }
  bool string(string_t& value) override {
    JsonValue* added = add(JsonValue::Kind::text, string_begin(), consumed_);
    if (added) added->text = std::move(value);
    return added != nullptr;
  }
  bool binary(binary_t&) override { return false; }  // JSON text has none
  bool start_object(size_t) override { return open(JsonValue::Kind::object); }
  bool start_array(size_t) override { return open(JsonValue::Kind::list); }
  bool end_array() override { return close(); }
  bool end_object() override {
    report_keys_given_twice(*open_values_.back());
    return close();
  }
  bool key(string_t& name) override {
    const size_t begin = string_begin();
    key_ = std::move(name);
    key_place_ = place_of(document_, begin, consumed_);
    understood(JsonProgress::Last::key, begin, consumed_);
    return true;
  }
  bool parse_error(size_t, const std::string&, const nlohmann::detail::exception& error) override {
    progress_.too_large = error.id == 406;
    const SyntaxFault fault = explain_syntax(document_.text, progress_);
    return refuse(fault.begin, fault.end, fault.message, fault.help);
  }

  const std::vector<Diagnostic>& refusals() const { return refusals_; }

 private:
  bool refuse(size_t begin, size_t end, std::string message, std::string help = {}) {
    refusals_.push_back(
        diagnostic_at(document_, place_of(document_, begin, end), std::move(message), std::move(help)));
    return false;
  }

  void understood(JsonProgress::Last last, size_t begin, size_t end) {
    progress_.last = last;
    progress_.token_begin = begin;
    progress_.token_end = end;
  }

  // The last byte taken is the closing quote. Quotes inside the text stand behind an odd number of backslashes, and
  // no backslash can stand before the opening one.
  size_t string_begin() const {
    for (size_t at = consumed_ - 1;;) {
      at = document_.text.rfind('"', at - 1);
      size_t slashes = at;
      while (slashes > 0 && document_.text[slashes - 1] == '\\') --slashes;
      if ((at - slashes) % 2 == 0) return at;
    }
  }

  bool add_number() {
    // The parser takes one byte behind a number to see that it has ended.
    size_t end = consumed_;
    if (!is_number_byte(document_.text[end - 1])) --end;
    size_t begin = end;
    while (begin > 0 && is_number_byte(document_.text[begin - 1])) --begin;
    JsonValue* added = add(JsonValue::Kind::number, begin, end);
    if (!added) return false;
    added->text = document_.text.substr(begin, end - begin);
    // Not the parser's own value: that one follows the locale and rounds integers above 2^64 in its own way.
    const auto result = std::from_chars(added->text.data(), added->text.data() + added->text.size(), added->number);
    if (result.ec == std::errc::result_out_of_range)
      added->number = 0;  // too large never comes here, see parse_error
    return true;
  }

  JsonValue* add(JsonValue::Kind kind, size_t begin, size_t end) {
    if (++count_ > json_most_values) {
      refuse(begin, end, fmt::format("holds more than {} values", json_most_values));
      return nullptr;
    }
    JsonValue* value = &document_.root;
    if (!open_values_.empty()) value = &open_values_.back()->items.emplace_back();
    value->kind = kind;
    value->place = place_of(document_, begin, end);
    value->key = std::move(key_);
    value->key_place = key_place_;
    key_.clear();
    key_place_ = {};
    understood(JsonProgress::Last::value, begin, end);
    return value;
  }

  bool open(JsonValue::Kind kind) {
    const size_t begin = consumed_ - 1;
    if (open_values_.size() == size_t(json_most_depth))
      return refuse(begin, consumed_, fmt::format("nested deeper than {} levels", json_most_depth));
    JsonValue* value = add(kind, begin, consumed_);
    if (!value) return false;
    // Stays valid: nothing is added beside a value that is still open.
    open_values_.push_back(value);
    progress_.open.push_back(begin);
    understood(JsonProgress::Last::opened, begin, consumed_);
    return true;
  }

  bool close() {
    open_values_.back()->place = place_of(document_, progress_.open.back(), consumed_);
    open_values_.pop_back();
    progress_.open.pop_back();
    understood(JsonProgress::Last::value, consumed_ - 1, consumed_);
    return true;
  }

  void report_keys_given_twice(JsonValue& object) {
    std::vector<size_t> order(object.items.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return object.items[a].key < object.items[b].key; });
    std::vector<size_t> again;
    for (size_t i = 1, first = 0; i < order.size(); ++i) {
      const JsonValue& kept = object.items[order[first]];
      const JsonValue& value = object.items[order[i]];
      if (value.key != kept.key) {
        first = i;
        continue;
      }
      again.push_back(order[i]);
      constexpr size_t most_kept = 1000;
      if (document_.problems.size() < most_kept)
        document_.problems.push_back(
            diagnostic_at(document_, value.key_place,
                          fmt::format("{} is given twice, first at {}:{}", shown_name(value.key), kept.key_place.line,
                                      kept.key_place.column)));
    }
    std::sort(again.begin(), again.end());
    size_t next = 0, to = 0;
    for (size_t from = 0; from < object.items.size(); ++from) {
      if (next < again.size() && again[next] == from) {
        ++next;
        continue;
      }
      if (to != from) object.items[to] = std::move(object.items[from]);
      ++to;
    }
    object.items.resize(to);
  }

  JsonDocument& document_;
  const size_t& consumed_;
  JsonProgress progress_;
  std::vector<JsonValue*> open_values_;
  std::vector<Diagnostic> refusals_;
  std::string key_;
  JsonPlace key_place_;
  int count_ = 0;
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view name) const {
  for (const JsonValue& item : items)
    if (item.key == name) return &item;
  return nullptr;
}

JsonDocument parse_json(std::string text, std::string file) {
  JsonDocument document;
  document.file = std::move(file);
  const auto refuse = [&](std::vector<Diagnostic> all) { throw InputError(InputError::Kind::wrong, std::move(all)); };
  if (text.size() > json_most_bytes)
    refuse(
        {diagnostic_at(document, {}, fmt::format("is {} bytes, expected at most {}", text.size(), json_most_bytes))});
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    refuse({diagnostic_at(document, {}, "is UTF-16 text, expected UTF-8", "save the file as UTF-8")});
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  document.text = std::move(text);
  document.line_starts.push_back(0);
  for (size_t i = 0; i < document.text.size(); ++i)
    if (document.text[i] == '\n') document.line_starts.push_back(std::uint32_t(i + 1));
  // The parser would take a zero byte for the end of the text and never look behind it.
  if (const size_t zero = document.text.find('\0'); zero != std::string::npos)
    refuse({diagnostic_at(document, place_of(document, zero, zero + 1), "found a zero byte, expected text")});

  size_t consumed = 0;
  TreeBuilder builder(document, consumed);
  const char* const begin = document.text.data();
  const char* const end = begin + document.text.size();
  const bool understood =
      nlohmann::json::sax_parse(CountingIterator(begin, &consumed), CountingIterator(end, &consumed), &builder,
                                nlohmann::json::input_format_t::json, true, true);
  if (!understood) {
    std::vector<Diagnostic> all = document.problems;
    all.insert(all.end(), builder.refusals().begin(), builder.refusals().end());
    refuse(std::move(all));
  }
  return document;
}

}  // namespace sateen
