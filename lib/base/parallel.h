#pragma once
#include <functional>

namespace sateen {

/// Threads to use: `requested`, or where that is 0 the smallest of the processors this process may run on and
/// $SLURM_CPUS_PER_TASK. Never below 1.
int thread_count(int requested);

/// Calls body(0) ... body(count - 1), each once, on at most `threads` threads. The caller makes the result
/// independent of the order. The first exception thrown by a body is rethrown here. Every worker flushes
/// denormals to zero, the same everywhere, so that bits do not depend on who computes.
void parallel_for(int count, int threads, const std::function<void(int)>& body);

/// Calls it once; libraries under it that use TBB get at most that many threads.
void in_threads(int threads, const std::function<void()>& body);

/// Sets flush-to-zero and denormals-are-zero on the calling thread.
void flush_denormals();

/// CPU-seconds used by this process so far, all threads.
double cpu_seconds();

}  // namespace sateen
