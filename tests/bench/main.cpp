#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/parallel.h"
#include "bench.h"

namespace sateen::bench {

namespace {
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}
}  // namespace

double nanoseconds(int rounds, int calls, const std::function<void()>& body) {
  std::vector<double> times;
  body();
  for (int r = 0; r < rounds; ++r) {
    const double start = cpu_seconds();
    for (int i = 0; i < calls; ++i) body();
    times.push_back((cpu_seconds() - start) / calls * 1e9);
  }
  return median(times);
}

Pair interleaved(int rounds, const std::function<void()>& a, const std::function<void()>& b) {
  std::vector<double> as, bs, ratios;
  for (int r = 0; r < rounds; ++r) {
    const double start = cpu_seconds();
    a();
    const double middle = cpu_seconds();
    b();
    const double end = cpu_seconds();
    as.push_back(middle - start);
    bs.push_back(end - middle);
    ratios.push_back(as.back() / bs.back());
  }
  return {median(as), median(bs), median(ratios), *std::min_element(ratios.begin(), ratios.end()),
          *std::max_element(ratios.begin(), ratios.end())};
}

void require(bool right, const std::string& what) {
  if (right) return;
  fmt::print("WRONG: {}\n", what);
  std::exit(1);
}

}  // namespace sateen::bench

int main(int argc, char** argv) {
  using namespace sateen;
  const std::vector<std::pair<std::string, void (*)()>> all{{"kernel", bench::kernel},
                                                            {"samplers", bench::samplers},
                                                            {"environment", bench::environment},
                                                            {"rays", bench::rays},
                                                            {"strategies", bench::strategies},
                                                            {"memory", bench::memory},
                                                            {"whole", bench::whole},
                                                            {"off", bench::off},
                                                            {"off-once", bench::off_once}};
  std::vector<std::string> names;
  for (const auto& [name, run] : all) names.push_back(name);
  flush_denormals();
  try {
    for (int i = 1; i < argc; ++i)
      if (std::find(names.begin(), names.end(), argv[i]) == names.end()) {
        fmt::print(stderr, "error: no benchmark '{}'\n  help: {}\n", argv[i], suggestion(argv[i], names));
        return 2;
      }
    for (const auto& [name, run] : all)
      // Of use under a counting program alone.
      if ((argc == 1 && name != "off-once") || std::find(argv + 1, argv + argc, name) != argv + argc) {
        fmt::print("\n== {} ==\n", name);
        run();
      }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
