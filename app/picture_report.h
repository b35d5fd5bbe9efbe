#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "look/json_writer.h"
#include "picture_flags.h"
#include "render/references.h"

namespace sateen::app {

/// What is about to be rendered, in a few lines, and every warning of the assembly.
void print_scene(const PictureFlags& flags, const PictureJob& job, const SceneReport& report);

/// The balls and the chart where they were asked for, and what they measure, for people and for --stats.
std::optional<References> references_of(const PictureFlags& flags, const PictureJob& job, const Scene& scene,
                                        const ColorManager& colors);
void print_references(const References& references);
void write_references(JsonWriter& w, const References& references);

/// What --dry-run says; returns the exit code.
int report_dry_run(const PictureFlags& flags, const PictureJob& job, const SceneReport& report);

/// Members of an open JSON object: what was asked for and found out; how rendering went.
void write_job(JsonWriter& w, const PictureFlags& flags, const PictureJob& job, const SceneReport& report);
void write_result(JsonWriter& w, const RenderResult& result, const WrittenPictures& pictures);
/// To --stats and, with --json, to standard output.
void write_stats(const PictureFlags& flags, const std::string& json);

/// A warning where half floats hold too little of a file's colours; `remedy` ends its sentence.
void warn_of_half_floats(const std::string& file, const HalfRange& range, const std::string& remedy);

/// One line a file.
void print_written(const PictureJob& job, const WrittenPicture& file);
/// Samples, time, error and the rule that stopped; complaints about samples that were not finite.
void print_result_line(const PictureJob& job, const RenderResult& result);

/// "E 1 % in 41 s (36 to 47), 80 CPU-s": said once, early on.
void print_promise(const PictureJob& job, const Promise& promise);

/// The exit code that a finished picture asks for.
int picture_code(const PictureFlags& flags, const RenderResult& result);

/// Where progress goes: farms read standard output, people standard error.
std::function<void(std::string_view)> progress_writer(ProgressStyle style);

}  // namespace sateen::app
