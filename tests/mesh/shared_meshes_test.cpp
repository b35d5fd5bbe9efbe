#include <gtest/gtest.h>

#include <filesystem>

#include "mesh/mesh_checks.h"
#include "mesh/obj.h"
#include "mesh/subdivide.h"

namespace sateen {
namespace {

TEST(SharedMeshes, ParseAndSubdivideAtAllLevelsWithoutAMadeUpWarpWhereTheyHaveUvs) {
  namespace fs = std::filesystem;
  const fs::path folder = SATEEN_SOURCE_DIR "/../shared/meshes";
  if (!fs::exists(folder)) GTEST_SKIP() << "../shared/meshes is not there";
  int files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".obj") continue;
    ++files;
    const ControlMesh cage = read_obj(entry.path());
    EXPECT_TRUE(cage.warnings.empty()) << entry.path();
    for (int level = 0; level <= 3; ++level) {
      SCOPED_TRACE(entry.path().string() + " level " + std::to_string(level));
      const Mesh mesh = subdivide(cage, level);
      expect_sound(mesh);
      EXPECT_TRUE(mesh.refined);
      for (const std::string& warning : mesh.warnings)  // a few of them are no surface in places
        EXPECT_NE(warning.find("where several surfaces meet"), std::string::npos) << warning;
      EXPECT_EQ(mesh.fallback_warps, cage.uv_indices.empty() ? std::int64_t(mesh.positions.size()) : 0);
    }
  }
  EXPECT_GE(files, 8);
}

}  // namespace
}  // namespace sateen
