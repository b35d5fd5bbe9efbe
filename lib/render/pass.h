#pragma once
#include <functional>

#include "render/albedo_map.h"
#include "render/render.h"

namespace sateen {

/// Work of a sample of that pixel, as far as it is known where it leads: 1 where it meets cloth.
double sample_work(const FilmPixel& pixel);

/// Work of all samples in the film, mean over its pixels.
double work_of(const Film& film);

/// Work that brings the pixels from where they are to their parts of their targets at `samples`, mean over the
/// pixels.
double pass_work(const Film& film, const Course& course, int samples);

/// One pass: every pixel of the window is brought to its part of its target at `samples` mean samples. `tell` hears
/// the share of the work that is done; `stop` is asked between rows of pixels. Returns false where it stopped; called
/// again with the same arguments it goes on, and the bits are those of a pass that never stopped.
bool render_pass(const Scene& scene, const RenderSettings& settings, const AlbedoMaps& albedo, Film& film,
                 Course& course, int samples, const std::function<bool()>& stop,
                 const std::function<void(double)>& tell);

}  // namespace sateen
