// A look's text, then perhaps a line of %% and overrides, one a line. What is understood must read back the same.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "look/describe.h"
#include "look/read.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  setenv("SATEEN_HOME", SATEEN_SOURCE_DIR, 1);  // where inherited looks are found
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sateen;
  const std::string input(reinterpret_cast<const char*>(data), size);
  const size_t split = input.find("\n%%\n");
  std::vector<std::string> overrides;
  if (split != std::string::npos) {
    std::istringstream lines(input.substr(split + 4));
    for (std::string line; overrides.size() < 16 && std::getline(lines, line);) overrides.push_back(line);
  }
  try {
    Look look = parse_look(input.substr(0, split), SATEEN_SOURCE_DIR "/looks/fuzzed.json");
    apply_overrides(look, overrides);
    if (!diff_looks(parse_look(write_look(look), look.file), look).empty()) std::abort();
  } catch (const InputError& error) {
    if (error.diagnostics.empty() || *error.what() == '\0') std::abort();
  }
  return 0;
}
