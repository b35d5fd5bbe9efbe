#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "picture_flags.h"

namespace sateen::app {

PictureJob make_job(const PictureFlags& flags, const SceneReport& report, const Scene& scene,
                    const ColorManager& colors, const std::string& words);

/// What is about to be rendered, in a few lines, and every warning of the assembly.
void print_scene(const PictureFlags& flags, const PictureJob& job, const SceneReport& report);

/// What --dry-run says; returns the exit code.
int report_dry_run(const PictureFlags& flags, const PictureJob& job, const SceneReport& report);

/// What was written and how good it is, for people, for --json and for --stats.
void report_picture(const PictureFlags& flags, const PictureJob& job, const SceneReport& report,
                    const RenderResult& result, const std::vector<WrittenPicture>& written, int code);

/// Where progress goes: farms read standard output, people standard error.
std::function<void(std::string_view)> progress_writer(ProgressStyle style);

}  // namespace sateen::app
