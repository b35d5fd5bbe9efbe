#include "study/work_clock.h"

#include <algorithm>
#include <chrono>

namespace sateen {

namespace {
double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
}  // namespace

WorkClock::WorkClock(double planned_units, const std::atomic<bool>* interrupt)
    : start_(now()), planned_(planned_units), interrupt_(interrupt) {}

double WorkClock::fraction() const {
  return std::clamp(done_ / planned_, 0.0, 0.999);
}
double WorkClock::seconds() const {
  return now() - start_;
}
double WorkClock::seconds_left() const {
  return fraction() < 0.01 ? -1 : seconds() * (1 / fraction() - 1);
}

}  // namespace sateen
