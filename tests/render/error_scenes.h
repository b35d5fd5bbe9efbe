#pragma once
#include <string>
#include <vector>

#include "render/pictures.h"

// The scenes that claims about errors are held against: looks x maps x meshes. Small suns and thin lobes among them,
// where few samples carry much of the light and tails are heavy.

namespace sateen_test {

struct ErrorScene {
  const char *look, *mesh, *map;
  int bounces = 0;
  bool background = false;  ///< half of the picture or more is empty
};

inline const std::vector<ErrorScene>& error_scenes() {
  static const std::vector<ErrorScene> all{
      {"champagne_silk_satin", "drape", "studio_softboxes"},
      {"champagne_silk_satin", "drape", "low_sun"},
      {"emerald_satin", "skirt", "three_light_rig", 0, true},
      {"emerald_satin", "sphere", "low_sun", 0, true},
      {"black_charmeuse", "drape", "studio_softboxes"},
      {"black_charmeuse", "skirt", "low_sun", 0, true},
      {"ivory_duchess_satin", "drape", "overcast"},
      {"ivory_duchess_satin", "swatch", "low_sun"},
      {"linen_plain", "drape", "overcast"},
      {"linen_plain", "skirt", "studio_softboxes", 0, true},
      {"velvet", "sphere", "low_sun", 0, true},
      {"velvet", "drape", "studio_softboxes"},
      {"crimson_velvet", "skirt", "three_light_rig", 0, true},
      {"velvet_red", "drape", "overcast"},
      {"silk_crepe_de_chine", "drape", "studio_softboxes"},
      {"silk_crepe_de_chine", "skirt", "low_sun", 0, true},
      {"polyester_satin_charmeuse", "drape", "three_light_rig"},
      {"polyester_satin_charmeuse", "sphere", "studio_softboxes", 0, true},
      {"polyester_satin_charmeuse_back", "drape", "overcast"},
      {"silk_shot", "drape", "low_sun"},
      {"shot_taffeta", "swatch", "three_light_rig"},
      {"midnight_silk", "drape", "low_sun"},
      {"habotai", "skirt", "overcast", 0, true},
      {"pewter_satin", "sphere", "three_light_rig", 0, true},
      {"dupioni", "drape", "studio_softboxes"},
      {"rose_gold_satin", "skirt", "low_sun", 2, true},
  };
  return all;
}

inline std::string name_of(const ErrorScene& s) {
  return std::string(s.look) + ", " + s.mesh + ", " + s.map + (s.bounces > 0 ? ", bounces" : "");
}

inline sateen::Scene scene_of(const ErrorScene& s, int width, int height) {
  sateen::SceneSettings settings = scene_settings(s.look, width, height);
  settings.mesh = s.mesh;
  settings.environment = map_path(s.map);
  settings.level = 2;
  return scene_of(settings);
}

}  // namespace sateen_test
