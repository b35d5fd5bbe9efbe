#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "image/image.h"
#include "study/study_report.h"

namespace sateen {

/// A folder that a study or a price list is written into, and the names of what is in it so far.
struct ReportFolder {
  std::filesystem::path path;
  std::vector<std::string> names;

  /// Makes the folder and its `pictures` where they are missing; OperationError where that fails.
  explicit ReportFolder(const std::filesystem::path& folder);

  void text(const std::string& name, const std::string& content);
  void plots(const std::vector<NamedPlot>& all);              ///< each as SVG and PNG
  void picture(const std::string& name, const Image& image);  ///< display-referred, into `pictures`
};

}  // namespace sateen
