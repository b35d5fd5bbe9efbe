// A weaving draft's text. What is understood must be a draft that its own rows give back.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "look/draft.h"
#include "look/wif.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sateen;
  try {
    const Draft draft = parse_wif(std::string(reinterpret_cast<const char*>(data), size), "fuzzed.wif").draft;
    if (draft.ends < 1 || draft.picks < 1) std::abort();
    const Draft again = parse_draft(draft_rows(draft));
    if (again.warp_up != draft.warp_up || again.ends != draft.ends) std::abort();
  } catch (const InputError& error) {
    if (error.diagnostics.empty() || *error.what() == '\0') std::abort();
  }
  return 0;
}
