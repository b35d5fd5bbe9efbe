#pragma once
#include <span>

#include "scene/footprint.h"
#include "scene/scene.h"

namespace sateen {

/// The largest pixel, in scene units at the cloth, in which threads show one by one somewhere on the cloth: with
/// larger ones everything is the threads' mean. 0 where no side of the cloth has a weave.
float near_weave_pixel(const Scene& scene);

/// Whether a point at this depth (along the camera's axis) may be seen from so near that its threads show.
bool may_show_yarns(const Scene& scene, float depth);

/// Whether threads may show somewhere in the picture: never false where place_yarn() would show one. By a bound for
/// each quad that lies in the view, whatever hides it; where the object turns under a shutter, or `from_all_around`,
/// by how near the camera stands to the mesh's bounding sphere.
bool may_show_yarns(const Scene& scene, bool from_all_around = false);

/// Finds the yarn of a point that a camera ray met, and how much of it shows: nothing where a yarn fills less than a
/// pixel, everything where it fills three, by the direction in which it looks narrowest.
void place_yarn(const Scene& scene, const Footprint& pixel, ClothPoint& point);

/// Share of one yarn in a picture in which it is `pixels` wide: 0 up to 1, 1 from 3, smooth and never falling.
float near_share(float pixels);

}  // namespace sateen
