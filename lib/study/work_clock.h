#pragma once
#include <atomic>
#include <functional>
#include <string>

namespace sateen {

/// How far long work of many renders is: units of work, of any kind, done and planned, and what the clock says of
/// the rest.
class WorkClock {
 public:
  WorkClock(double planned_units, const std::atomic<bool>* interrupt);

  void plan(double units) { planned_ = units; }
  void done(double units) { done_ += units; }
  bool stopped() const { return interrupt_ && interrupt_->load(std::memory_order_relaxed); }
  const std::atomic<bool>* interrupt() const { return interrupt_; }

  double fraction() const;      ///< below 1
  double seconds() const;       ///< since the start
  double seconds_left() const;  ///< -1 until a hundredth is done

 private:
  double start_ = 0, planned_ = 1, done_ = 0;
  const std::atomic<bool>* interrupt_ = nullptr;
};

}  // namespace sateen
