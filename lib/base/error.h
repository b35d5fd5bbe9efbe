#pragma once
#include <exception>
#include <string>
#include <vector>

namespace sateen {

/// One complaint about the user's input: where, what was found, what was expected.
struct Diagnostic {
  std::string file;         ///< path as the user gave it; empty when there is no file
  int line = 0;             ///< from 1; 0 when the place has no line
  int column = 0;           ///< from 1, in bytes
  int width = 1;            ///< characters to underline
  long long offset = -1;    ///< byte offset for binary files; -1 when unused
  std::string message;      ///< found and expected, no trailing period
  std::string source_line;  ///< the offending line, shown under the message
  std::string help;         ///< remedy or nearest name; may be empty
};

/// `file:line:column: error: message`, the source line with carets, and the help line.
std::string to_string(const Diagnostic& diagnostic);

/// Wrong or unreadable input. Thrown by the library, caught once in app/main.
class InputError : public std::exception {
 public:
  enum class Kind {
    wrong,      ///< wrong use or wrong content: exit code 2
    unreadable  ///< missing, not readable, damaged: exit code 3
  };
  explicit InputError(std::string message, std::string help = {}, Kind kind = Kind::wrong);
  InputError(Kind kind, std::vector<Diagnostic> all);

  const char* what() const noexcept override { return text_.c_str(); }

  Kind kind = Kind::wrong;
  std::vector<Diagnostic> diagnostics;  ///< at most 20 are printed

 private:
  std::string text_;
};

/// Something that the input is not to blame for: a full disk, no memory. Exit code 1.
class OperationError : public std::exception {
 public:
  explicit OperationError(std::string message) : text_(std::move(message)) {}
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

}  // namespace sateen
