#include "base/parallel.h"

#include <immintrin.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <sched.h>
#include <time.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>

// ThreadSanitizer knows nothing of TBB, which is not built with it: this file is not either (lib/CMakeLists.txt), and
// says itself what comes before what. The loop's bodies are watched.
#ifdef SATEEN_SANITIZE_THREAD
extern "C" void __tsan_acquire(void*);
extern "C" void __tsan_release(void*);
#endif

namespace sateen {

namespace {
/// A place in time: what was written before mark() on any thread is seen after follow().
struct Moment {
#ifdef SATEEN_SANITIZE_THREAD
  void mark() {
    __tsan_release(this);
  }
  void follow() {
    __tsan_acquire(this);
  }
#else
  void mark() {}
  void follow() {}
#endif
  char place = 0;
};

struct MarkAtEnd {
  Moment& moment;
  ~MarkAtEnd() { moment.mark(); }
};
struct FollowAtEnd {
  Moment& moment;
  ~FollowAtEnd() { moment.follow(); }
};
}  // namespace

namespace {
/// More workers than processors are allowed on request: tests compare 1, 2, 3 and 8. Embree holds the process to its
/// processors while a scene of its lives; asked for more all the same, TBB says so on standard error.
struct Arena {
  tbb::global_control limit;
  tbb::task_arena arena;

  explicit Arena(int workers)
      : limit(tbb::global_control::max_allowed_parallelism, size_t(workers)),
        arena(int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))) {}
  template <class Body>
  void execute(const Body& body) {
    arena.execute([&] { body(); });
  }
};
}  // namespace

int thread_count(int requested) {
  if (requested > 0) return requested;
  cpu_set_t set;
  CPU_ZERO(&set);
  int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
  if (const char* text = std::getenv("SLURM_CPUS_PER_TASK")) {
    int slurm = 0;
    if (std::from_chars(text, text + std::strlen(text), slurm).ec == std::errc() && slurm > 0)
      count = std::min(count, slurm);
  }
  return std::max(count, 1);
}

void flush_denormals() {
  _mm_setcsr(_mm_getcsr() | 0x8040);
}

void parallel_for(int count, int threads, const std::function<void(int)>& body) {
  if (count <= 0) return;
  const int workers = thread_count(threads);
  if (workers == 1) {
    flush_denormals();
    for (int i = 0; i < count; ++i) body(i);
    return;
  }
  Moment begun, ended;
  begun.mark();
  const FollowAtEnd follow{ended};
  Arena(workers).execute([&] {
    tbb::parallel_for(
        0, count,
        [&](int i) {
          begun.follow();
          const MarkAtEnd mark{ended};
          flush_denormals();
          body(i);
        },
        tbb::simple_partitioner());
  });
}

void in_threads(int threads, const std::function<void()>& body) {
  Arena(thread_count(threads)).execute(body);
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

}  // namespace sateen
