#include "signals.h"

#include <unistd.h>
#include <csignal>

namespace sateen::app {

std::atomic<bool> interrupted = false;
std::atomic<bool> picture_wanted = false;

namespace {
std::atomic<int> received = 0;
std::atomic<int> guards = 0;

void on_signal(int number) {
  int none = 0;
  const bool again = !received.compare_exchange_strong(none, number);
  // Closing terminals and schedulers repeat themselves; who types Ctrl-C twice does not want to wait for files.
  if (again && number != SIGINT) return;
  if (guards.load() == 0 || again) {
    static const char message[] = "\nstopped\n";
    const auto ignored = write(STDERR_FILENO, message, sizeof message - 1);
    (void)ignored;
    _exit(128 + number);
  }
  interrupted = true;
}

void on_request(int) {
  if (guards.load() > 0) picture_wanted = true;
}
}  // namespace

void install_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A terminal that closes ends the work as SIGTERM does; under nohup the signal is ignored, and stays so.
  struct sigaction hangup = {};
  if (sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  action.sa_handler = on_request;
  sigaction(SIGUSR1, &action, nullptr);
  // A reader that went away and a limit on the size of files must not cost a rendered picture: what is written then
  // fails with EPIPE or EFBIG, and that is told.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

StopOnSignal::StopOnSignal() {
  ++guards;
}
StopOnSignal::~StopOnSignal() {
  --guards;
}

int signal_received() {
  return received.load();
}

}  // namespace sateen::app
