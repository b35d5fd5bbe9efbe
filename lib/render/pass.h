#pragma once
#include <functional>

#include "render/albedo_map.h"
#include "render/render.h"

namespace sateen {

/// One pass: every pixel of the window is brought to its part of its target at `samples` mean samples. `tell` hears
/// the share that is done; `stop` is asked between rows of pixels. Returns false where it stopped; called again with
/// the same arguments it goes on, and the bits are those of a pass that never stopped.
bool render_pass(const Scene& scene, const RenderSettings& settings, const AlbedoMaps& albedo, Film& film,
                 Course& course, int samples, const std::function<bool()>& stop,
                 const std::function<void(double)>& tell);

}  // namespace sateen
