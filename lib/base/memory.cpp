#include "base/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/error.h"

namespace sateen {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();

/// Of a file that holds one number, or "max".
std::int64_t number_in(const fs::path& path) {
  std::ifstream file(path);
  std::int64_t value = 0;
  return file >> value && value > 0 ? value : none;
}

/// The least limit on the way from a control group up to its root.
std::int64_t least_limit(const fs::path& root, const std::string& group, const char* file) {
  std::int64_t least = number_in(root / file);
  fs::path at = root;
  for (const fs::path& part : fs::path(group).relative_path())
    least = std::min(least, number_in((at /= part) / file));
  return least;
}

/// Of all control groups of this process: version 2, and the memory controller of version 1. A container sees its own
/// as the root, whatever its name is outside.
std::int64_t group_limit() {
  std::int64_t least =
      std::min(number_in("/sys/fs/cgroup/memory.max"), number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"));
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",",
                      group = line.substr(second + 1);
    if (controllers == ",,")
      least = std::min(least, least_limit("/sys/fs/cgroup", group, "memory.max"));
    else if (controllers.find(",memory,") != std::string::npos)
      least = std::min(least, least_limit("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

}  // namespace

std::int64_t memory_limit() {
  const std::int64_t pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return std::min(pages > 0 && page > 0 ? pages * page : none, group_limit());
}

MemoryUse memory_use() {
  MemoryUse use;
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream words(line);
    std::string name;
    std::int64_t kilobytes = 0;
    if (!(words >> name >> kilobytes)) continue;
    if (name == "VmRSS:") use.resident = kilobytes * 1024;
    if (name == "VmHWM:") use.peak = kilobytes * 1024;
    if (name == "VmSize:") use.addresses = kilobytes * 1024;
    if (name == "VmData:") use.data = kilobytes * 1024;
  }
  return use;
}

MemoryRoom memory_room() {
  const MemoryUse use = memory_use();
  const std::int64_t memory = memory_limit();
  MemoryRoom room{memory - use.resident,
                  fmt::format("this machine or its control group allows {}", memory_text(memory))};
  const auto consider = [&](int resource, std::int64_t used, const char* name) {
    rlimit limit{};
    if (getrlimit(__rlimit_resource_t(resource), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    const std::int64_t left = std::int64_t(limit.rlim_cur) - used;
    if (left < room.bytes)
      room = {left, fmt::format("{} allows {}", name, memory_text(std::int64_t(limit.rlim_cur)))};
  };
  consider(RLIMIT_AS, use.addresses, "ulimit -v");
  consider(RLIMIT_DATA, use.data, "ulimit -d");
  return room;
}

void refuse_for_memory(const std::filesystem::path& path) {
  throw OperationError(
      fmt::format("{}: there is not enough memory to read it ({})", path.string(), memory_room().limit));
}

std::string memory_text(std::int64_t bytes) {
  return bytes < 1'000'000'000 ? fmt::format("{:.0f} MB", double(bytes) / 1e6)
                               : fmt::format("{:.1f} GB", double(bytes) / 1e9);
}

}  // namespace sateen
