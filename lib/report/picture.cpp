#include <cairo/cairo.h>

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "report/page.h"

namespace sateen {

namespace {
cairo_status_t append(void* to, const unsigned char* data, unsigned count) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), count);
  return CAIRO_STATUS_SUCCESS;
}
}  // namespace

std::string picture_uri(const Image& image) {
  using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height),
                        cairo_surface_destroy);
  cairo_surface_flush(surface.get());
  unsigned char* const rows = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; rows && y < image.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(rows + std::ptrdiff_t(y) * stride);
    for (int x = 0; x < image.width; ++x) {
      row[x] = 0;
      for (int c = 0; c < 3; ++c)
        row[x] = row[x] << 8 | std::uint32_t(std::clamp(image.at(x, y)[c], 0.0f, 1.0f) * 255 + 0.5f);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  std::string bytes;
  if (!rows || cairo_surface_write_to_png_stream(surface.get(), append, &bytes) != CAIRO_STATUS_SUCCESS)
    throw OperationError("a picture of a page could not be made: not enough memory");
  return data_uri("image/png", bytes);
}

}  // namespace sateen
