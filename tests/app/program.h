#pragma once
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sateen_test {

/// A folder of its own for one test, gone with it.
struct Folder {
  std::filesystem::path path;

  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path / name).string(); }
};

void write_text(const std::filesystem::path& path, const std::string& text);
std::string read_text(const std::filesystem::path& path);

struct Finished {
  int code = -1;         ///< exit code; 128 + n where signal n killed it
  std::string out, err;  ///< everything it said
  double seconds_after_signal = 0;
  double cpu_seconds = 0;  ///< of its threads, in the system too
  double peak_mib = 0;     ///< largest resident size
};

/// How to start a program besides its words.
struct Start {
  Start(std::filesystem::path in = ".") : folder(std::move(in)) {}
  /// Sends the signal once a percentage was told: for --progress json.
  Start(std::filesystem::path in, int number) : folder(std::move(in)), signal(number), signal_after("\"percent\"") {}

  std::filesystem::path folder;
  std::vector<std::string> environment;  ///< "NAME=value", over the test's own
  std::string program;                   ///< empty: the one that was built
  int signal = 0;                        ///< sent ...
  int signal_times = 1;                  ///< ... every 5 ms
  std::string signal_after;              ///< ... once this has appeared on standard error
  double signal_seconds = 0;             ///< ... or, above 0, so many seconds after the start
  bool close_output = false;             ///< the reader of standard output goes away at once
};

/// A limit of setrlimit(2), such as RLIMIT_FSIZE, for what is started while it is in force.
struct ResourceLimit {
  int resource;
  rlimit old{};
  ResourceLimit(int which, rlim_t bytes) : resource(which) {
    getrlimit(__rlimit_resource(resource), &old);
    rlimit limit = old;
    limit.rlim_cur = bytes;
    setrlimit(__rlimit_resource(resource), &limit);
  }
  ~ResourceLimit() { setrlimit(__rlimit_resource(resource), &old); }
  ResourceLimit(const ResourceLimit&) = delete;
};

/// Runs `sateen WORDS` to its end.
Finished run_sateen(const std::vector<std::string>& words, const Start& start = {});

/// Flags for a picture of a few thousand samples.
std::vector<std::string> tiny(std::vector<std::string> more);

/// The members of a JSON text, checked by the project's own reader.
bool is_json(const std::string& text);

}  // namespace sateen_test
