#include "program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "look/json.h"

namespace sateen_test {

namespace fs = std::filesystem;

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "sateen-app-XXXXXX").string();
  path = mkdtemp(name.data());
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string read_text(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

namespace {
[[noreturn]] void become(const std::vector<std::string>& words, const Start& start, int out, int err) {
  if (chdir(start.folder.c_str()) != 0) _exit(126);
  const int null = open("/dev/null", O_RDONLY);
  dup2(null, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  setenv("SATEEN_HOME", SATEEN_SOURCE_DIR, 1);
  for (const char* name : {"OCIO", "SATEEN_PATH", "SLURM_CPUS_PER_TASK"}) unsetenv(name);
  for (const std::string& entry : start.environment) {
    const size_t equals = entry.find('=');
    setenv(entry.substr(0, equals).c_str(), entry.substr(equals + 1).c_str(), 1);
  }
  const std::string program = start.program.empty() ? SATEEN_PROGRAM : start.program;
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  _exit(127);
}
}  // namespace

Finished run_sateen(const std::vector<std::string>& words, const Start& start) {
  int out[2], err[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) return {};
  const pid_t child = fork();
  if (child == 0) become(words, start, out[1], err[1]);
  close(out[1]);
  close(err[1]);
  if (start.close_output) {
    close(out[0]);
    out[0] = -1;
  }
  Finished finished;
  bool signalled = start.signal == 0;
  const auto begun = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  };
  auto sent = begun;
  pollfd pipes[2] = {{out[0], POLLIN, 0}, {err[0], POLLIN, 0}};
  while (pipes[0].fd >= 0 || pipes[1].fd >= 0) {
    const bool by_time = !signalled && start.signal_seconds > 0;
    poll(pipes, 2, by_time ? std::max(int(1000 * (start.signal_seconds - elapsed())), 0) : -1);
    for (int i = 0; i < 2; ++i) {
      if (pipes[i].fd < 0 || pipes[i].revents == 0) continue;
      char bytes[4096];
      const ssize_t count = read(pipes[i].fd, bytes, sizeof bytes);
      if (count <= 0) {
        close(pipes[i].fd);
        pipes[i].fd = -1;
      } else {
        (i == 0 ? finished.out : finished.err).append(bytes, size_t(count));
      }
    }
    const bool now = start.signal_seconds > 0 ? elapsed() >= start.signal_seconds
                                              : finished.err.find(start.signal_after) != std::string::npos;
    if (!signalled && now) {
      for (int i = 0; i < start.signal_times; ++i) {
        if (i > 0) usleep(5000);
        kill(child, start.signal);
      }
      signalled = true;
      sent = std::chrono::steady_clock::now();
    }
  }
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  finished.cpu_seconds = double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  finished.peak_mib = double(used.ru_maxrss) / 1024;
  finished.seconds_after_signal = std::chrono::duration<double>(std::chrono::steady_clock::now() - sent).count();
  finished.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return finished;
}

std::vector<std::string> tiny(std::vector<std::string> more) {
  std::vector<std::string> words{"render", "--mesh", "swatch", "--level", "1", "--env",      "overcast",
                                 "-r",     "64",     "36",     "-s",      "4", "--progress", "none"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

bool is_json(const std::string& text) {
  try {
    return sateen::parse_json(text, "output").problems.empty();
  } catch (const sateen::InputError&) {
    return false;
  }
}

}  // namespace sateen_test
