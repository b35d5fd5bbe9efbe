#pragma once
#include "fabric/threads.h"

namespace sateen {

/// The kernel of threads.h in registers of 16 floats (AVX-512): the bits of the kernel of twice 8, in about three
/// quarters of the time. Its file alone is compiled for AVX-512.

/// Whether this program holds it and this processor runs it. SATEEN_NARROW=1 in the environment says no.
bool wide_threads_run();

void prepare_wide_view(const Threads<float>& threads, float x, float y, float z, ThreadView<float>& view);
ThreadSums<float> scatter_wide(const Threads<float>& threads, const ThreadView<float>& view, float x, float y,
                               float z);

}  // namespace sateen
