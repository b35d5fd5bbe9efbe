#include "cloth.h"

#include <algorithm>
#include <mutex>

namespace sateen::test {

const std::vector<Look>& all_looks() {
  static const std::vector<Look> looks = [] {
    std::vector<Look> all;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(SATEEN_SOURCE_DIR "/looks"))
      if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) all.push_back(read_look(file.string()));
    return all;
  }();
  return looks;
}

const Look& look_named(const std::string& name) {
  for (const Look& look : all_looks())
    if (look.name == name) return look;
  throw std::runtime_error("no look " + name);
}

const Fabric& fabric_of(const Look& look) {
  static std::map<std::string, std::unique_ptr<Fabric>> compiled;
  std::unique_ptr<Fabric>& fabric = compiled[look.name];
  if (!fabric) fabric = std::make_unique<Fabric>(compile_fabric(look, same_space));
  return *fabric;
}

namespace {
constexpr double to_radians = M_PI / 180;
double narrowest(const ThreadFamily& f) {
  double gamma = 90;
  if (f.eta > 1) gamma = std::min(gamma, double(f.gamma_s_deg));
  if (f.k_d < 1) gamma = std::min(gamma, double(f.gamma_v_deg));
  return gamma * to_radians;
}
}  // namespace

Curves curves_of(const Look& look) {
  const auto curve = [&](const ThreadFamily& f) {
    return render_quadrature(f.offsets_deg, f.lengths, narrowest(f), look.masking_width_deg * to_radians);
  };
  return {curve(look.warp), curve(look.weft)};
}

Curves fine_curves_of(const Look& look, double degrees, int nodes) {
  const auto curve = [&](const ThreadFamily& f) {
    return tangent_quadrature(f.offsets_deg, f.lengths, narrowest(f), 1, degrees * to_radians, nodes);
  };
  return {curve(look.warp), curve(look.weft)};
}

Look random_look(Random& random, bool adversarial) {
  const auto pick = [&](double low, double high, bool logarithmic = false) {
    if (adversarial && random.uniform() < 0.4) return float(random.uniform() < 0.5 ? low : high);
    if (logarithmic) return float(low * std::pow(high / low, random.uniform()));
    return float(random.between(low, high));
  };
  const auto family = [&](ThreadFamily& f) {
    f.eta = pick(1, 3);
    f.k_d = pick(0, 1);
    f.gamma_s_deg = pick(0.5, 90, true);
    f.gamma_v_deg = pick(0.5, 180, true);
    for (int c = 0; c < 3; ++c) f.A.value[c] = pick(0, 1);
    f.color.reset();
    const int pieces = 1 + random.below(4);
    f.offsets_deg.assign(1, pick(-90, 90));
    f.lengths.clear();
    for (int i = 0; i < pieces; ++i) {
      const bool flat = random.uniform() < 0.4;
      f.offsets_deg.push_back(flat ? f.offsets_deg.back() : pick(-90, 90));
      f.lengths.push_back(i > 0 && random.uniform() < 0.2 ? 0.0f : float(random.between(0.1, 2)));
    }
  };
  Look look;
  look.name = "random";
  family(look.warp);
  family(look.weft);
  look.warp.coverage = pick(0, 1);
  look.weft.coverage = std::min(pick(0, 1), 1 - look.warp.coverage);
  if (!(look.warp.coverage + look.weft.coverage > 0)) look.warp.coverage = 1;
  look.masking_width_deg = pick(5, 60);
  return look;
}

Vec3 random_direction(Random& random) {
  const double z = 1 - random.uniform(), r = std::sqrt(std::max(1 - z * z, 0.0)), a = 2 * M_PI * random.uniform();
  return Vec3(float(r * std::cos(a)), float(r * std::sin(a)), float(z));
}

Vec3 torture_direction(Random& random) {
  const int kind = random.below(3);
  if (kind == 0) return random_direction(random);
  if (kind == 1) return direction(90 - 3 * std::pow(random.uniform(), 3) - 1e-4, random.between(0, 360));
  const double azimuth = 90 * random.below(4) + 0.5 * (random.uniform() - 0.5);
  return direction(random.between(0, 89.9), azimuth);
}

}  // namespace sateen::test
