#pragma once
#include <atomic>

namespace sateen::app {

/// SIGINT and SIGTERM end the program at once, except inside a StopOnSignal: there they raise `interrupted`, so that
/// what was computed can be written. A second one then ends the program at once. Broken pipes are no signal.
void install_signals();

class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
};

extern std::atomic<bool> interrupted;

/// SIGUSR1 raises this: the picture so far is wanted. Outside a StopOnSignal the signal does nothing.
extern std::atomic<bool> picture_wanted;

/// Number of the signal that raised `interrupted`; 0 while none has.
int signal_received();

}  // namespace sateen::app
