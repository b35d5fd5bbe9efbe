#include "fabric/threads.h"

#include "fabric/thread_kernel.h"
#include "fabric/wide_threads.h"

namespace sateen {

namespace {
/// Whether this processor runs the wide kernel. Both give the same bits.
const bool wide = wide_threads_run();
}  // namespace

template <>
void prepare_view(const Threads<float>& threads, float x, float y, float z, ThreadView<float>& view) {
  if (wide)
    prepare_wide_view(threads, x, y, z, view);
  else
    prepare_view_in<PairLanes>(threads, x, y, z, view);
}
template <>
void prepare_view(const Threads<double>& threads, double x, double y, double z, ThreadView<double>& view) {
  prepare_view_in<double>(threads, x, y, z, view);
}

template <>
ThreadSums<float> scatter(const Threads<float>& threads, const ThreadView<float>& view, float x, float y, float z) {
  return wide ? scatter_wide(threads, view, x, y, z) : scatter_in<PairLanes>(threads, view, x, y, z);
}
template <>
ThreadSums<double> scatter(const Threads<double>& threads, const ThreadView<double>& view, double x, double y,
                           double z) {
  return scatter_in<double>(threads, view, x, y, z);
}

}  // namespace sateen
