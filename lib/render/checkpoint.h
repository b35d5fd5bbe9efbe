#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "render/metadata.h"
#include "render/render.h"

namespace sateen {

/// A render that stopped, whole: every sum of the film, where its samples were going, and what it was of.
struct Checkpoint {
  std::vector<Fact> facts;         ///< sampling_facts() of its job
  std::vector<std::string> words;  ///< of the command line that began it
  std::string plan;                ///< plan_json() of its job: who decided what, and why
  std::string candidates_reason;   ///< of its job
  Film film;
  Course course;
};

/// Whole or not at all. About 120 bytes a pixel, with layers 250.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// InputError (unreadable) where the file is missing, damaged, or no checkpoint of this version.
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// InputError that names each fact in which the checkpoint at `path` is of another job than `now`.
void check_same_job(const std::filesystem::path& path, const std::vector<Fact>& then, const std::vector<Fact>& now);

/// Renders of the same job over ranges of samples that follow on each other, joined into one: the bits of a single
/// render of all, but for the layers beside the beauty, which agree to float's roundings. In any order. InputError
/// where jobs differ, ranges overlap or leave a gap, a render is not uniform or did not finish its range.
Checkpoint merge_checkpoints(const std::vector<std::filesystem::path>& paths);

}  // namespace sateen
