#pragma once
#include <functional>
#include <string>

namespace sateen::bench {

/// CPU-nanoseconds of one call of `body`, the median of `rounds` timings of `calls` calls each.
double nanoseconds(int rounds, int calls, const std::function<void()>& body);

/// Medians of two bodies timed in turn, A B A B ..., so that a machine that changes its speed hurts both alike.
struct Pair {
  double a = 0, b = 0;       ///< CPU-seconds
  double ratio = 0;          ///< median of a / b
  double low = 0, high = 0;  ///< smallest and largest a / b
};
Pair interleaved(int rounds, const std::function<void()>& a, const std::function<void()>& b);

/// A benchmark first checks that its answer is right: prints and ends the program with 1 where `right` is false.
void require(bool right, const std::string& what);

void kernel();
void samplers();
void environment();
void rays();
void strategies();
void memory();
void whole();
void off();
void off_once();

}  // namespace sateen::bench
