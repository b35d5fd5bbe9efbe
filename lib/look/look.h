#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "look/texture_value.h"
#include "math/vector.h"

namespace sateen {

/// A colour as authored: linear or encoded RGB in a named space; an empty space means the look's `color_space`.
struct ColorValue {
  Color value{0, 0, 0};
  std::string space;
};

/// One family of threads as authored (cloth-model.md sections 2 to 4). Degrees; A is the raw RGB scale of the
/// volume term. `color` wins over A where it is given: A is then solved so that the cloth would show `color` under
/// white light at normal view if both families had that colour.
struct ThreadFamily {
  float eta = 1.46f;       ///< index of refraction, 1 to 3
  float k_d = 0.3f;        ///< isotropic share of the volume term, 0 to 1
  float gamma_s_deg = 12;  ///< width of the surface lobe (standard deviation), 0.5 to 90
  float gamma_v_deg = 24;  ///< width of the volume lobe, 0.5 to 180
  float coverage = 0.5f;   ///< a_j, share of the cloth's area, 0 to 1
  ColorValue A{Color(0.3f, 0.3f, 0.3f), {}};
  std::optional<ColorValue> color;
  std::vector<float> offsets_deg{0, 0};  ///< tangent offsets o_0 ... o_k, -90 to 90
  std::vector<float> lengths{1};         ///< l_0 ... l_{k-1}, not negative, not all 0
};

/// How the threads cross, for cloth that is seen from so near that they show (fabric/weave.h). The far picture does
/// not depend on it.
struct WeaveSettings {
  std::vector<std::string> draft;  ///< see look/draft.h; empty: no threads are shown
  float warp_per_cm = 30;          ///< warp threads side by side, 0.5 to 500
  float weft_per_cm = 30;
  float irregularity = 0;  ///< how far the threads' edges stray, as a share of their spacing, 0 to 0.4
  float slubs = 0;         ///< how much thick places of the weft push their neighbours aside, 0 to 1
  std::vector<std::string> draft_warnings;  ///< what is to be told of a WIF file's draft; not part of the look
};

/// A fabric as authored: human units, a default on every field. Warp runs along x = dP/du, weft along y.
struct Look {
  std::string name;  ///< file name without extension
  std::string title;
  std::string description;
  std::string source;  ///< where the numbers come from
  std::string color_space = "lin_rec709";
  ThreadFamily warp, weft;
  WeaveSettings weave;
  float masking_width_deg = 20;  ///< sigma of u in M and P (2013: 15 to 25), 5 to 60
  float warp_angle_deg = 0;      ///< turns the warp about the normal, from dP/du towards dP/dv, -180 to 180
  std::string back;              ///< name or path of another look for the back of the cloth; empty: the same

  /// Another look is woven in where the mask is 1; in between, both in these shares. Its own back and pattern do not
  /// count.
  float pattern_mask = 0;
  std::string pattern_look;

  /// Textures by the path of the field that each stands for ("warp.color"); that field then holds
  /// what shows where the picture is transparent: its value in the look that is inherited, or the texture's `under`.
  std::map<std::string, TextureValue> textures;

  std::string file;  ///< where it was read from; not part of the look's hash
};

}  // namespace sateen
