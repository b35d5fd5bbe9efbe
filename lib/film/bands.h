#pragma once
#include <algorithm>

#include "base/parallel.h"
#include "film/film.h"

namespace sateen {

/// The rows of a film from y0 to y1, without layers.
inline Film film_rows(const Film& film, int y0, int y1) {
  Film part(film.width, y1 - y0, false);
  part.opaque = film.opaque;
  std::copy_n(film.pixels.begin() + std::ptrdiff_t(y0) * film.width, part.pixels.size(), part.pixels.begin());
  return part;
}

/// Goes through a film in bands of rows, several at a time, so that what is worked out of every pixel need not be
/// kept of all. body(part, skip, y0, y1): `part` holds the rows from y0 to y1 with up to `margin` more above, `skip`
/// of them, and below. Layers are not copied.
template <class Body>
void for_each_band(const Film& film, int margin, int threads, const Body& body) {
  constexpr int rows = 32;
  parallel_for((film.height + rows - 1) / rows, threads, [&](int band) {
    const int y0 = band * rows, y1 = std::min(y0 + rows, film.height);
    const int top = std::max(y0 - margin, 0), bottom = std::min(y1 + margin, film.height);
    body(film_rows(film, top, bottom), y0 - top, y0, y1);
  });
}

}  // namespace sateen
