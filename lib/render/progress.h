#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "render/render.h"

namespace sateen {

/// How progress is told. `automatic` is a bar on a terminal and lines elsewhere.
enum class ProgressStyle {
  none,
  bar,     ///< one line that is drawn anew: percent, error so far, time left
  lines,   ///< a line a percent, and at least one every 10 s
  alf,     ///< "ALF_PROGRESS 45%" (Tractor, Tractor-like farms)
  openjd,  ///< "openjd_progress: 45.0" (Deadline Cloud)
  json     ///< one JSON object a line
};

/// Turns what render() tells into text. The percent never goes back and reaches 100 in done() alone, which is to be
/// called when the files are closed. Not for several threads at once.
class Progress {
 public:
  /// `write` gets whole pieces of text, line breaks included, and flushes them. `parts`: pictures that the whole work
  /// consists of; each call of finish_part() ends one of them.
  Progress(ProgressStyle style, std::function<void(std::string_view)> write, int parts = 1);

  void update(const RenderState& state);
  void finish_part();
  void done();        ///< 100 percent
  void clear_line();  ///< takes the bar away, for a line of other text
  void stopped();     ///< no more progress: the work will not be done

 private:
  void tell(double percent, const RenderState* state);

  ProgressStyle style_;
  std::function<void(std::string_view)> write_;
  int parts_, finished_ = 0;
  double percent_ = 0, told_percent_ = -1, told_at_ = -1e9;
  bool open_line_ = false, ended_ = false;
};

/// "0:07", "12:05", "3:02:11".
std::string clock_text(double seconds);

}  // namespace sateen
