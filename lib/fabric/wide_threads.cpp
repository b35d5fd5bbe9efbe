#include "fabric/wide_threads.h"

#include <cstdlib>
#include <cstring>

#include "fabric/thread_kernel.h"

namespace sateen {

#ifdef __AVX512F__

bool wide_threads_run() {
  const char* narrow = std::getenv("SATEEN_NARROW");
  if (narrow && std::strcmp(narrow, "1") == 0) return false;
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
}

void prepare_wide_view(const Threads<float>& threads, float x, float y, float z, ThreadView<float>& view) {
  prepare_view_in<WideLanes>(threads, x, y, z, view);
}

ThreadSums<float> scatter_wide(const Threads<float>& threads, const ThreadView<float>& view, float x, float y,
                               float z) {
  return scatter_in<WideLanes>(threads, view, x, y, z);
}

#else  // another processor family: never called

bool wide_threads_run() {
  return false;
}
void prepare_wide_view(const Threads<float>& threads, float x, float y, float z, ThreadView<float>& view) {
  prepare_view_in<PairLanes>(threads, x, y, z, view);
}
ThreadSums<float> scatter_wide(const Threads<float>& threads, const ThreadView<float>& view, float x, float y,
                               float z) {
  return scatter_in<PairLanes>(threads, view, x, y, z);
}

#endif

}  // namespace sateen
