#include <fmt/format.h>
#include <gtest/gtest.h>
#include <immintrin.h>

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "cloth.h"

// The ends of what is legal: everything stays finite and not negative, with denormals and without.

namespace sateen::test {
namespace {

struct Denormals {
  unsigned before = _mm_getcsr();
  explicit Denormals(bool kept) { _mm_setcsr(kept ? before & ~0x8040u : before | 0x8040u); }
  ~Denormals() { _mm_setcsr(before); }
};

bool good(double x) {
  return std::isfinite(x) && x >= 0;
}
bool good(const ThreadSums<float>& s) {
  return good(s.surface[0]) && good(s.surface[1]) && good(s.volume[0]) && good(s.volume[1]);
}

// Unit directions where an angle is undefined, a difference cancels, or nothing is left of a float.
Vec3 adversarial(Random& random, const Vec3& other) {
  const float tiny[] = {0.0f, -0.0f, 1e-45f, 1e-40f, 1.2e-38f, 1e-30f, 1e-12f, 1e-7f, 6e-8f, 1e-4f};
  const auto small = [&] { return tiny[random.below(10)] * (random.below(2) ? 1.0f : -1.0f); };
  Vec3 w;
  switch (random.below(8)) {
    case 0:
      w = Vec3(1, small(), std::abs(small()));
      break;  // along the warp, at the horizon
    case 1:
      w = Vec3(small(), -1, std::abs(small()));
      break;  // along the weft
    case 2:
      w = Vec3(small(), small(), 1);
      break;
    case 3:
      w = other;
      break;
    case 4:
      w = Vec3(-other.x, -other.y, other.z);
      break;  // mirrored
    case 5:
      w = -other;
      break;
    case 6: {  // along a tilted thread, or a few units in the last place beside it
      const double tilt = random.below(2) ? random.between(0, M_PI) : M_PI / 36 * random.below(37);
      float c = float(std::cos(tilt)), s = float(std::sin(tilt));
      for (int k = random.below(4); k > 0; --k) s = std::nextafter(s, random.below(2) ? 2.0f : -2.0f);
      w = random.below(2) ? Vec3(c, small(), s) : Vec3(small(), c, s);
      break;
    }
    default:
      w = direction(90 - std::pow(10.0, random.between(-9, 0)), 90 * random.below(4) + random.between(-1e-3, 1e-3));
  }
  return w;
}

double edge_number(Random& random) {
  const double edges[] = {0, 0x1p-32, 1 - 0x1p-24, 1 - 0x1p-32, 0.5, 0.5 - 0x1p-32};
  return random.below(3) ? random.uniform() : edges[random.below(6)];
}

struct Faults {
  long evaluations = 0, bad = 0;
  std::string first;
  void check(bool fine, const std::string& what) {
    ++evaluations;
    if (fine) return;
    if (bad++ == 0) first = what;
  }
};

void torture(const Look& look, Random& random, int views, int lights, bool with_table, Faults& faults) {
  Fabric fabric;
  const unsigned denormals = _mm_getcsr();
  try {
    FabricParts parts;
    parts.table = with_table;
    fabric = compile_fabric(look, same_space, parts);
  } catch (const InputError&) {
    return;  // more tangents than possible
  }
  _mm_setcsr(denormals);  // the table's workers flush
  auto view = std::make_unique<FabricView>();
  for (int v = 0; v < views; ++v) {
    Vec3 wo = v % 4 == 0 ? adversarial(random, random_direction(random)) : torture_direction(random);
    if (!(wo.z > 0)) wo.z = 1e-38f;
    for (const FabricSampler sampler : {FabricSampler::talk, FabricSampler::table}) {
      if (sampler == FabricSampler::table && !with_table) continue;
      prepare_view(fabric, wo, sampler, *view);
      for (int k = 0; k < lights; ++k) {
        const Vec3 wi = k % 4 == 0 ? adversarial(random, wo) : torture_direction(random);
        const ThreadSums<float> s = evaluate_parts(*view, wi);
        const auto text = [&] {
          return fmt::format("wo {} {} {:g} wi {} {} {:g}: S {} {} V {} {} pdf {}", wo.x, wo.y, wo.z, wi.x, wi.y,
                             wi.z, s.surface[0], s.surface[1], s.volume[0], s.volume[1], pdf(view->sampler, wi));
        };
        faults.check(good(s) && good(pdf(view->sampler, wi)),
                     good(s) && good(pdf(view->sampler, wi)) ? "" : text());
        if (!(wi.z > 0)) {
          EXPECT_EQ(s.surface[0] + s.volume[0] + s.surface[1] + s.volume[1], 0);
        }
        const FabricRandom u{edge_number(random),
                             {edge_number(random), edge_number(random)},
                             {edge_number(random), edge_number(random)}};
        const std::optional<Vec3> drawn = sample(view->sampler, u);
        if (!drawn) continue;
        const float p = pdf(view->sampler, *drawn);
        const double f = brightness(fabric, evaluate_parts(*view, *drawn));
        const double length2 = double(dot(*drawn, *drawn));
        const bool fine = std::abs(length2 - 1) < 1e-5 && drawn->z > 0 && p > 0 && good(f) && good(p) && good(f / p);
        faults.check(fine, fine ? ""
                                : fmt::format("{} drawn from {} {} {} {} {}: {} {} {:g}, f {} pdf {}", int(sampler),
                                              u.choice, u.thread[0], u.thread[1], u.direction[0], u.direction[1],
                                              drawn->x, drawn->y, drawn->z, f, p));
      }
    }
  }
}

TEST(Limits, RandomLooksStayFiniteAndNotNegative) {
  for (const bool denormals : {true, false}) {
    const Denormals mode(denormals);
    Random random{denormals ? 31u : 32u};
    Faults faults;
    const int looks = long_tests() ? 5000 : 1500;
    for (int i = 0; i < looks; ++i)
      torture(random_look(random, i % 4 == 0), random, long_tests() ? 100 : 5, long_tests() ? 100 : 20, false,
              faults);
    EXPECT_EQ(faults.bad, 0) << faults.first;
    printf("limits, denormals %s: %ld checks of %d looks, %ld bad\n", denormals ? "kept" : "flushed",
           faults.evaluations, looks, faults.bad);
  }
}

TEST(Limits, TablesOfRandomLooksStayFiniteAndNotNegative) {
  for (const bool denormals : {true, false}) {
    const Denormals mode(denormals);
    Random random{denormals ? 33u : 34u};
    Faults faults;
    for (int i = 0; i < (long_tests() ? 300 : 1); ++i)
      torture(random_look(random, i % 4 == 0), random, 200, 100, true, faults);
    for (const Look& look : all_looks()) {
      if (!long_tests() && look.name != "velvet") continue;
      torture(look, random, 100, 50, true, faults);
    }
    EXPECT_EQ(faults.bad, 0) << faults.first;
  }
}

// One parameter at a time at its end, on the satin.
TEST(Limits, EveryEndOfEveryRangeRenders) {
  const Look& satin = look_named("polyester_satin_charmeuse");
  Random random{35};
  Faults faults;
  const auto with = [&](auto change) {
    Look look = satin;
    change(look.warp);
    change(look.weft);
    torture(look, random, 30, 60, false, faults);
  };
  for (const float gamma : {0.5f, 90.0f}) with([&](ThreadFamily& f) { f.gamma_s_deg = gamma; });
  for (const float gamma : {0.5f, 180.0f}) with([&](ThreadFamily& f) { f.gamma_v_deg = gamma; });
  for (const float k_d : {0.0f, 1.0f}) with([&](ThreadFamily& f) { f.k_d = k_d; });
  for (const float eta : {1.0f, 3.0f}) with([&](ThreadFamily& f) { f.eta = eta; });
  with([](ThreadFamily& f) { f.A.value = Color(0, 0, 0); });
  with([](ThreadFamily& f) { f.offsets_deg = {-90, -90, 90, 90}, f.lengths = {1, 1, 1}; });
  with([](ThreadFamily& f) { f.offsets_deg = {90, 90}, f.lengths = {1}; });
  EXPECT_EQ(faults.bad, 0) << faults.first;
}

TEST(Limits, WithoutRefractionThereIsNoSurfaceLight) {
  Look look = look_named("silk_shot");
  look.warp.eta = look.weft.eta = 1;
  const Fabric fabric = compile_fabric(look, same_space, {false, 1});
  auto view = std::make_unique<FabricView>();
  Random random{36};
  double volume = 0;
  for (int i = 0; i < 500; ++i) {
    prepare_view(fabric, torture_direction(random), FabricSampler::uniform, *view);
    const ThreadSums<float> s = evaluate_parts(*view, torture_direction(random));
    EXPECT_EQ(s.surface[0], 0);
    EXPECT_EQ(s.surface[1], 0);
    volume += s.volume[0];
  }
  EXPECT_GT(volume, 0);
}

// Where wi and wo graze opposite ends of a thread 1 / cos^2 theta_d and 1 / (cos theta_i + cos theta_r) grow together
// and F_t^2 goes to 0: the limit, taken in double, is what the float kernel returns on the way.
TEST(Limits, OppositeEndsOfAThreadHaveAFiniteLimit) {
  Look look = look_named("silk_crepe_de_chine");
  look.warp.offsets_deg = {0, 0};
  look.warp.lengths = {1};
  const Curves curves = curves_of(look);
  const Threads<float> threads = compile_threads<float>(look, curves.warp, curves.weft);
  const Threads<double> oracle = compile_threads<double>(look, curves.warp, curves.weft);
  auto view = std::make_unique<ThreadView<float>>();
  auto oracle_view = std::make_unique<ThreadView<double>>();
  double last = 0;
  for (double height = 1; height > 1e-6; height /= 4) {
    const double c = std::cos(height), s = std::sin(height);
    prepare_view<float>(threads, float(c), 0.0f, float(s), *view);
    const ThreadSums<float> f = scatter<float>(threads, *view, float(-c), 0.0f, float(s));
    prepare_view<double>(oracle, c, 0.0, s, *oracle_view);
    const ThreadSums<double> d = scatter<double>(oracle, *oracle_view, -c, 0.0, s);
    ASSERT_TRUE(good(f));
    EXPECT_NEAR(f.volume[0], d.volume[0], 1e-3 * d.volume[0] + 1e-9);
    EXPECT_NEAR(f.surface[0], d.surface[0], 1e-3 * d.surface[0] + 1e-9);
    last = d.surface[0];
  }
  EXPECT_GT(last, 0);
  EXPECT_LT(last, 1e8);
}

// Found by the long run of the random looks: what is left of Q was a denormal, and its inverse infinite.
TEST(Limits, ADenormalHeightOverTheClothIsDark) {
  const Denormals mode(true);
  Random random{37};
  auto view = std::make_unique<FabricView>();
  for (int i = 0; i < 300; ++i) {
    Look look = random_look(random, i % 4 == 0);
    for (ThreadFamily* f : {&look.warp, &look.weft}) f->gamma_s_deg = std::max(f->gamma_s_deg, 5.0f), f->gamma_v_deg = 30;
    const Fabric fabric = compile_fabric(look, same_space, {false, 1});
    _mm_setcsr(_mm_getcsr() & ~0x8040u);
    for (const float z : {1.4013e-45f, 1e-42f, 1e-39f, 1.2e-38f, 1e-36f})
      for (const float x : {0.0f, 1e-30f, 1e-40f, 1e-18f}) {
        prepare_view(fabric, Vec3(x, -1, z), FabricSampler::talk, *view);
        EXPECT_TRUE(good(evaluate_parts(*view, Vec3(-x, 1, z)))) << i << " " << x << " " << z;
        prepare_view(fabric, Vec3(1, x, z), FabricSampler::talk, *view);
        EXPECT_TRUE(good(evaluate_parts(*view, Vec3(-1, -x, z)))) << i << " " << x << " " << z;
      }
  }
}

TEST(Limits, ATooLongCurveSaysHowManyTangentsItNeeds) {
  Look look = look_named("linen_plain");
  for (ThreadFamily* f : {&look.warp, &look.weft}) {
    f->gamma_s_deg = 0.5f;
    f->offsets_deg = {-90, 90, -90, 90, -90};
    f->lengths = {1, 1, 1, 1};
  }
  try {
    compile_fabric(look, same_space, {false, 1});
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("tangents, at most"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("widen gamma_s_deg"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sateen::test
