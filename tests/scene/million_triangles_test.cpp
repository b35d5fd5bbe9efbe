#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/parallel.h"
#include "mesh/obj.h"
#include "mesh/subdivide.h"
#include "scene/ray_tracer.h"

namespace sateen {
namespace {

std::filesystem::path write_grid(int cells) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("sateen_grid_{}.obj", cells);
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const double x = double(i) / cells, y = double(j) / cells;
      fmt::format_to(out, "v {:.6f} {:.6f} {:.6f}\nvt {:.6f} {:.6f}\n", x, y,
                     0.05 * std::sin(9 * x) * std::cos(7 * y), x, y);
    }
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int v = j * (cells + 1) + i + 1;
      fmt::format_to(out, "f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", v, v + 1, v + cells + 2, v + cells + 1);
    }
  std::ofstream(path, std::ios::binary).write(text.data(), std::streamsize(text.size()));
  return path;
}

void load_and_build(int cells, int level, double most_seconds) {
  const std::filesystem::path path = write_grid(cells);
  const double start = cpu_seconds();
  ControlMesh cage = read_obj(path);
  const double read = cpu_seconds();
  const Mesh mesh = subdivide(cage, level);
  cage = ControlMesh();
  const double subdivided = cpu_seconds();
  const RayTracer tracer(mesh);
  const double built = cpu_seconds();
  const double triangles = double(mesh.triangles());
  const double mesh_bytes =
      double(mesh.quads.capacity() * 16 +
             (mesh.positions.capacity() + mesh.normals.capacity() + mesh.dpdu.capacity() + mesh.dpdv.capacity()) *
                 12 +
             mesh.uvs.capacity() * 8) /
      triangles;
  const double embree_bytes = double(tracer.memory_bytes()) / triangles;
  const double megabytes = double(std::filesystem::file_size(path)) / 1e6;
  std::filesystem::remove(path);
  fmt::print(
      "{:.0f} triangles: read {:.3f} CPU-s ({:.0f} MB/s), subdivide {:.3f}, build {:.3f}; {:.1f} bytes a triangle in "
      "the mesh, {:.1f} in Embree ({:.1f} at its peak)\n",
      triangles, read - start, megabytes / (read - start), subdivided - read, built - subdivided, mesh_bytes,
      embree_bytes, double(tracer.peak_memory_bytes()) / triangles);
  EXPECT_LT(mesh_bytes, 37);
  EXPECT_LT(mesh_bytes + embree_bytes, 80);
#if defined(__OPTIMIZE__) && !defined(SATEEN_SANITIZE)
  EXPECT_LT(built - start, most_seconds);
  EXPECT_GT(megabytes / (read - start), 50);
#else
  (void)most_seconds;
#endif
}

TEST(MillionTriangles, LoadSubdivideAndBuildWithinTheBars) {
  load_and_build(177, 2, 1.5);
}

TEST(TenMillionTriangles, LoadSubdivideAndBuildWithinTheBars) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "takes 3 GB and half a minute; set SATEEN_LONG_TESTS";
  load_and_build(560, 2, 15);
  load_and_build(2237, 0, 60);
}

}  // namespace
}  // namespace sateen
