#include "work_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "console.h"
#include "render/progress.h"

namespace sateen::app {

WorkProgress::WorkProgress(bool shown) : shown_(shown) {}

void WorkProgress::update(double fraction, double seconds_left, const std::string& doing) {
  if (!shown_) return;
  const double now = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  const double percent = std::floor(100 * std::clamp(fraction, 0.0, 1.0));
  const bool bar = error_is_terminal();
  if (bar ? now - told_at_ < 0.2 : now - told_at_ < 10 && percent < told_percent_ + 10) return;
  told_at_ = now;
  told_percent_ = percent;
  const std::string left = seconds_left < 0 ? "" : "  " + clock_text(seconds_left) + " left";
  const std::string text = fmt::format("{:3.0f} %{}  {}", percent, left, doing);
  print_progress(bar ? "\r" + text + "\x1b[K" : text + "\n");
  open_line_ = bar;
}

void WorkProgress::finish() {
  if (open_line_) print_progress("\r\x1b[K");
  open_line_ = false;
}

}  // namespace sateen::app
