#include "mesh/shapes.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/nearest_name.h"
#include "mesh/shape_cages.h"

namespace sateen {

namespace {
struct Shape {
  const char* name;
  ControlMesh (*make)();
};
constexpr Shape all_shapes[] = {
    {"swatch", shapes::swatch},
    {"sphere", shapes::sphere},
    {"drape", shapes::drape},
    {"skirt", shapes::skirt},
};
}  // namespace

std::vector<std::string> built_in_shapes() {
  std::vector<std::string> names;
  for (const Shape& shape : all_shapes) names.push_back(shape.name);
  return names;
}

bool is_built_in_shape(const std::string& name) {
  for (const Shape& shape : all_shapes)
    if (name == shape.name) return true;
  return false;
}

ControlMesh built_in_shape(const std::string& name) {
  for (const Shape& shape : all_shapes)
    if (name == shape.name) return shape.make();
  throw InputError(fmt::format("no built-in shape is called {}", name), suggestion(name, built_in_shapes()));
}

}  // namespace sateen
