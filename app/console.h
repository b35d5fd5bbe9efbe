#pragma once
#include <string>
#include <string_view>

namespace sateen::app {

/// What the program says goes through here. Results go to standard output; notes, warnings and progress to standard
/// error, so that a result can be piped. With --json, standard output holds the JSON alone. Control characters, which
/// can only come out of files and names, are shown and not obeyed (base/printable.h), but in progress.
enum class Verbosity { quiet, normal, detailed };
struct Voice {
  Verbosity verbosity = Verbosity::normal;
  bool json = false;
};
extern Voice voice;

void print_result(std::string_view text);  ///< always
void print_note(std::string_view line);    ///< unless quiet; to standard error with --json
void print_detail(std::string_view line);  ///< with -v
void print_warning(std::string_view line);
void print_progress(std::string_view text);  ///< to standard error, as it is
void print_error(std::string_view text);     ///< with a line break

bool error_is_terminal();

/// Flushes standard output. False where that failed for another reason than a reader that went away.
bool finish_output();

}  // namespace sateen::app
