#pragma once
#include <atomic>

namespace sateen::app {

/// SIGINT, SIGTERM and SIGHUP (unless it is ignored, as under nohup) end the program at once, except inside a
/// StopOnSignal: there they raise `interrupted`, so that what was computed can be written. A second one then ends the
/// program at once. Broken pipes and files that grow too large are failures of writing, no signals.
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
