#pragma once
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace sateen::obj {

/// Whether a line ends in a carriage return alone, as on the first Macintoshes.
bool has_lone_returns(std::string_view text);
/// Makes line feeds of such ends.
void end_lines_at_returns(std::string& text);

/// Walks a text by logical lines (a backslash at a line's end joins the next) and by words inside them, and turns a
/// place in the text into line and column. Comments run from a # at the start of a word; the 0x1A of DOS is passed
/// over at the end of the text and at either end of a word. Every pointer stays inside the text that was given.
class Text {
 public:
  Text(std::string_view text, std::string name);

  /// Steps to the next logical line. False at the end of the text.
  bool next_line();
  /// The next word of the current line, empty when there is none.
  std::string_view next_word();
  bool line_too_long() const { return size_t(line_end_ - line_begin_) > longest_line; }

  int line_of(const char* place) const;  ///< only for places in the current logical line
  int line() const { return line_; }     ///< first physical line of the current logical line, from 1
  /// Records an error at `word`, which lies in the current logical line.
  void error(std::string_view word, std::string message, std::string help = {});
  /// The same for a place outside the current line: counts lines from the start of the text.
  void error_anywhere(std::string_view word, std::string message, std::string help = {});
  bool gave_up() const { return errors_.size() >= most_errors; }
  std::vector<Diagnostic>& errors() { return errors_; }

  static constexpr size_t longest_line = size_t(1) << 20;
  static constexpr size_t most_errors = 100;

 private:
  void add(std::string_view word, int line, std::string message, std::string help);

  const char *begin_, *end_;
  const char *line_begin_, *line_end_, *at_;
  int line_ = 0, next_line_ = 1;
  std::string name_;
  std::vector<Diagnostic> errors_;
};

enum class Number { good, not_a_number, not_finite, malformed };

/// A decimal number, nan or inf, also as Microsoft's libraries print them, the whole of `word`. Values too small for
/// a float become 0; too large ones are not_finite.
Number to_float(std::string_view word, float& value);
/// The same for what to_float took for good.
void to_double(std::string_view word, double& value);
/// A decimal integer, the whole of `word`.
bool to_integer(std::string_view word, long long& value);

}  // namespace sateen::obj
