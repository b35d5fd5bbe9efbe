#pragma once

namespace sateen::app {

/// The whole program behind main: picks the subcommand, runs it, and turns what it throws into a message and an exit
/// code (see `sateen --help`).
int run(int argc, char** argv);

/// Wall clock since the program began.
double seconds_since_start();

}  // namespace sateen::app
