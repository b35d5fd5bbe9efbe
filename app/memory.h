#pragma once
#include "picture_flags.h"

namespace sateen::app {

/// InputError where the sums of the picture's pixels alone are more than may be had: before anything is read.
void check_film_memory(const PictureFlags& flags);

/// InputError, with the numbers and what to change, where rendering and writing would take more than the machine, its
/// control group or a ulimit leaves over. Once the scene is there and counts as it is, and before the film is made;
/// `film_there`: it was read from a checkpoint. Loads what will write display pictures, so that it counts.
void check_picture_memory(const PictureFlags& flags, bool with_layers, bool film_there = false);

/// InputError where two of these checkpoints, as large as their files, are more than may be had.
void check_merge_memory(const std::vector<std::string>& checkpoints);

}  // namespace sateen::app
