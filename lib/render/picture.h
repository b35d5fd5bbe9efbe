#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "image/color.h"
#include "image/file.h"
#include "render/render.h"

namespace sateen {

/// How a picture is shown: what display formats get and an EXR does not.
struct DisplaySettings {
  std::string display, view;         ///< empty: the config's defaults
  std::optional<float> exposure_ev;  ///< empty: as metered
  std::optional<Color> ground;       ///< code values of the display in [0, 1] behind the cloth; empty: paper
  bool transparent = false;          ///< alpha instead of a ground
};

/// Fills in the config's defaults. InputError for a display or view that the config does not have, or that it cannot
/// make from the working space.
DisplaySettings settle_display(DisplaySettings settings, const ColorManager& colors);

/// What of a view is surely not meant: a channel that is the same for every grey from dark to white, as a matrix of
/// zeros, of enormous numbers or of none makes it. Empty where nothing is.
std::string display_fault(const DisplaySettings& settled, const ColorManager& colors);

/// Code values of the photographer's paper behind the cloth, grey, the same on every display: light falls off from a
/// pool behind the object towards the corners. x and y in [0, 1] from the top left.
float paper_code(float x, float y);

/// Code values, 3 channels, or 4 with `transparent`. `beauty` is premultiplied RGBA in the working space. Cloth and
/// ground are joined as display light, after the view has been applied to the cloth, so that neither exposure nor
/// view changes the ground; edges are not darkened by highlights far beyond white.
Image develop_display(const Image& beauty, const ColorManager& colors, const DisplaySettings& settings,
                      float exposure_ev);
/// Of rows from `y0` on of a picture that is `height` high.
Image develop_display(const Image& beauty, const ColorManager& colors, const DisplaySettings& settings,
                      float exposure_ev, int y0, int height);

/// Kinds of file by extension, lower case, without the point.
bool is_exr(const std::filesystem::path& path);
const std::vector<std::string>& picture_extensions();

/// InputError where the extension is unknown; OperationError where no file can be made there. With `try_it` folders
/// that are missing are made and a file is created and removed again: some refuse for reasons that no look tells.
void check_picture_path(const std::filesystem::path& path, bool try_it = true);
/// The second half, for any kind of file.
void check_can_write(const std::filesystem::path& path, bool try_it = true);

/// Names of the layers beside the beauty, in the order of develop_layers().
const std::vector<std::string>& layer_names();

/// What a picture file is made of.
struct PictureContent {
  const Film* film = nullptr;
  Crop crop;                        ///< only this window is written
  std::vector<std::string> layers;  ///< beside the beauty, for an EXR
  DisplaySettings display;          ///< settled
  float exposure_ev = 0;
  Attributes attributes;
  const Image* overlay = nullptr;  ///< laid over the beauty: premultiplied RGBA of the film's size
};
struct WrittenPicture {
  std::filesystem::path path;
  int width = 0, height = 0, layers = 0;  ///< layers: 0 for display formats
  long long bytes = 0;
  HalfRange range;  ///< of an EXR
};

/// Writes one file by its extension, a band of rows at a time (image/bands.h): beside the film it takes the memory of
/// a few bands. OperationError where it cannot be written.
WrittenPicture write_picture(const std::filesystem::path& path, const PictureContent& content,
                             const ColorManager& colors);

/// What came of several files.
struct WrittenPictures {
  std::vector<WrittenPicture> written;  ///< in the order in which they were asked for
  std::vector<std::string> failures;    ///< one sentence a file that could not be written
};
/// Tries every one of them, side by side.
WrittenPictures write_pictures(const std::vector<std::string>& paths, const PictureContent& content,
                               const ColorManager& colors, int threads);

}  // namespace sateen
