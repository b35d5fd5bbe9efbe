#include "render/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "look/json_writer.h"

namespace sateen {

namespace {
double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string facts(const RenderState& state) {
  std::string text = fmt::format("{} spp", state.samples);
  if (state.error.known) text += fmt::format("  E {:.4f}", state.error.error);
  if (state.error.known && state.target > 0) text += fmt::format(" of {:.4g}", state.target);
  if (state.seconds_left >= 0) text += fmt::format("  {} left", clock_text(state.seconds_left));
  return text;
}
}  // namespace

std::string clock_text(double seconds) {
  const long long s = std::llround(std::clamp(seconds, 0.0, 1e9));
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

Progress::Progress(ProgressStyle style, std::function<void(std::string_view)> write, int parts)
    : style_(style), write_(std::move(write)), parts_(std::max(parts, 1)) {}

void Progress::update(const RenderState& state) {
  tell(100 * (finished_ + std::clamp(state.fraction, 0.0, 1.0)) / parts_, &state);
}

void Progress::finish_part() {
  finished_ = std::min(finished_ + 1, parts_);
  tell(100.0 * finished_ / parts_, nullptr);
}

void Progress::tell(double percent, const RenderState* state) {
  if (ended_) return;
  percent_ = std::max(percent_, std::min(percent, 99.0));
  const double whole = std::floor(percent_), time = now();
  // A bar may be drawn ten times a second; lines come a percent, or every 10 s to show that all is well.
  const bool due =
      style_ == ProgressStyle::bar ? time - told_at_ >= 0.1 : whole > told_percent_ || time - told_at_ >= 10;
  if (style_ == ProgressStyle::none || !due) return;
  told_percent_ = whole;
  told_at_ = time;
  const std::string about = state ? facts(*state) : std::string();
  switch (style_) {
    case ProgressStyle::bar: {
      constexpr int cells = 28;
      const int full = int(percent_ / 100 * cells);
      write_(fmt::format("\r[{}{}] {:3.0f} %  {}\x1b[K", std::string(size_t(full), '#'),
                         std::string(size_t(cells - full), '-'), whole, about));
      open_line_ = true;
      break;
    }
    case ProgressStyle::lines:
      write_(fmt::format("{:3.0f} %  {}\n", whole, about));
      break;
    case ProgressStyle::alf:
      write_(fmt::format("ALF_PROGRESS {:.0f}%\n", whole));
      break;
    case ProgressStyle::openjd:
      write_(fmt::format("openjd_progress: {:.1f}\n", percent_));
      break;
    case ProgressStyle::json: {
      JsonWriter w(true);
      w.open_object().member("percent", whole);
      if (state) {
        w.member("spp", state->samples).member("seconds", state->seconds);
        if (state->error.known) w.member("error", state->error.error);
        if (state->seconds_left >= 0) w.member("seconds_left", state->seconds_left);
      }
      write_(w.close().text() + "\n");
      break;
    }
    case ProgressStyle::none:
      break;
  }
}

void Progress::done() {
  if (ended_) return;
  ended_ = true;
  switch (style_) {
    case ProgressStyle::bar:
      clear_line();
      break;
    case ProgressStyle::lines:
      write_("100 %\n");
      break;
    case ProgressStyle::alf:
      write_("ALF_PROGRESS 100%\n");
      break;
    case ProgressStyle::openjd:
      write_("openjd_progress: 100.0\n");
      break;
    case ProgressStyle::json:
      write_("{\"percent\": 100}\n");
      break;
    case ProgressStyle::none:
      break;
  }
}

void Progress::clear_line() {
  if (open_line_) write_("\r\x1b[K");
  open_line_ = false;
}

void Progress::stopped() {
  clear_line();
  ended_ = true;
}

}  // namespace sateen
