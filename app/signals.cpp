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
  if (guards.load() == 0 || received.exchange(number) != 0) {
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
  action.sa_handler = on_request;
  sigaction(SIGUSR1, &action, nullptr);
  // A reader that went away must not cost a rendered picture.
  std::signal(SIGPIPE, SIG_IGN);
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
