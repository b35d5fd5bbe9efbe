#pragma once
#include <fmt/format.h>

#include <fstream>
#include <functional>
#include <memory>

#include "image/file.h"
#include "image/scratch_folder.h"
#include "look/read.h"
#include "scene/compile_cloth.h"

// Looks with textures that are made for a test.

namespace sateen_test {

struct MappedLooks {
  ScratchFolder folder;
  sateen::ColorManager colors{"built-in"};

  /// An OpenEXR file of floats, top row first, in linear Rec.709.
  void texture(const std::string& name, int width, int height,
               const std::function<sateen::Color(int, int)>& color) const {
    sateen::Image image(width, height, 3);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) image.at(x, y)[c] = color(x, y)[c];
    sateen::write_exr(folder.path / name, {{"", {"R", "G", "B"}, false, image}}, {},
                      sateen::ColorManager::Chromaticities{
                          {0.64f, 0.33f}, {0.3f, 0.6f}, {0.15f, 0.06f}, {0.3127f, 0.329f}});
  }

  sateen::Look look(const std::string& text, const std::string& name = "mapped.json") const {
    const std::string path = (folder.path / name).string();
    std::ofstream(path) << text;
    return sateen::parse_look(text, path);
  }

  sateen::CompiledSide compiled(const std::string& text, bool table = true, float metres_per_uv = 1) const {
    sateen::FabricParts parts;
    parts.table = table;
    parts.threads = 2;
    return sateen::compile_side(look(text), colors, parts, 0, metres_per_uv);
  }

  /// The InputError's text, or none.
  std::string error_in(const std::string& text) const {
    try {
      compiled(text, false);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "(no error)";
  }
};

}  // namespace sateen_test
