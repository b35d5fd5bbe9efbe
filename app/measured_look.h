#pragma once
#include <string>
#include <vector>

#include "look/look.h"
#include "render/lobe_figure.h"

namespace sateen::app {

/// A look compiled for printing its numbers: in the linear space that its own colours stand in, or `working`. Where
/// textures stand for values, of their means.
struct MeasuredLook {
  Look look;
  Fabric fabric;
  std::string space;
  std::vector<std::string> warnings;  ///< of its draft and its textures
};
MeasuredLook measure_look(const Look& look, bool with_table, const std::string& ocio = {},
                          const std::string& working = {});

}  // namespace sateen::app
