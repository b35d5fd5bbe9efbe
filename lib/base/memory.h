#pragma once
#include <cstdint>
#include <filesystem>
#include <new>
#include <string>

namespace sateen {

/// Bytes that this process may come to hold: the machine's memory, or what the control groups that it runs in (a
/// container, a job of a scheduler) allow, whichever is less. Not what happens to be free, so that the answer stays
/// the same from run to run.
std::int64_t memory_limit();

/// Bytes that this process holds and has held: in memory, and of addresses and data as `ulimit -v` and `-d` count.
struct MemoryUse {
  std::int64_t resident = 0, peak = 0, addresses = 0, data = 0;
};
MemoryUse memory_use();

/// What this process may still take: the least that the limits leave over.
struct MemoryRoom {
  std::int64_t bytes = 0;
  std::string limit;  ///< which one it is: "this machine or its control group allows 8.6 GB"
};
MemoryRoom memory_room();

/// "1.2 GB", "350 MB".
std::string memory_text(std::int64_t bytes);

/// OperationError that names the file which was being read when memory ran out.
[[noreturn]] void refuse_for_memory(const std::filesystem::path& path);

template <class Call>
auto name_where_memory_ends(const std::filesystem::path& path, Call&& call) {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    refuse_for_memory(path);
  }
}

}  // namespace sateen
