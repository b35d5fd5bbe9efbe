#pragma once
#include <string>
#include <vector>

#include "render/assemble.h"
#include "render/picture.h"
#include "render/verify.h"

namespace sateen {

/// One picture as it was asked for.
struct PictureJob {
  SceneSettings scene;
  RenderSettings render;
  DisplaySettings display;          ///< settled
  float exposure_ev = 0;            ///< in force
  std::vector<std::string> layers;  ///< of an EXR, beside the beauty
  Plan plan;
  std::string candidates_reason;  ///< of LightSettings::candidates; empty where nothing was tried
  std::vector<Verdict> verdicts;  ///< of --verify-plan
  std::string effects;            ///< in force, "gaps,self-shadowing"
  std::string color_config;       ///< ColorManager::description()
  std::string working_space;
  std::string version, command_line;
  int first_sample = 0;     ///< number of a pixel's first sample
  bool references = false;  ///< balls and chart laid over the picture
  bool timings = false;     ///< times go into the attributes: then no two files are alike
  std::string turn;         ///< of a turntable's frame, "object 40"; empty for a still
};

/// One thing that decides what samples see. `shown`: how people are told of the value; empty: as it is.
struct Fact {
  std::string name, value, shown;
};

/// Everything that decides the samples of a pixel: look, mesh, map, camera, sampling. Not how many there are, nor how
/// they are shown. Two renders of which all these agree can be joined and gone on with.
std::vector<Fact> sampling_facts(const PictureJob& job, const SceneReport& report);

/// Hash of everything that decides the pixels: look, mesh, map, camera, sampling, colour, the program's version. Not
/// the number of threads, the files' names or the command line.
std::string job_hash(const PictureJob& job, const SceneReport& report);

/// The `sateen:*` attributes of a finished picture (docs/attributes.md lists them) and Software. Without `timings`
/// they hold nothing of clock, machine or threads: of equal pictures they are equal.
Attributes picture_attributes(const PictureJob& job, const SceneReport& report, const RenderResult& result);

/// A name with _ for its blanks, as attributes and JSON have it.
std::string underscored(std::string name);

/// "samples", "error", "time", "interrupted".
std::string stop_reason_text(StopReason reason);

/// Where pictures that are not finished go: a file that holds anything but an earlier unfinished picture of this
/// program is not given up for one, and "a.exr" becomes "a.partial.exr". What is finished says so in its attributes:
/// `stopped_by` is another than "interrupted". A file without them is somebody's, unless it is empty.
/// `always`: also where nothing is there yet.
std::vector<std::string> partial_names(const std::vector<std::string>& paths, bool always = false);

/// True where the file decodes, carries this job's hash, and was finished: with `spp` asked, at that many samples.
bool is_finished_picture(const std::filesystem::path& path, const std::string& hash, const StopRules& stop);

}  // namespace sateen
