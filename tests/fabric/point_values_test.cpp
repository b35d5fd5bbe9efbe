#include "fabric/point_values.h"

#include <gtest/gtest.h>

#include <memory>

#include "fabric/fabric.h"

namespace sateen {
namespace {

Look satin(float gamma_s, float gamma_v, float k_d, float eta, float warp_coverage, float weft_coverage) {
  Look look;
  look.warp.offsets_deg = {-32, -32, -18, 0, 0, 18, 32, 32};
  look.warp.lengths = {1.33f, .66f, 2, 2, 2, .66f, 1.33f};
  look.weft.offsets_deg = {-25, 25};
  look.weft.lengths = {1};
  for (ThreadFamily* family : {&look.warp, &look.weft}) {
    family->gamma_s_deg = gamma_s;
    family->gamma_v_deg = gamma_v;
    family->k_d = k_d;
    family->eta = eta;
    gamma_s *= 2;
  }
  look.warp.coverage = warp_coverage;
  look.weft.coverage = weft_coverage;
  return look;
}

Vec3 direction(int i, int n) {
  const float z = 0.01f + 0.98f * (float(i) + 0.5f) / float(n), angle = 2.399963f * float(i),
              r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

TEST(PointValues, MakeThreadsThoseOfALookThatWasCompiledWithThem) {
  FabricParts parts;
  parts.table = false;
  parts.narrowest = {radians(2), radians(2)};  // the same tangents for all of them
  const Fabric base = compile_fabric(satin(8, 16, 0.3f, 1.46f, 0.5f, 0.4f), same_space, parts);
  Fabric mapped = base;
  mapped.varying = std::make_shared<const VaryingThreads>(
      VaryingThreads{base.threads,
                     {family_values(satin(8, 16, 0.3f, 1.46f, 0.5f, 0.4f).warp),
                      family_values(satin(8, 16, 0.3f, 1.46f, 0.5f, 0.4f).weft)}});
  const auto here = std::make_unique<FabricView>(), there = std::make_unique<FabricView>();
  const Look looks[] = {satin(2, 4, 0, 1.3f, 0.9f, 0.1f), satin(30, 60, 1, 2, 0.2f, 0.3f),
                        satin(5, 9, 0.5f, 1, 0, 0.7f), satin(8, 16, 0.3f, 1.46f, 0.5f, 0.4f)};
  int compared = 0;
  for (const Look& look : looks) {
    const Fabric compiled = compile_fabric(look, same_space, parts);
    PointValues point;
    point.A = {Color(0.1f, 0.2f, 0.3f), Color(0.4f, 0.5f, 0.6f)};
    point.family = {family_values(look.warp), family_values(look.weft)};
    point.gap = gap_of(point.family);
    EXPECT_NEAR(point.gap, compiled.gap, 1e-7f);
    for (int v = 0; v < 12; ++v) {
      const Vec3 wo = direction(v, 12);
      prepare_threads(mapped, wo, *here, &point);
      prepare_threads(compiled, wo, *there);
      for (int i = 0; i < 60; ++i) {
        const ThreadSums<float> a = evaluate_parts(*here, direction(i, 60)),
                                b = evaluate_parts(*there, direction(i, 60));
        for (size_t f = 0; f < 2; ++f) {
          EXPECT_NEAR(a.surface[f], b.surface[f], 1e-5f * b.surface[f] + 1e-12f);
          EXPECT_NEAR(a.volume[f], b.volume[f], 1e-5f * b.volume[f] + 1e-12f);
          compared += b.volume[f] > 0;
        }
      }
    }
  }
  EXPECT_GT(compared, 3000);
}

TEST(PointValues, OfOneFabricDoNotStayForAnother) {
  FabricParts parts;
  parts.table = false;
  const Look looks[2] = {satin(4, 8, 0.3f, 1.46f, 0.5f, 0.4f), satin(12, 24, 0.1f, 1.5f, 0.3f, 0.6f)};
  Fabric fabrics[2];
  PointValues points[2];
  for (int k = 0; k < 2; ++k) {
    fabrics[k] = compile_fabric(looks[k], same_space, parts);
    points[k].A = fabrics[k].A;
    points[k].family = {family_values(looks[k].warp), family_values(looks[k].weft)};
    points[k].gap = fabrics[k].gap;
    fabrics[k].varying = std::make_shared<const VaryingThreads>(VaryingThreads{fabrics[k].threads, points[k].family});
  }
  const auto view = std::make_unique<FabricView>(), plain = std::make_unique<FabricView>();
  for (int i = 0; i < 20; ++i) {
    const int k = i % 3 % 2;
    prepare_threads(fabrics[k], direction(i, 20), *view, i % 5 ? &points[k] : nullptr);
    prepare_threads(fabrics[k], direction(i, 20), *plain);
    EXPECT_NEAR(evaluate(*view, direction(i + 3, 30)).x, evaluate(*plain, direction(i + 3, 30)).x, 1e-6f);
  }
}

}  // namespace
}  // namespace sateen
