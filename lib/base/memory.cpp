#include "base/memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace sateen {

namespace {

/// Of a file that holds one number, or "max"; `none` otherwise.
std::int64_t number_in(const char* path, std::int64_t none) {
  std::ifstream file(path);
  std::int64_t value = 0;
  return file >> value && value > 0 ? value : none;
}

}  // namespace

std::int64_t memory_limit() {
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  const std::int64_t pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  const std::int64_t machine = pages > 0 && page > 0 ? pages * page : none;
  // Version 2 of control groups and version 1, as a container sees its own.
  return std::min({machine, number_in("/sys/fs/cgroup/memory.max", none),
                   number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes", none)});
}

}  // namespace sateen
