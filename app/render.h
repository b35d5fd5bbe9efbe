#pragma once
#include <string>
#include <vector>

#include "picture_flags.h"

namespace sateen::app {

/// What `render` alone is told.
struct RenderFlags {
  PictureFlags picture;
  std::string checkpoint, resume;
  int first_sample = 0;
  double checkpoint_every = 300;  ///< seconds
  bool adaptive_given = false;
};

/// Reads and settles the words behind `sateen render`; false where help was asked for and printed.
bool read_render_flags(const std::vector<std::string>& words, RenderFlags& flags);

}  // namespace sateen::app
