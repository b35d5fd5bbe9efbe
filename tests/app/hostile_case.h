#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sateen_test {

/// A hostile input, what is done with it, and what the program answered: one text file a case under
/// tests/app/hostile, of sections that begin with a line `=== NAME`:
///
///     === run WORDS        the command; words are separated by blanks and may hold escapes
///     === file NAME        a file that is made first, exactly as it stands below
///     === bytes NAME       the same with line breaks ignored and escapes: \xNN \n \r \t \s (blank) \\ and \{N*TEXT},
///                          TEXT N times
///     === exit CODE        what the program ended with
///     === out, === err     all that it said
///
/// The command runs in the folder of its files. In what it said $SOURCE stands for the source tree and $FOLDER for
/// that folder.
struct HostileCase {
  std::string name;
  std::vector<std::string> run;
  std::vector<std::pair<std::string, std::string>> files;  ///< names and contents
  int exit_code = -1;
  std::string out, err;
  std::string inputs;  ///< the sections that are typed, as they stand in the file
};

/// Throws std::runtime_error with the line of what is not understood.
HostileCase read_hostile_case(const std::filesystem::path& path);

/// The case's text with the answer that is in it.
std::string write_hostile_case(const HostileCase& of);

}  // namespace sateen_test
