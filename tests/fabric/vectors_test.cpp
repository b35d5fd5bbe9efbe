#include <gtest/gtest.h>

#include "base/files.h"
#include "cloth.h"
#include "look/json.h"

namespace sateen::test {
namespace {

struct Row {
  std::string look;
  Vec3d wi, wo, f;
};

std::vector<Row> rows() {
  const std::string file = SATEEN_SOURCE_DIR "/tests/fabric/data/cloth_vectors.json";
  const JsonDocument document = parse_json(read_text_file(file, 1 << 20), file);
  const auto vector = [](const JsonValue& v) {
    return Vec3d(v.items[0].number, v.items[1].number, v.items[2].number);
  };
  std::vector<Row> all;
  for (const JsonValue& v : document.root.find("rows")->items)
    all.push_back({v.find("look")->text, vector(*v.find("wi")), vector(*v.find("wo")), vector(*v.find("f"))});
  return all;
}

// Error in units of what is allowed: 2e-3 relative or 1e-4 absolute, whichever is larger.
double excess(double found, double expected) {
  return std::abs(found - expected) / std::max(2e-3 * std::abs(expected), 1e-4);
}

// The reference evaluates the finished function once more, by a program of its own, in double precision.
TEST(ClothVectors, EveryRowIsReproducedByTheKernelThatRenders) {
  const std::vector<Row> all = rows();
  ASSERT_EQ(all.size(), 120u);
  double worst = 0;
  auto view = std::make_unique<FabricView>();
  for (size_t i = 0; i < all.size(); ++i) {
    const Row& row = all[i];
    const Fabric& fabric = fabric_of(look_named(row.look));
    prepare_view(fabric, Vec3(row.wo), FabricSampler::uniform, *view);
    const Color f = evaluate(*view, Vec3(row.wi));
    for (int c = 0; c < 3; ++c) {
      worst = std::max(worst, excess(f[c], row.f[c]));
      EXPECT_LE(excess(f[c], row.f[c]), 1)
          << "row " << i << ", " << row.look << ", channel " << c << ": " << f[c] << " for " << row.f[c];
    }
  }
  RecordProperty("worst_over_allowed", std::to_string(worst));
  printf("float kernel: worst error is %.4f of what is allowed\n", worst);
}

TEST(ClothVectors, EveryRowIsReproducedByTheDoubleKernel) {
  double worst = 0;
  auto view = std::make_unique<ThreadView<double>>();
  for (const Row& row : rows()) {
    const Look& look = look_named(row.look);
    const Curves curves = curves_of(look);
    const Threads<double> threads = compile_threads<double>(look, curves.warp, curves.weft);
    const Vec3d wo = row.wo.normalized(), wi = row.wi.normalized();
    prepare_view<double>(threads, wo.x, wo.y, wo.z, *view);
    const ThreadSums<double> s = scatter<double>(threads, *view, wi.x, wi.y, wi.z);
    for (int c = 0; c < 3; ++c) {
      const double f =
          s.surface[0] + s.surface[1] + look.warp.A.value[c] * s.volume[0] + look.weft.A.value[c] * s.volume[1];
      worst = std::max(worst, excess(f, row.f[c]));
      EXPECT_LE(excess(f, row.f[c]), 1) << row.look << ", channel " << c << ": " << f << " for " << row.f[c];
    }
  }
  RecordProperty("worst_over_allowed", std::to_string(worst));
  printf("double kernel: worst error is %.4f of what is allowed\n", worst);
}

}  // namespace
}  // namespace sateen::test
