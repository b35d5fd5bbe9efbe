#include "mesh/limit_surface.h"

#include <fmt/format.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <mutex>
#include <shared_mutex>

namespace sateen {

namespace Far = OpenSubdiv::Far;
namespace Bfr = OpenSubdiv::Bfr;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

// OpenSubdiv reports through two global callbacks that print by default.
thread_local std::string complaint;
void keep_complaint(const char* message) {
  if (complaint.empty()) complaint = message;
}
void silence_opensubdiv() {
  static std::once_flag once;
  std::call_once(once, [] {
    Far::SetErrorCallback([](Far::ErrorType, const char* message) { keep_complaint(message); });
    Far::SetWarningCallback([](const char* message) { keep_complaint(message); });
  });
}

float power_of_two_near(float size) {
  return size > 0 ? std::exp2(std::ceil(std::log2(size))) : 1.0f;
}

Sdc::Options scheme_options(const ControlMesh& cage) {
  using O = Sdc::Options;
  O options;
  switch (cage.boundary) {
    case ControlMesh::Boundary::none:
      options.SetVtxBoundaryInterpolation(O::VTX_BOUNDARY_NONE);
      break;
    case ControlMesh::Boundary::edge_only:
      options.SetVtxBoundaryInterpolation(O::VTX_BOUNDARY_EDGE_ONLY);
      break;
    case ControlMesh::Boundary::edge_and_corner:
      options.SetVtxBoundaryInterpolation(O::VTX_BOUNDARY_EDGE_AND_CORNER);
      break;
  }
  switch (cage.fvar_boundary) {
    case ControlMesh::FvarBoundary::none:
      options.SetFVarLinearInterpolation(O::FVAR_LINEAR_NONE);
      break;
    case ControlMesh::FvarBoundary::corners_only:
      options.SetFVarLinearInterpolation(O::FVAR_LINEAR_CORNERS_ONLY);
      break;
    case ControlMesh::FvarBoundary::corners_plus1:
      options.SetFVarLinearInterpolation(O::FVAR_LINEAR_CORNERS_PLUS1);
      break;
    case ControlMesh::FvarBoundary::corners_plus2:
      options.SetFVarLinearInterpolation(O::FVAR_LINEAR_CORNERS_PLUS2);
      break;
    case ControlMesh::FvarBoundary::boundaries:
      options.SetFVarLinearInterpolation(O::FVAR_LINEAR_BOUNDARIES);
      break;
    case ControlMesh::FvarBoundary::all:
      options.SetFVarLinearInterpolation(O::FVAR_LINEAR_ALL);
      break;
  }
  return options;
}

Sdc::SchemeType scheme_type(ControlMesh::Scheme scheme) {
  switch (scheme) {
    case ControlMesh::Scheme::loop:
      return Sdc::SCHEME_LOOP;
    case ControlMesh::Scheme::bilinear:
      return Sdc::SCHEME_BILINEAR;
    case ControlMesh::Scheme::catmull_clark:
      break;
  }
  return Sdc::SCHEME_CATMARK;
}

}  // namespace

ControlPoints control_points(const ControlMesh& cage) {
  ControlPoints out;
  const auto box = [](const auto& values, const auto& used, auto& low, auto& high) {
    bool first = true;
    for (const int i : used) {
      if (i < 0) continue;
      const auto& v = values[size_t(i)];
      for (int k = 0; k < int(v.dimensions()); ++k) {
        low[k] = first ? v[k] : std::min(low[k], v[k]);
        high[k] = first ? v[k] : std::max(high[k], v[k]);
      }
      first = false;
    }
  };
  Vec3 low(0, 0, 0), high(0, 0, 0);
  box(cage.positions, cage.position_indices, low, high);
  out.centre = low * 0.5f + high * 0.5f;
  const Vec3 size = high * 0.5f - low * 0.5f;
  out.scale = power_of_two_near(std::max({size.x, size.y, size.z}));
  out.positions.resize(cage.positions.size());
  // Vertices that no face uses may lie anywhere; clamped, they cannot overflow.
  for (size_t i = 0; i < out.positions.size(); ++i) {
    const Vec3 p = (cage.positions[i] - out.centre) / out.scale;
    out.positions[i] = Vec3(std::clamp(p.x, -2.0f, 2.0f), std::clamp(p.y, -2.0f, 2.0f), std::clamp(p.z, -2.0f, 2.0f));
  }
  if (cage.uv_indices.empty()) return out;
  Vec2 uv_low(0, 0), uv_high(0, 0);
  box(cage.uvs, cage.uv_indices, uv_low, uv_high);
  out.uv_centre = uv_low * 0.5f + uv_high * 0.5f;
  const Vec2 uv_size = uv_high * 0.5f - uv_low * 0.5f;
  out.uv_scale = power_of_two_near(std::max(uv_size.x, uv_size.y));
  out.uvs.reserve(cage.uvs.size() + 1);
  for (const Vec2& uv : cage.uvs) {
    const Vec2 w = (uv - out.uv_centre) / out.uv_scale;
    out.uvs.push_back(Vec2(std::clamp(w.x, -2.0f, 2.0f), std::clamp(w.y, -2.0f, 2.0f)));
  }
  out.uvs.push_back(-out.uv_centre / out.uv_scale);  // reads (0, 0) again in the end
  return out;
}

std::unique_ptr<Far::TopologyRefiner> cage_topology(const ControlMesh& cage, const ControlPoints& points) {
  silence_opensubdiv();
  complaint.clear();
  Far::TopologyDescriptor d;
  d.numVertices = int(cage.positions.size());
  d.numFaces = int(cage.face_sizes.size());
  d.numVertsPerFace = cage.face_sizes.data();
  d.vertIndicesPerFace = cage.position_indices.data();
  std::vector<int> pairs, corner_vertices;
  std::vector<float> weights, corner_weights;
  for (const ControlMesh::Crease& crease : cage.creases)
    for (size_t i = 0; i + 1 < crease.vertices.size(); ++i) {
      pairs.insert(pairs.end(), {crease.vertices[i], crease.vertices[i + 1]});
      weights.push_back(crease.sharpness);
    }
  for (const ControlMesh::Corner& corner : cage.corners) {
    corner_vertices.push_back(corner.vertex);
    corner_weights.push_back(corner.sharpness);
  }
  d.numCreases = int(weights.size());
  d.creaseVertexIndexPairs = pairs.data();
  d.creaseWeights = weights.data();
  d.numCorners = int(corner_vertices.size());
  d.cornerVertexIndices = corner_vertices.data();
  d.cornerWeights = corner_weights.data();
  d.numHoles = int(cage.holes.size());
  d.holeIndices = cage.holes.data();
  std::vector<int> with_dummy;
  Far::TopologyDescriptor::FVarChannel channel;
  if (!points.uvs.empty()) {
    channel.numValues = int(points.uvs.size());
    channel.valueIndices = cage.uv_indices.data();
    if (std::find(cage.uv_indices.begin(), cage.uv_indices.end(), -1) != cage.uv_indices.end()) {
      with_dummy = cage.uv_indices;
      std::replace(with_dummy.begin(), with_dummy.end(), -1, channel.numValues - 1);
      channel.valueIndices = with_dummy.data();
    }
    d.numFVarChannels = 1;
    d.fvarChannels = &channel;
  }
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(d, Factory::Options(scheme_type(cage.scheme), scheme_options(cage))));
  if (!refiner) throw Refusal{complaint.empty() ? "no reason given" : complaint};
  return refiner;
}

namespace {
using Cache = Bfr::SurfaceFactoryCacheThreaded<std::shared_mutex, std::shared_lock<std::shared_mutex>,
                                               std::unique_lock<std::shared_mutex>>;
using Factory = Bfr::RefinerSurfaceFactory<Cache>;
using Surface = Bfr::Surface<float>;

Factory::Options factory_options(int level) {
  // Around an extraordinary vertex Bfr subdivides so often before it approximates: the vertices of `level` are
  // then corners of its patches or inside regular ones, so that they lie on the true limit surface.
  Factory::Options options;
  options.SetApproxLevelSmooth(std::max(2, level));
  options.SetApproxLevelSharp(std::max(6, level));
  return options;
}
}  // namespace

struct LimitSurface::State {
  const ControlPoints& points;
  Factory factory;
  State(const Far::TopologyRefiner& refiner, const ControlPoints& p, int level)
      : points(p), factory(refiner, factory_options(level)) {}
};

LimitSurface::LimitSurface(const Far::TopologyRefiner& refiner, const ControlPoints& points, int level)
    : state_(std::make_unique<State>(refiner, points, level)) {}
LimitSurface::~LimitSurface() = default;
bool LimitSurface::has_limit(int face) const {
  return state_->factory.FaceHasLimitSurface(face);
}

struct LimitSurface::Patch::State {
  const LimitSurface::State& surface;
  Surface position, uv;
  std::vector<float> position_points, uv_points;
  bool has_uvs = false;
};

LimitSurface::Patch::Patch(const LimitSurface& surface) : state_(new State{*surface.state_, {}, {}, {}, {}, false}) {
  state_->has_uvs = !surface.state_->points.uvs.empty();
}
LimitSurface::Patch::~Patch() = default;

void LimitSurface::Patch::set_face(int face) {
  State& s = *state_;
  const Factory::FVarID channel = 0;
  const bool good = s.has_uvs ? s.surface.factory.InitSurfaces(face, &s.position, &s.uv, &channel, 1)
                              : s.surface.factory.InitVertexSurface(face, &s.position);
  if (!good) throw Refusal{fmt::format("face {} has no limit surface", face)};
  s.position_points.resize(size_t(s.position.GetNumPatchPoints()) * 3);
  s.position.PreparePatchPoints(&s.surface.points.positions[0].x, 3, s.position_points.data(), 3);
  if (!s.has_uvs) return;
  s.uv_points.resize(size_t(s.uv.GetNumPatchPoints()) * 2);
  s.uv.PreparePatchPoints(&s.surface.points.uvs[0].x, 2, s.uv_points.data(), 2);
}

SurfaceSample LimitSurface::Patch::evaluate(const Vec2& st, const Vec2& towards) const {
  const State& s = *state_;
  const auto at = [&](const Vec2& where) {
    Vec3 p, ds, dt;
    Vec2 uv(0, 0), uv_ds(0, 0), uv_dt(0, 0);
    s.position.Evaluate(&where.x, s.position_points.data(), 3, &p.x, &ds.x, &dt.x);
    if (s.has_uvs) s.uv.Evaluate(&where.x, s.uv_points.data(), 2, &uv.x, &uv_ds.x, &uv_dt.x);
    return sample_from_derivatives(p, ds, dt, uv, uv_ds, uv_dt);
  };
  SurfaceSample sample = at(st);
  if (sample.normal == Vec3(0, 0, 0)) {
    constexpr float step = 1.0f / 64;
    const SurfaceSample inner = at(st + (towards - st) * step);
    sample.normal = inner.normal;
    sample.dpdu = inner.dpdu;
    sample.dpdv = inner.dpdv;
  }
  return sample;
}

}  // namespace sateen
