#include "study/report_folder.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/files.h"
#include "image/file.h"

namespace sateen {

ReportFolder::ReportFolder(const std::filesystem::path& folder) : path(folder) {
  std::error_code error;
  std::filesystem::create_directories(folder / "pictures", error);
  if (error) throw OperationError(fmt::format("{} cannot be made: {}", folder.string(), error.message()));
}

void ReportFolder::text(const std::string& name, const std::string& content) {
  write_text_whole(path / name, content);
  names.push_back(name);
}

void ReportFolder::plots(const std::vector<NamedPlot>& all) {
  for (const NamedPlot& plot : all) {
    write_plot(path / plot.name, plot.sheet);
    names.push_back(plot.name + ".svg");
    names.push_back(plot.name + ".png");
  }
}

void ReportFolder::picture(const std::string& name, const Image& image) {
  write_display_image(path / "pictures" / name, image);
  names.push_back("pictures/" + name);
}

}  // namespace sateen
