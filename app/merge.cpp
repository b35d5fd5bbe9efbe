#include <fmt/format.h>

#include "assembly.h"
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "memory.h"
#include "outputs.h"
#include "picture_report.h"
#include "render.h"
#include "render/checkpoint.h"

namespace sateen::app {

namespace {
/// The command line of one render of all that was merged.
std::vector<std::string> words_of_whole(const std::vector<std::string>& words, int samples) {
  std::vector<std::string> whole;
  size_t last_samples = 0;  // behind the last of several, which counts
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string name = words[i].substr(0, words[i].find('='));
    const bool value_follows = name.size() == words[i].size() && i + 1 < words.size();
    const bool of_samples = name == "-s" || name == "--spp";
    if (name == "--samples-from") {
      i += value_follows;
      continue;
    }
    whole.push_back(of_samples ? name : words[i]);
    if (!of_samples) continue;
    whole.push_back(value_follows ? words[++i] : words[i].substr(name.size() + 1));
    last_samples = whole.size();
  }
  if (last_samples == 0) {
    whole.insert(whole.end(), {"-s", ""});
    last_samples = whole.size();
  }
  whole[last_samples - 1] = std::to_string(samples);
  return whole;
}
}  // namespace

int run_merge(const std::vector<std::string>& words) {
  std::vector<std::string> inputs, outputs;
  std::string checkpoint;
  Command command("merge", "Joins renders of the same picture over different ranges of samples into one.",
                  "CHECKPOINT CHECKPOINT... -o FILE");
  command.arguments("CHECKPOINT", inputs, 1, 100000,
                    "of render --samples-from N --spp M --checkpoint FILE, in any order");
  command.group("Output");
  command.texts("-o,--output", "FILE", outputs, "repeatable; the extension picks the format: exr, png, jpg, tif");
  command.text("--checkpoint", "FILE", checkpoint, "keeps the joined sums, to merge or go on with");
  command.flag("--json", voice.json, "prints what was done as JSON, and nothing else, on standard output");
  command.paragraph(
      "The result has the bits of one render of all samples; only the layers beside the beauty are added up as "
      "floats and agree to their roundings. Ranges must follow on each other. The scene is read as the first command "
      "line named it, from the same folder.");
  command.example("sateen render -s 128 -o a.png --checkpoint a.checkpoint", "samples 0 to 127, here");
  command.example("sateen render -s 128 --samples-from 128 -o b.png --checkpoint b.checkpoint",
                  "128 to 255, elsewhere");
  command.example("sateen merge a.checkpoint b.checkpoint -o both.exr", "one picture of 256 samples");
  if (!command.parse(words)) return done;
  if (outputs.empty() && checkpoint.empty())
    throw InputError("merge has nothing to write", "add -o FILE.exr or --checkpoint FILE");
  for (const std::string& output : outputs) check_picture_path(output, false);
  const std::vector<NamedFile> to_write = named_outputs(outputs, {{"--checkpoint", checkpoint}});
  std::vector<NamedFile> to_read;
  for (const std::string& input : inputs) to_read.push_back({"checkpoint", input});
  check_not_read(to_write, to_read);
  for (const NamedFile& file : to_write) check_can_write(file.path);

  check_merge_memory(inputs);
  const Checkpoint sum = merge_checkpoints({inputs.begin(), inputs.end()});
  RenderFlags flags;
  read_render_flags(sum.words, flags);
  PictureFlags& p = flags.picture;
  p.outputs = outputs;
  p.verify_plan = false;
  keep_strategy(p, sum.facts);
  auto [colors, report, scene, job] =
      assemble_picture(p, recorded_line("render", words_of_whole(sum.words, sum.course.samples)), &sum);
  check_not_read(to_write, config_input(p.ocio));
  job.render.stop = {};
  job.render.stop.spp = sum.course.samples;
  job.first_sample = int(sum.film.first_sample);
  check_picture_memory(p, !sum.film.layers.empty(), true);
  check_same_job(inputs[0], sum.facts, sampling_facts(job, report));

  RenderResult result;
  result.samples = sum.course.samples;
  const std::vector<PixelError> errors = pixel_errors(sum.film, {job.render.error_floor, job.render.threads});
  result.error = picture_error(sum.film, errors);
  result.deviation = deviation_of_share(sum.film, errors);
  result.seconds = result.total_seconds = sum.course.seconds;
  result.cpu_seconds = result.total_cpu_seconds = sum.course.cpu_seconds;
  result.rays = sum.course.rays;
  PictureContent content{
      &sum.film,   job.render.crop, sum.film.layers.empty() ? std::vector<std::string>() : job.layers,
      job.display, job.exposure_ev, picture_attributes(job, report, result)};
  const std::optional<References> references = references_of(p, job, scene, colors);
  if (references) content.overlay = &references->overlay;
  Endings endings;
  if (!checkpoint.empty()) endings.attempt([&] { write_checkpoint(checkpoint, sum); });
  const WrittenPictures pictures = write_pictures(outputs, content, colors, job.render.threads);
  endings.tell(job, pictures);
  print_result_line(job, result);
  if (references) print_references(*references);
  const int code = endings.code(done);
  if (voice.json) {
    JsonWriter w;
    w.open_object();
    write_job(w, p, job, report);
    write_result(w, result, pictures);
    if (references) write_references(w, *references);
    print_result(w.member("exit_code", code).close().text());
  }
  return code;
}

}  // namespace sateen::app
