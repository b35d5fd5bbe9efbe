#pragma once
#include <functional>
#include <string>
#include <vector>

#include "film/film.h"
#include "image/file.h"

namespace sateen {

/// Premultiplied RGBA of the picture, working space, scene-linear: all rows, or those from y0 to y1.
Image develop_beauty(const Film& film);
Image develop_beauty(const Film& film, int y0, int y1);

/// The layers of an EXR: beauty (half), then as the film holds them (float) direct, indirect, indirect_1 to _3 by
/// bounce and indirect_more, through_gaps, backdrop, surface, volume, warp_surface, warp_volume, weft_surface,
/// weft_volume, albedo, N, P, uv, warp, error (per channel, standard error from the pixel and its neighbours; 2.2 of
/// it to either side are 95 %), samples. Geometric layers are means over the samples that met cloth, 0 where none
/// did.
std::vector<ImageLayer> develop_layers(const Film& film);

/// The same values for the rows from y0 to y1 alone, and of the layers beside the beauty those that are `wanted`.
std::vector<ImageLayer> develop_layers(const Film& film, int y0, int y1,
                                       const std::function<bool(const std::string& name)>& wanted);

/// Beauty over a backdrop of one colour: what a display picture shows. `ground` in the working space.
Image composite(const Image& beauty, const Color& ground);

}  // namespace sateen
