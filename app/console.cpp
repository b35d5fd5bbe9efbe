#include "console.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "base/printable.h"

namespace sateen::app {

Voice voice;

namespace {
// The first failure of standard output; what follows is dropped.
int output_error = 0;

void put_as_it_is(std::FILE* file, std::string_view text, const char* end) {
  errno = 0;
  const bool good = std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fputs(end, file) >= 0 &&
                    std::fflush(file) == 0;
  if (!good && file == stdout && output_error == 0) output_error = errno ? errno : EIO;
}

// Whatever part of a text came out of a file, no control character of it reaches the terminal.
void put(std::FILE* file, std::string_view text, const char* end) {
  put_as_it_is(file, printable(text, true, true), end);
}
}  // namespace

void print_result(std::string_view text) {
  put(stdout, text, text.ends_with('\n') ? "" : "\n");
}
void print_note(std::string_view line) {
  if (voice.verbosity != Verbosity::quiet) put(voice.json ? stderr : stdout, line, "\n");
}
void print_detail(std::string_view line) {
  if (voice.verbosity == Verbosity::detailed) put(stderr, line, "\n");
}
void print_warning(std::string_view line) {
  put(stderr, "warning: ", "");
  put(stderr, line, "\n");
}
void print_progress(std::string_view text) {
  put_as_it_is(stderr, text, "");
}
void print_error(std::string_view text) {
  put(stderr, text, "\n");
}

bool error_is_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

bool finish_output() {
  if (std::fflush(stdout) != 0 && output_error == 0) output_error = errno;
  return output_error == 0 || output_error == EPIPE;
}

}  // namespace sateen::app
