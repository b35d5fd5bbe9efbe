#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sateen {

/// How far the reader had come when the text stopped being JSON.
struct JsonProgress {
  enum class Last { nothing, opened, key, value };
  Last last = Last::nothing;
  size_t token_begin = 0, token_end = 0;  ///< the last key, value or bracket that was understood, in bytes
  bool too_large = false;                 ///< a number beyond the range of double
  std::vector<size_t> open;               ///< places of the brackets not yet closed
};

/// What is wrong with the syntax, in words: a range of bytes, found and expected, and a remedy.
struct SyntaxFault {
  size_t begin = 0, end = 0;
  std::string message, help;
};

/// Finds the fault by looking again at the text behind the last token that was understood.
SyntaxFault explain_syntax(std::string_view text, const JsonProgress& progress);

}  // namespace sateen
