#include "mesh/subdivide.h"

#include <fmt/format.h>
#include <malloc.h>

#include <limits>
#include <new>
#include <optional>
#include <stdexcept>

#include "base/error.h"
#include "base/parallel.h"
#include "mesh/check_cage.h"
#include "mesh/close_cracks.h"
#include "mesh/face_points.h"
#include "mesh/limit_surface.h"
#include "mesh/manifold.h"
#include "mesh/uniform_refinement.h"
#include "mesh/unrefined.h"
#include "mesh/vertex_values.h"

namespace sateen {

namespace {

// Signed area of each face in UV; the sign says which way round its UVs run.
std::vector<bool> mirrored_faces(const ControlMesh& cage) {
  std::vector<bool> mirrored(cage.face_sizes.size(), false);
  if (cage.uv_indices.empty()) return mirrored;
  size_t at = 0;
  for (size_t face = 0; face < mirrored.size(); ++face) {
    const size_t n = size_t(cage.face_sizes[face]);
    double area = 0;
    if (cage.uv_indices[at] >= 0) {
      const Vec2 o = cage.uvs[size_t(cage.uv_indices[at])];
      for (size_t i = 1; i + 1 < n; ++i) {
        const Vec2 a = cage.uvs[size_t(cage.uv_indices[at + i])] - o;
        const Vec2 b = cage.uvs[size_t(cage.uv_indices[at + i + 1])] - o;
        area += double(a.x) * double(b.y) - double(a.y) * double(b.x);
      }
    }
    mirrored[face] = area < 0;
    at += n;
  }
  return mirrored;
}

// Where a UV seam ends inside the surface (a dart), smooth UVs fold over or collapse: their derivatives say nothing.
// Dropped here, they are made up from the pieces around the vertex.
void drop_folded_warp(SurfaceSample& sample, bool mirrored) {
  if ((dot(cross(sample.dpdu, sample.dpdv), sample.normal) < 0) != mirrored)
    sample.dpdu = sample.dpdv = Vec3(0, 0, 0);
}

struct BorderSample {
  std::uint32_t vertex;
  SurfaceSample sample;
};

/// What one run of faces found at its shared vertices.
struct Chunk {
  std::vector<BorderSample> border;
  std::optional<Refusal> refusal;
};

class Evaluation {
 public:
  Evaluation(const LimitSurface& surface, const Numbering& numbering, const std::vector<bool>& mirrored, Mesh& mesh)
      : surface_(surface),
        numbering_(numbering),
        mirrored_(mirrored),
        mesh_(mesh),
        values_(mesh, numbering.vertices) {
    mesh_.quads.resize(numbering.face_quad.back());
  }
  void run(int threads);
  VertexValues& values() { return values_; }

 private:
  void run_faces(size_t begin, size_t end, Chunk& chunk);

  const LimitSurface& surface_;
  const Numbering& numbering_;
  const std::vector<bool>& mirrored_;
  Mesh& mesh_;
  VertexValues values_;
};

void Evaluation::run_faces(size_t begin, size_t end, Chunk& chunk) {
  LimitSurface::Patch patch(surface_);
  FacePoints face_points;
  chunk.border.clear();
  try {
    for (size_t face = begin; face < end; ++face) {
      if (!numbering_.has_limit[face]) continue;
      patch.set_face(int(face));
      face_points.set_face(numbering_, face);
      for (size_t i = 0; i < face_points.points.size(); ++i) {
        const FacePoint& point = face_points.points[i];
        SurfaceSample sample = patch.evaluate(point.st, point.towards);
        drop_folded_warp(sample, mirrored_[face]);
        if (i < face_points.border)
          chunk.border.push_back({point.vertex, sample});
        else
          values_.set(point.vertex, sample);
      }
      std::copy(face_points.quads.begin(), face_points.quads.end(), mesh_.quads.begin() + numbering_.face_quad[face]);
    }
  } catch (const Refusal& refusal) {
    chunk.refusal = refusal;
  } catch (const std::length_error& error) {
    chunk.refusal = Refusal{error.what()};
  }
}

void Evaluation::run(int threads) {
  // Samples on shared vertices are summed serially in the order of the faces, batch by batch: the sums do not depend
  // on the number of threads, and the batch bounds the memory that waits for them.
  constexpr size_t samples_in_a_batch = 200'000, chunks_in_a_batch = 64;
  const size_t faces = numbering_.has_limit.size();
  const size_t border = 4 * size_t(numbering_.segments);
  const size_t chunk_faces = std::max<size_t>(samples_in_a_batch / border / chunks_in_a_batch, 1);
  std::vector<Chunk> chunks(chunks_in_a_batch);
  for (size_t begin = 0; begin < faces; begin += chunk_faces * chunks_in_a_batch) {
    const size_t count = std::min(chunks_in_a_batch, (faces - begin + chunk_faces - 1) / chunk_faces);
    parallel_for(int(count), threads, [&](int i) {
      const size_t from = begin + size_t(i) * chunk_faces;
      run_faces(from, std::min(from + chunk_faces, faces), chunks[size_t(i)]);
    });
    for (size_t i = 0; i < count; ++i) {
      if (chunks[i].refusal) throw *chunks[i].refusal;
      for (const BorderSample& b : chunks[i].border) values_.add(b.vertex, b.sample);
    }
  }
  for (const Numbering::Copy& copy : numbering_.copies)
    for (std::uint32_t k = 0; k < copy.count; ++k) mesh_.positions[copy.to + k] = mesh_.positions[copy.from + k];
}

/// `origin`: of each vertex, see number_vertices.
Mesh refine_manifold(const ControlMesh& cage, const std::vector<int>& origin, int level, int threads) {
  const ControlPoints points = control_points(cage);
  const auto refiner = cage_topology(cage, points);
  if (needs_uniform_refinement(refiner->GetLevel(0))) return uniformly_refined(*refiner, points, level);
  const LimitSurface surface(*refiner, points, level);
  std::vector<bool> has_limit(cage.face_sizes.size());
  for (size_t face = 0; face < has_limit.size(); ++face) has_limit[face] = surface.has_limit(int(face));
  const std::vector<bool> mirrored = mirrored_faces(cage);
  const Numbering numbering = number_vertices(refiner->GetLevel(0), level, cage.scheme == ControlMesh::Scheme::loop,
                                              !points.uvs.empty(), std::move(has_limit), mirrored, origin);
  Mesh mesh;
  Evaluation evaluation(surface, numbering, mirrored, mesh);
  evaluation.run(threads);
  if (mesh.quads.empty()) throw Refusal{"no face has a limit surface"};
  evaluation.values().finish(points, threads);
  return mesh;
}

std::string cut_warning(const CutCage& cut) {
  std::string text = cut.cage.name + ": ";
  if (cut.edges > 0)
    text += fmt::format("{} where more than two faces meet or two are turned against each other",
                        counted(cut.edges, "edge"));
  if (cut.vertices > 0)
    text += fmt::format("{}{} where several surfaces meet", cut.edges > 0 ? ", and " : "",
                        counted(cut.vertices, "vertex"));
  return text + ": each is smooth by itself and sharp there";
}

/// What libraries get is a manifold within their limits, whatever the cage is.
Mesh refine(const ControlMesh& cage, int level, int threads) {
  if (const std::string reason = beyond_limits(cage); !reason.empty()) throw Refusal{reason};
  const std::optional<CutCage> cut = cut_into_manifolds(cage);
  if (!cut) return refine_manifold(cage, {}, level, threads);
  Mesh mesh = refine_manifold(cut->cage, cut->origin, level, threads);
  close_cracks(mesh);
  mesh.warnings.insert(mesh.warnings.begin(), cut_warning(*cut));
  return mesh;
}

void check_level(const ControlMesh& cage, int level) {
  if (level < 0 || level > finest_level)
    throw InputError(fmt::format("subdivision level is {}, expected 0 to {}", level, finest_level));
  constexpr std::int64_t most = std::int64_t(1) << 31;
  if (const std::int64_t quads = quads_at_level(cage, level); quads > most)
    throw InputError(fmt::format("{} at subdivision level {} has {} quads, expected at most {}",
                                 cage.name.empty() ? "mesh" : cage.name, level, quads, most),
                     "choose a lower level");
}

}  // namespace

Mesh subdivide(const ControlMesh& cage, int level, int threads) {
  check_cage(cage);
  check_level(cage, level);
  try {
    Mesh mesh;
    std::optional<std::string> refused;
    try {
      mesh = refine(cage, level, threads);
    } catch (const Refusal& refusal) {
      refused = refusal.reason;
    }
    if (refused) mesh = unrefined_mesh(cage);
    // What the refinement needed and gave back would otherwise stay with the process while it renders.
    malloc_trim(0);
    mesh.refined = !refused;
    mesh.name = cage.name;
    mesh.metres_per_uv = cage.metres_per_uv;
    mesh.placement = cage.placement;
    mesh.warnings.insert(mesh.warnings.begin(), cage.warnings.begin(), cage.warnings.end());
    if (refused)
      mesh.warnings.push_back(
          fmt::format("{}: OpenSubdiv refuses this mesh, rendered unrefined from its cage: {}", cage.name, *refused));
    return mesh;
  } catch (const std::bad_alloc&) {
    throw OperationError(fmt::format("out of memory while subdividing {} to level {} ({} quads)", cage.name, level,
                                     quads_at_level(cage, level)));
  }
}

std::int64_t quads_at_level(const ControlMesh& cage, int level) {
  std::int64_t quads = 0;
  for (const int size : cage.face_sizes)
    quads += quads_of_face(size, 1 << level, cage.scheme == ControlMesh::Scheme::loop);
  return quads;
}

}  // namespace sateen
