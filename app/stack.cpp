#include "stack.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>

#include "base/error.h"

namespace sateen::app {

namespace {
// A small picture takes 130 to 190 kB.
constexpr rlim_t least = 512 << 10, usual = 8 << 20;
}  // namespace

void provide_stack() {
  rlimit limit{};
  // No limit has the largest number.
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= least) return;
  const rlim_t given = limit.rlim_cur;
  limit.rlim_cur = std::min(usual, limit.rlim_max);
  if (limit.rlim_cur < least || setrlimit(RLIMIT_STACK, &limit) != 0)
    throw OperationError(fmt::format("ulimit -s allows {} kB of stack, expected at least {}\n  help: ulimit -s {}",
                                     given >> 10, least >> 10, usual >> 10));
  // Threads take theirs from the limit at the start of the program.
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return;
  pthread_attr_setstacksize(&attributes, limit.rlim_cur);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
}

}  // namespace sateen::app
