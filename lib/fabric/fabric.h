#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "fabric/direction_table.h"
#include "fabric/point_values.h"
#include "fabric/talk_sampler.h"
#include "fabric/threads.h"
#include "fabric/weave.h"
#include "look/look.h"

namespace sateen {

/// From a look's colour (with its space) to the working space.
using ToWorking = std::function<Color(const Color& value, const std::string& space)>;

/// A look compiled for rendering: radians, working-space colour, tables. Immutable.
struct Fabric {
  Threads<float> threads;
  std::array<Color, 2> A;  ///< volume colours of warp and weft, working space; solved where the look gives `color`
  DirectionTable table;
  TalkTangents talk;
  float warp_angle = 0;                           ///< [radians]
  float gap = 0;                                  ///< share of the cloth's area that no thread covers
  std::shared_ptr<const VaryingThreads> varying;  ///< where numbers of the threads differ from point to point
  Weave weave;                                    ///< empty: its threads never show one by one
  std::string name;
};

/// Ways to draw a direction from the fabric.
enum class FabricSampler { uniform, talk, table };

/// What one pair of directions gives. `f_cos` is F of cloth-model.md section 3: the integrand with its cosine inside
/// [1/sr].
struct BsdfValue {
  Color f_cos{0, 0, 0};
  float pdf = 0;  ///< of the sampler asked for, solid angle [1/sr]
};

/// What one sampler needs to know of a view, cloth frame. Small beside the threads' terms: a batch keeps many.
struct SamplerView {
  const Fabric* fabric = nullptr;
  FabricSampler sampler = FabricSampler::uniform;
  TableView table;
  TalkView talk;
};

/// View-only terms of one hit, cloth frame, shared by every light direction. Large: keep one a thread, reuse it.
struct FabricView {
  const Fabric* fabric = nullptr;
  std::array<Color, 2> A;                       ///< the fabric's or the point's
  const Threads<float>* own_threads = nullptr;  ///< the fabric's or `rewritten`
  ThreadView<float> threads;
  SamplerView sampler;
  Threads<float> rewritten;  ///< those of the point, as long as it belongs to `rewritten_from`
  std::shared_ptr<const VaryingThreads> rewritten_from;
};

/// Parts of a Fabric that are not always wanted.
struct FabricParts {
  bool table = true;     ///< the direction table: most of the compile time
  int threads = 1;       ///< for the table
  float quadrature = 1;  ///< how finely tangent curves are sampled, times the usual
  float table_size = 1;  ///< views of the table in either axis, times the usual
  /// Widths of the narrowest lobes of warp and weft that any point has, where narrower than the look's [radians].
  std::array<float, 2> narrowest{10, 10};
};

/// Compiles a look. InputError where a `color` cannot be reached: the message gives what is reachable.
Fabric compile_fabric(const Look& look, const ToWorking& to_working, const FabricParts& parts = {});

/// The look's own colours: no conversion whatever the space says (lobe values, tests).
Color same_space(const Color& value, const std::string& space);

/// `wo`: unit, cloth frame, wo.z > 0. The three prepare what evaluation, one sampler, or both need. `point`: what
/// textures say of the point; null where they say nothing. Samplers stay those of the whole fabric.
void prepare_threads(const Fabric& fabric, const Vec3& wo, FabricView& view, const PointValues* point = nullptr);
void prepare_sampler(const Fabric& fabric, const Vec3& wo, FabricSampler sampler, SamplerView& view);
void prepare_view(const Fabric& fabric, const Vec3& wo, FabricSampler sampler, FabricView& view,
                  const PointValues* point = nullptr);

Color evaluate(const FabricView& view, const Vec3& wi);
ThreadSums<float> evaluate_parts(const FabricView& view, const Vec3& wi);
/// With the yarn at a place that is seen from near.
ThreadSums<float> evaluate_parts(const FabricView& view, const YarnPlace& yarn, const Vec3& wi);
/// The colours of the view on its parts.
Color combine_parts(const FabricView& view, const ThreadSums<float>& parts);
float pdf(const SamplerView& view, const Vec3& wi);
BsdfValue evaluate_with_pdf(const FabricView& view, const Vec3& wi);

/// Numbers that `sample` wants, all in [0, 1).
struct FabricRandom {
  double choice = 0;                   ///< table: view slice; talk: unused
  std::array<double, 2> thread{0, 0};  ///< talk: tangent and lobe
  std::array<double, 2> direction{0, 0};
};

/// A direction drawn by the view's sampler; nullopt where it falls below the cloth (the talk's sampler alone).
std::optional<Vec3> sample(const SamplerView& view, const FabricRandom& u);

/// Reflectance for light from everywhere at a view: R = surface + A_warp volume[0] + A_weft volume[1], by midpoint
/// quadrature in theta and phi (192 x 96 points: error below 1e-3 for gamma_s >= 2 degrees).
struct Albedo {
  float surface = 0;
  std::array<float, 2> volume{0, 0};
  std::array<float, 2> surface_of{0, 0};  ///< what of `surface` is warp's and weft's
};
/// A coarser one (`thetas`, half as many phis) serves where an approximate value will do.
Albedo albedo(const Threads<float>& threads, const Vec3& wo, int thetas = 192);
Color albedo_color(const Fabric& fabric, const Vec3& wo, int thetas = 192);

}  // namespace sateen
