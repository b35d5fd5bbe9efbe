#pragma once
#include <string>
#include <vector>

#include "image/color.h"
#include "scene/filter.h"
#include "scene/scene.h"

namespace sateen {

struct SceneSettings;

/// How closely the renderer works where it approximates, as a user asks for it. Each has a price (study/cost.h).
struct Approximations {
  float quadrature = 1;   ///< of tangent curves: panels so many times as short as usual, 0.125 to 8
  float table_size = 1;   ///< of the direction table: so many times the usual views in either axis, 0.125 to 4
  int map_size = 0;       ///< a wider map is shrunk to so many texels across, 8 to 65536; 0: never
  FilterSettings filter;  ///< of pixels
};

/// One of them: what flags, metadata and price lists know of it. A new one is one entry of the list and its use.
struct Approximation {
  std::string flag;   ///< "--map-size"
  std::string value;  ///< of the flag, as help shows it
  std::string help;
  std::string name;  ///< "map size", in facts and price lists; with _ in metadata
  bool biased;       ///< a coarse setting changes what the picture converges to; else its noise and time alone
  bool advised;      ///< qualities may choose a coarser one: it saves time
  std::string note;  ///< to the price list

  void (*read)(const std::string& text, Approximations& to);  ///< InputError where it is none
  std::string (*text)(const Approximations& of);              ///< as `read` takes it
  /// Settings to price in this scene, the finest last; what is asked for is among them.
  std::vector<std::string> (*ladder)(const Approximations& asked, const Scene& scene);
  /// Makes the part of a scene anew that it decides over, as assemble_scene() would; effects that a plan took out of
  /// it are there again.
  void (*rebuild)(const SceneSettings& settings, const ColorManager& colors, Scene& scene);
};
const std::vector<Approximation>& approximation_list();

}  // namespace sateen
