#include "base/missing_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/nearest_name.h"

namespace sateen {

namespace fs = std::filesystem;

std::string missing_file_help(const fs::path& path, const std::string& extension) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code code;
  if (!fs::is_directory(folder, code)) return fmt::format("there is no folder {}", folder.string());
  constexpr size_t most_names = 10'000;  // of a folder of frames the first will do
  std::vector<std::string> names;
  for (fs::directory_iterator it(folder, code), end; !code && it != end && names.size() < most_names;
       it.increment(code))
    if (extension.empty() || it->path().extension() == extension) names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end());
  const std::string near = nearest_name(path.filename().string(), names);
  return near.empty() ? near : fmt::format("did you mean {}?", (path.parent_path() / near).string());
}

}  // namespace sateen
