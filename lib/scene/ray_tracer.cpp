#include "scene/ray_tracer.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <atomic>
#include <cstring>

#include "base/error.h"
#include "base/parallel.h"

namespace sateen {

struct RayTracer::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::atomic<std::int64_t> bytes{0}, peak{0};
  std::string error;            // the first one; written under Embree's own lock
  std::vector<Vec3> positions;  // only where the mesh left no room behind its last position

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  void check(const char* doing) const {
    if (!error.empty()) throw OperationError(fmt::format("Embree failed while {}: {}", doing, error));
  }
};

namespace {

const char* error_name(RTCError code) {
  switch (code) {
    case RTC_ERROR_OUT_OF_MEMORY:
      return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU:
      return "this processor is not supported";
    case RTC_ERROR_INVALID_ARGUMENT:
      return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION:
      return "invalid operation";
    case RTC_ERROR_CANCELLED:
      return "cancelled";
    default:
      return "unknown error";
  }
}

void check_mesh(const Mesh& mesh) {
  const size_t vertices = mesh.positions.size();
  for (size_t i = 0; i < mesh.quads.size(); ++i)
    for (const std::uint32_t v : mesh.quads[i])
      if (v >= vertices)
        throw InputError(fmt::format("quad {} uses vertex {}, expected 0 to {}", i, v, (long long)vertices - 1));
  // Embree leaves out primitives beyond 1.8e18 (the square root of FLT_MAX) without a word.
  constexpr float limit = 1.8e18f;
  for (size_t i = 0; i < vertices; ++i) {
    const Vec3& p = mesh.positions[i];
    if (!(std::abs(p.x) < limit && std::abs(p.y) < limit && std::abs(p.z) < limit))
      throw InputError(
          fmt::format("vertex {} is at ({}, {}, {}), expected finite numbers below 1.8e18", i, p.x, p.y, p.z));
  }
}

bool is_traceable(const Ray& ray) {
  const float sum = ray.origin.x + ray.origin.y + ray.origin.z + ray.direction.x + ray.direction.y + ray.direction.z;
  if (!std::isfinite(sum)) {
    // Large but finite parts may add up to Inf: those are looked at one by one.
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(ray.origin[k]) || !std::isfinite(ray.direction[k])) return false;
  }
  return ray.t_min <= ray.t_max && !(ray.direction == Vec3(0, 0, 0));  // false for NaN
}

template <class EmbreeRay>
void fill(EmbreeRay& out, const Ray& ray) {
  out.org_x = ray.origin.x;
  out.org_y = ray.origin.y;
  out.org_z = ray.origin.z;
  out.tnear = std::max(ray.t_min, 0.0f);
  out.dir_x = ray.direction.x;
  out.dir_y = ray.direction.y;
  out.dir_z = ray.direction.z;
  out.time = 0;
  out.tfar = ray.t_max;
  out.mask = 0xffffffffu;
  out.id = 0;
  out.flags = 0;
}

}  // namespace

RayTracer::RayTracer(const Mesh& mesh, int threads) : state_(std::make_unique<State>()) {
  check_mesh(mesh);
  State& s = *state_;
  // More than there are: a smaller number would bound the whole process for as long as the device lives.
  s.device = rtcNewDevice("threads=1024,set_affinity=0");
  if (!s.device)
    throw OperationError(fmt::format("Embree does not start: {}", error_name(rtcGetDeviceError(nullptr))));
  rtcSetDeviceErrorFunction(
      s.device,
      [](void* user, RTCError code, const char* text) {
        std::string& error = static_cast<State*>(user)->error;
        if (error.empty()) error = fmt::format("{} ({})", error_name(code), text ? text : "");
      },
      &s);
  rtcSetDeviceMemoryMonitorFunction(
      s.device,
      [](void* user, ssize_t bytes, bool) {
        State& state = *static_cast<State*>(user);
        const std::int64_t now = state.bytes += bytes;
        std::int64_t peak = state.peak;
        while (now > peak && !state.peak.compare_exchange_weak(peak, now)) {
        }
        return true;
      },
      &s);
  s.scene = rtcNewScene(s.device);
  s.check("making the scene");
  // Robust: no ray slips between two quads that share an edge, at the price of 10 to 17 per cent. Without it 1 ray in
  // 800,000 gets out of a closed sphere of 200,000 triangles, and rows of camera rays that follow a row of quads lose
  // many.
  // With room for a function that lets rays pass (passed_each); where none is given it costs nothing that is
  // measured.
  rtcSetSceneFlags(s.scene, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  rtcSetSceneBuildQuality(s.scene, RTC_BUILD_QUALITY_MEDIUM);
  const RTCGeometry geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_QUAD);
  const std::vector<Vec3>* positions = &mesh.positions;
  // Embree loads 16 bytes for a vertex of 12.
  if (mesh.positions.capacity() == mesh.positions.size()) {
    s.positions.reserve(mesh.positions.size() + 1);
    s.positions = mesh.positions;
    positions = &s.positions;
  }
  if (!mesh.quads.empty()) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions->data(), 0,
                               sizeof(Vec3), positions->size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, mesh.quads.data(), 0,
                               sizeof(mesh.quads[0]), mesh.quads.size());
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(s.scene, geometry);
  rtcReleaseGeometry(geometry);
  s.check("taking over the mesh");
  in_threads(threads, [&] { rtcJoinCommitScene(s.scene); });
  s.check("building its tree");
}

RayTracer::~RayTracer() = default;
RayTracer::RayTracer(RayTracer&&) noexcept = default;

namespace {
constexpr float least_passed = 1e-6f;  // less light is none

// Slivers may return coordinates a little outside.
float inside(float x) {
  return x >= 0 ? std::min(x, 1.0f) : 0.0f;
}
}  // namespace

std::optional<Hit> RayTracer::closest_hit(const Ray& ray) const {
  if (!is_traceable(ray)) return std::nullopt;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  fill(query.ray, ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID || !std::isfinite(query.ray.tfar)) return std::nullopt;
  return Hit{query.ray.tfar, query.hit.primID, inside(query.hit.u), inside(query.hit.v)};
}

void RayTracer::closest_hits(std::span<const Ray> rays, Hit* hits, bool* found) const {
  alignas(64) int valid[packet_size];
  alignas(64) RTCRayHit16 packet;
  for (int k = 0; k < packet_size; ++k) {
    valid[k] = k < int(rays.size()) && is_traceable(rays[size_t(k)]) ? -1 : 0;
    // Lanes without a ray are never looked at; they hold a copy so that nothing is read unset.
    const Ray& ray = rays[valid[k] ? size_t(k) : 0];
    packet.ray.org_x[k] = ray.origin.x;
    packet.ray.org_y[k] = ray.origin.y;
    packet.ray.org_z[k] = ray.origin.z;
    packet.ray.dir_x[k] = ray.direction.x;
    packet.ray.dir_y[k] = ray.direction.y;
    packet.ray.dir_z[k] = ray.direction.z;
    packet.ray.tnear[k] = std::max(ray.t_min, 0.0f);
    packet.ray.tfar[k] = ray.t_max;
    packet.ray.time[k] = 0;
    packet.ray.mask[k] = 0xffffffffu;
    packet.ray.id[k] = packet.ray.flags[k] = 0;
    packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, state_->scene, &context, &packet);
  for (int k = 0; k < int(rays.size()); ++k) {
    found[k] = valid[k] && packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID && std::isfinite(packet.ray.tfar[k]);
    hits[k] = {packet.ray.tfar[k], packet.hit.primID[k], inside(packet.hit.u[k]), inside(packet.hit.v[k])};
  }
}

bool RayTracer::occluded(const Ray& ray) const {
  if (!is_traceable(ray)) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query;
  fill(query, ray);
  rtcOccluded1(state_->scene, &context, &query);
  return query.tfar < 0;
}

void RayTracer::occluded_each(std::span<const Ray> rays, bool* blocked) const {
  RTCRay stream[stream_size];
  for (size_t k = 0; k < rays.size(); ++k) {
    fill(stream[k], rays[k]);
    // A ray that ends before it starts is passed over.
    if (!is_traceable(rays[k])) {
      fill(stream[k], Ray{{0, 0, 0}, {0, 0, 1}, 0, 0});
      stream[k].tnear = 1;
    }
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1M(state_->scene, &context, stream, unsigned(rays.size()), sizeof(RTCRay));
  for (size_t k = 0; k < rays.size(); ++k) blocked[k] = stream[k].tfar < 0;
}

namespace {

/// What Embree hands to the function below with every surface that a ray meets.
struct PassingRay {
  RTCIntersectContext context;  // first, so that a pointer to it is one to the whole
  const RayTracer::ShareAt* share = nullptr;
  const Ray* ray = nullptr;
  float passed = 1;
};

void pass_surface(const RTCFilterFunctionNArguments* args) {
  auto& passing = *reinterpret_cast<PassingRay*>(args->context);
  const Hit hit{RTCRayN_tfar(args->ray, args->N, 0), RTCHitN_primID(args->hit, args->N, 0),
                inside(RTCHitN_u(args->hit, args->N, 0)), inside(RTCHitN_v(args->hit, args->N, 0))};
  passing.passed *= (*passing.share)(hit, *passing.ray);
  if (passing.passed < least_passed) passing.passed = 0;
  // A surface that is not met lets the ray go on.
  if (passing.passed > 0) args->valid[0] = 0;
}

}  // namespace

void RayTracer::passed_each(std::span<const Ray> rays, const ShareAt& share, float* passed) const {
  PassingRay passing;
  rtcInitIntersectContext(&passing.context);
  passing.context.filter = pass_surface;
  passing.share = &share;
  for (size_t k = 0; k < rays.size(); ++k) {
    passing.ray = &rays[k];
    passing.passed = 1;
    if (is_traceable(rays[k])) {
      // One by one: the surfaces come in an order that is the ray's own, and so do the roundings of the product.
      RTCRay query;
      fill(query, rays[k]);
      rtcOccluded1(state_->scene, &passing.context, &query);
    }
    passed[k] = passing.passed;
  }
}

std::int64_t RayTracer::memory_bytes() const {
  return state_->bytes + std::int64_t(state_->positions.capacity() * sizeof(Vec3));
}
std::int64_t RayTracer::peak_memory_bytes() const {
  return state_->peak;
}

}  // namespace sateen
