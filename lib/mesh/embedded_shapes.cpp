#include "mesh/embedded_shapes.h"

#include <string>

#include "mesh/obj.h"
#include "mesh/shape_cages.h"

// The assembler takes the files in as they are: no generated source of a megabyte to compile.
#define SATEEN_EMBED(name)                          \
  asm(".pushsection .rodata\n"                      \
      ".hidden sateen_" #name "_obj, sateen_" #name \
      "_obj_end\n"                                  \
      ".globl sateen_" #name "_obj, sateen_" #name  \
      "_obj_end\n"                                  \
      "sateen_" #name                               \
      "_obj:\n"                                     \
      ".incbin \"" SATEEN_SHAPES_DIR "/" #name      \
      ".obj\"\n"                                    \
      "sateen_" #name                               \
      "_obj_end:\n"                                 \
      ".popsection\n");                             \
  extern "C" __attribute__((visibility("hidden"))) const char sateen_##name##_obj[], sateen_##name##_obj_end[]

SATEEN_EMBED(drape);
SATEEN_EMBED(skirt);

namespace sateen {

std::string_view embedded_shape(std::string_view name) {
  if (name == "drape") return {sateen_drape_obj, sateen_drape_obj_end};
  if (name == "skirt") return {sateen_skirt_obj, sateen_skirt_obj_end};
  return {};
}

namespace shapes {
namespace {
ControlMesh in_metres(const std::string& name) {
  ControlMesh cage = parse_obj(embedded_shape(name), name);
  cage.metres_per_uv = 1;
  cage.name = name;
  return cage;
}
}  // namespace

ControlMesh drape() {
  return in_metres("drape");
}
ControlMesh skirt() {
  return in_metres("skirt");
}

}  // namespace shapes

}  // namespace sateen
