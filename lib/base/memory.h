#pragma once
#include <cstdint>

namespace sateen {

/// Bytes that this process may come to hold: the machine's memory, or what the control group that it runs in (a
/// container, a job of a scheduler) allows, whichever is less. Not what happens to be free, so that the answer
/// stays the same from run to run.
std::int64_t memory_limit();

}  // namespace sateen
