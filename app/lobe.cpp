#include <fmt/format.h>

#include <cmath>

#include "base/files.h"
#include "command.h"
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "fabric/lobe_values.h"
#include "look/json_writer.h"
#include "look/read.h"
#include "measured_look.h"
#include "outputs.h"
#include "render/picture.h"

namespace sateen::app {

namespace {
void print_table(const MeasuredLook& measured) {
  std::string text = fmt::format("{}, {}: F = f cos\n  {:<9} {:<20} {:>10}  at light\n", measured.look.name,
                                 measured.space, "view", "albedo", "peak /sr");
  JsonWriter w;
  w.open_object().member("look", measured.look.name).member("space", measured.space).key("views").open_list();
  for (const PlaneDirection& view : table_views()) {
    const LobeSummary s = summarise_lobe(measured.fabric, view);
    const Vec3& d = s.peak_direction;
    text += fmt::format("  {:<9} {:.3f} {:.3f} {:.3f}  {:>12.4g}  {:.1f} from the normal, ({:.3f}, {:.3f}, {:.3f})\n",
                        view.text(), s.albedo.x, s.albedo.y, s.albedo.z, s.peak,
                        degrees(std::acos(std::min(d.z, 1.0f))), d.x, d.y, d.z);
    w.open_object().member("angle_deg", view.angle_deg).member("along", view.along_weft ? "weft" : "warp");
    w.key("albedo").open_list().value(s.albedo.x).value(s.albedo.y).value(s.albedo.z).close();
    w.member("peak", s.peak).key("peak_direction").open_list().value(d.x).value(d.y).value(d.z).close().close();
  }
  w.close().close();
  print_result(voice.json ? w.text() : text);
}
}  // namespace

int run_lobe(const std::vector<std::string>& words) {
  std::vector<std::string> names, overrides;
  std::string pairs, output, sampler = "table", working, ocio;
  Command command("lobe", "Draws and prints how a look scatters light, or evaluates it for pairs of directions.",
                  "LOOK [-o PICTURE | --pairs FILE -o FILE] [flags]");
  command.paragraph(
      "With --pairs: FILE is {\"rows\": [{\"wi\": [x, y, z], \"wo\": [x, y, z]}, ...]}, unit directions with x along "
      "the warp, y along the weft, z the cloth's normal. The answer is {\"rows\": [{\"f\": [r, g, b], \"pdf\": p}, "
      "...]} in the same order: f with its cosine inside [1/sr], pdf of the sampler by solid angle [1/sr].");
  command.arguments("LOOK", names, 1, 1, "name or file");
  command.texts("--set", "PATH=VALUE", overrides, "changes one field of the look; repeatable");
  command.text("--pairs", "FILE", pairs, "directions to evaluate, as JSON");
  command.text("-o,--output", "FILE", output,
               "the picture (png, svg, tif, jpg), or with --pairs the values (else printed)");
  command.text("--sampler", "NAME", sampler, "whose pdf: uniform, talk or table (default)");
  command.text("--working", "NAME", working, "colour space of f (default: the look's own, linear)");
  command.text("--ocio", "FILE", ocio, "colour config, or built-in (default: $OCIO, else built-in)");
  command.flag("--json", voice.json, "the table as JSON");
  command.example("sateen lobe polyester_satin_charmeuse -o lobe.png",
                  "slices and hemispheres, and the table on the screen");
  command.example("sateen lobe silk_shot --pairs pairs.json -o values.json", "values for other programs");
  if (!command.parse(words)) return done;
  const FabricSampler chosen = sampler_from_name(sampler);
  if (pairs.empty() && !output.empty() && !output.ends_with(".svg")) check_picture_path(output);
  if (pairs.empty() && output.ends_with(".exr"))
    throw InputError("a drawing is not written as EXR", "use .png or .svg");

  const Look look = read_look(names[0], overrides);
  std::vector<NamedFile> inputs = config_input(ocio);
  if (!pairs.empty()) inputs.push_back({"list of pairs", pairs});
  check_not_read({{"--output", output}}, inputs);
  if (pairs.empty()) {
    const MeasuredLook measured = measure_look(look, false, ocio, working);
    print_table(measured);
    if (!output.empty()) {
      write_figure(output, lobe_figure(measured.fabric, look.title.empty() ? look.name : look.title));
      if (!voice.json) print_note("wrote " + output);
    }
    return done;
  }
  const std::vector<LobePair> rows = read_lobe_pairs(pairs);
  const MeasuredLook measured = measure_look(look, chosen == FabricSampler::table, ocio, working);
  const std::string text = lobe_values_text(lobe_values(measured.fabric, chosen, rows));
  if (output.empty()) {
    print_result(text);
  } else {
    write_text_whole(output, text);
    if (!voice.json) print_note(fmt::format("wrote {}  {} rows in {}", output, rows.size(), measured.space));
  }
  return done;
}

}  // namespace sateen::app
