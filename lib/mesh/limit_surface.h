#pragma once
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>
#include <vector>

#include "mesh/control_mesh.h"
#include "mesh/surface_sample.h"

namespace sateen {

/// What OpenSubdiv has against a cage; subdivide() then falls back to the cage itself.
struct Refusal {
  std::string reason;
};

/// The cage's control points moved and scaled into a box of about unit size (by a power of two, so that nothing is
/// lost), because derivatives of a small shape far from the origin would drown in rounding. UVs likewise.
struct ControlPoints {
  std::vector<Vec3> positions;
  std::vector<Vec2> uvs;  ///< with one more at the end for corners that have none; empty when no corner has any
  Vec3 centre{0, 0, 0};
  Vec2 uv_centre{0, 0};
  float scale = 1, uv_scale = 1;  ///< multiply to come back
};
ControlPoints control_points(const ControlMesh& cage);

/// OpenSubdiv's view of the cage. Throws Refusal.
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> cage_topology(const ControlMesh& cage, const ControlPoints& points);

/// Evaluates the limit surface face by face. One object for all threads; a Patch for each.
class LimitSurface {
 public:
  LimitSurface(const OpenSubdiv::Far::TopologyRefiner& refiner, const ControlPoints& points, int level);
  ~LimitSurface();

  bool has_limit(int face) const;

  class Patch {
   public:
    explicit Patch(const LimitSurface& surface);
    ~Patch();
    void set_face(int face);  ///< throws Refusal
    /// Coordinates as in Bfr::Parameterization; `towards` is an inner point of the same smooth piece, used for the
    /// derivatives where they vanish at (s, t) itself, as at a rounded corner.
    SurfaceSample evaluate(const Vec2& st, const Vec2& towards) const;

   private:
    struct State;
    std::unique_ptr<State> state_;
  };

 private:
  friend class Patch;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sateen
