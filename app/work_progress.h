#pragma once
#include <string>

namespace sateen::app {

/// Progress of work that is not one picture: a bar on a terminal, else a line every ten seconds or percent ten.
class WorkProgress {
 public:
  explicit WorkProgress(bool shown);

  void update(double fraction, double seconds_left, const std::string& doing);
  void finish();  ///< takes the bar away

 private:
  bool shown_, open_line_ = false;
  double told_at_ = -1e9, told_percent_ = -1;
};

}  // namespace sateen::app
