#pragma once

namespace sateen::app {

/// What the program ends with; 128 + the signal's number where one stopped it.
enum ExitCode {
  done = 0,
  failed = 1,               ///< rendering or writing failed
  wrong_use = 2,            ///< of the command line, or a file with wrong content
  unreadable = 3,           ///< a file is missing or damaged
  quality_not_reached = 4,  ///< stopped before the asked quality
  not_finite = 5            ///< --strict, and samples were not finite
};

}  // namespace sateen::app
