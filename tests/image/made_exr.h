#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace sateen_test {

enum class MadeType { uint, half, single };

/// A channel with a pixel for every `sampling` x `sampling` of the picture; `value` is asked for their first ones.
struct MadeChannel {
  std::string name;
  std::function<float(int x, int y)> value;
  MadeType type = MadeType::single;
  int sampling = 1;
};

struct MadePart {
  std::string name;
  std::vector<MadeChannel> channels;
};

/// Channels of one value each: the first 1, the second 2 ...
MadePart counted(const std::vector<std::string>& names, const std::string& part = {});

struct MadeWindow {
  int left = 0, top = 0, width = 8, height = 4;
};

/// An uncompressed OpenEXR file; data and display window as given, text attributes as given.
void write_made_exr(const std::filesystem::path& path, const std::vector<MadePart>& parts,
                    const MadeWindow& data = {}, const MadeWindow& display = {},
                    const std::map<std::string, std::string>& texts = {});

}  // namespace sateen_test
