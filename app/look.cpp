#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/files.h"
#include "command.h"
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "look/describe.h"
#include "look/json_writer.h"
#include "look/read.h"
#include "measured_look.h"

namespace sateen::app {

namespace {
int look_list(const std::vector<std::string>& words) {
  Command command("look list",
                  "Lists the looks that are found by name: here, in SATEEN_PATH, in the program's own folder.",
                  "[--json]");
  command.flag("--json", voice.json, "the same as JSON, with paths");
  if (!command.parse(words)) return done;
  const std::vector<LookEntry> entries = list_looks();
  size_t longest = 0;
  for (const LookEntry& entry : entries) longest = std::max(longest, entry.name.size());
  JsonWriter w;
  w.open_object().key("looks").open_list();
  std::string text;
  for (const LookEntry& entry : entries) {
    w.open_object().member("name", entry.name).member("path", entry.path.string());
    try {
      const Look look = read_look(entry.path.string());
      text += fmt::format("{:<{}}  {}\n", entry.name, longest, look.title);
      if (!look.description.empty()) text += fmt::format("{:<{}}  {}\n", "", longest, look.description);
      w.member("title", look.title).member("description", look.description);
    } catch (const InputError&) {
      // One bad file must not hide the others.
      text += fmt::format("{:<{}}  (has errors: sateen look check {})\n", entry.name, longest, entry.path.string());
      w.member("has_errors", true);
    }
    w.close();
  }
  w.close().close();
  print_result(voice.json ? w.text() : text);
  return done;
}

// Reads all looks; every error of every file ends up in one InputError.
std::vector<Look> read_all(const std::vector<std::string>& names, const std::vector<std::string>& overrides) {
  std::vector<Look> looks;
  std::vector<Diagnostic> faults;
  bool missing = false;
  for (const std::string& name : names) {
    try {
      looks.push_back(read_look(name, overrides));
    } catch (const InputError& error) {
      faults.insert(faults.end(), error.diagnostics.begin(), error.diagnostics.end());
      missing |= error.kind == InputError::Kind::unreadable;
    }
  }
  if (!faults.empty()) throw InputError(missing ? InputError::Kind::unreadable : InputError::Kind::wrong, faults);
  return looks;
}

void write_color(JsonWriter& w, const char* name, const Color& c) {
  w.key(name).open_list().value(c.x).value(c.y).value(c.z).close();
}

// Table of one look; returns the views whose albedo passes 1.
std::vector<LobeSummary> print_albedo(const MeasuredLook& measured, std::string& text, JsonWriter& w) {
  const Look& look = measured.look;
  std::vector<LobeSummary> too_bright;
  text += fmt::format("{}  {}\n  albedo in {} by view angle\n", look.name, look.title, measured.space);
  w.open_object().member("name", look.name).member("title", look.title).member("space", measured.space);
  w.key("albedo").open_list();
  std::string rows[2];
  for (const PlaneDirection& view : table_views()) {
    LobeSummary s;
    s.view = view;
    s.albedo = albedo_color(measured.fabric, view.direction());
    const bool bright = max_component(s.albedo) > 1;
    if (bright) too_bright.push_back(s);
    const std::string row = fmt::format("    {:>3.0f}  {:.3f} {:.3f} {:.3f}{}\n", view.angle_deg, s.albedo.x,
                                        s.albedo.y, s.albedo.z, bright ? "  above 1" : "");
    if (!view.along_weft) rows[0] += row;
    if (view.along_weft || view.angle_deg == 0) rows[1] += row;
    w.open_object().member("angle_deg", view.angle_deg).member("along", view.along_weft ? "weft" : "warp");
    write_color(w, "albedo", s.albedo);
    w.close();
  }
  w.close().member("above_one", !too_bright.empty()).close();
  text += "  along the warp\n" + rows[0] + "  along the weft\n" + rows[1];
  return too_bright;
}

int look_check(const std::vector<std::string>& words) {
  std::vector<std::string> names, overrides;
  Command command("look check",
                  "Reads looks, reports every error in them, and prints how much light they give back by view angle.",
                  "[LOOK...] [--json]");
  command.paragraph(
      "Above an albedo of 1 a cloth gives back more light than it gets: it glows at that angle. The model "
      "allows it (A is a scale, not an albedo); lower A or the colour where it matters.");
  command.arguments("LOOK", names, 0, 1000, "names or files; without any: all looks that are found");
  command.texts("--set", "PATH=VALUE", overrides, "changes one field of each look; repeatable");
  command.flag("--json", voice.json, "the same as JSON");
  command.example("sateen look check silk_shot my_look.json", "two looks");
  if (!command.parse(words)) return done;
  if (names.empty())
    for (const LookEntry& entry : list_looks()) names.push_back(entry.path.string());
  std::string text;
  JsonWriter w;
  w.open_object().key("looks").open_list();
  std::vector<std::string> warnings;
  for (const Look& look : read_all(names, overrides)) {
    const MeasuredLook measured = measure_look(look, false);
    warnings.insert(warnings.end(), measured.warnings.begin(), measured.warnings.end());
    for (const LobeSummary& s : print_albedo(measured, text, w))
      warnings.push_back(fmt::format("{}: albedo {:.3f} {:.3f} {:.3f} at {} degrees passes 1", look.name, s.albedo.x,
                                     s.albedo.y, s.albedo.z, s.view.text()));
  }
  w.close().key("warnings").open_list();
  for (const std::string& warning : warnings) w.value(warning);
  w.close().close();
  print_result(voice.json ? w.text() : text);
  for (const std::string& warning : warnings) print_warning(warning);
  return done;
}

int look_resolve(const std::vector<std::string>& words) {
  std::vector<std::string> names, overrides;
  bool plain = false;
  Command command("look resolve", "Prints a look with its parents merged, and where each value comes from.",
                  "LOOK [--json]");
  command.arguments("LOOK", names, 1, 1, "name or file");
  command.texts("--set", "PATH=VALUE", overrides, "changes one field; repeatable");
  command.flag("--file", plain, "prints a look file that stands on its own instead");
  command.flag("--json", voice.json, "the same as JSON");
  command.example("sateen look resolve emerald_satin --file > mine.json", "a copy to work on, without a parent");
  if (!command.parse(words)) return done;
  const ResolvedLook resolved = resolve_look(names[0], overrides);
  for (const std::string& warning : resolved.look.weave.draft_warnings) print_warning(warning);
  if (plain) {
    print_result(write_look(resolved.look));
    return done;
  }
  JsonWriter w;
  w.open_object()
      .member("name", resolved.look.name)
      .member("hash", look_hash(resolved.look))
      .key("files")
      .open_list();
  for (const std::string& file : resolved.files) w.value(file);
  w.close().key("values").open_list();
  size_t path_width = 0, value_width = 0;
  for (const FieldOrigin& v : resolved.values) {
    path_width = std::max(path_width, v.path.size());
    value_width = std::max(value_width, std::min<size_t>(v.value.size(), 44));
    w.open_object().member("path", v.path).member("value", v.value).member("origin", v.origin).close();
  }
  w.close().close();
  std::string text;
  constexpr size_t longest_shown = 4000;  // a jacquard's draft has megabytes
  for (const FieldOrigin& v : resolved.values) {
    const bool cut = v.value.size() > longest_shown;
    const std::string value =
        cut ? fmt::format("{}... ({} characters, --file shows all)", v.value.substr(0, 60), v.value.size()) : v.value;
    text += fmt::format("{:<{}}  {:<{}}  {}\n", v.path, path_width, value, value_width, v.origin);
  }
  print_result(voice.json ? w.text() : text);
  return done;
}

int look_diff(const std::vector<std::string>& words) {
  std::vector<std::string> names;
  Command command("look diff",
                  "Prints the fields in which two looks differ. Titles, descriptions and sources do not count.",
                  "LOOK LOOK [--json]");
  command.arguments("LOOK", names, 2, 2, "two names or files");
  command.flag("--json", voice.json, "the same as JSON");
  command.example("sateen look diff champagne_silk_satin emerald_satin", "what makes emerald different");
  if (!command.parse(words)) return done;
  const std::vector<Look> looks = read_all(names, {});
  const std::vector<FieldDifference> differences = diff_looks(looks[0], looks[1]);
  JsonWriter w;
  w.open_object().member("a", looks[0].name).member("b", looks[1].name).key("differences").open_list();
  std::string text;
  for (const FieldDifference& d : differences) {
    const auto shown = [](const std::string& value) { return value.empty() ? std::string("(none)") : value; };
    text +=
        fmt::format("{}\n  {:<24} {}\n  {:<24} {}\n", d.path, looks[0].name, shown(d.a), looks[1].name, shown(d.b));
    w.open_object().member("path", d.path).member("a", d.a).member("b", d.b).close();
  }
  w.close().close();
  if (differences.empty()) text = "the same cloth\n";
  print_result(voice.json ? w.text() : text);
  return done;
}

int look_schema_command(const std::vector<std::string>& words) {
  std::string output;
  bool fields = false;
  Command command("look schema",
                  "Prints the JSON Schema of look files, with which editors complete and check while you type.",
                  "[-o FILE]");
  command.text("-o,--output", "FILE", output, "writes it there instead");
  command.flag("--fields", fields, "prints all fields with range, unit, default and meaning, for people");
  command.flag("--json", voice.json, "does nothing: the schema is JSON");
  command.example("sateen look schema -o look.schema.json", "then \"$schema\": \"look.schema.json\" in a look file");
  if (!command.parse(words)) return done;
  if (fields && !voice.json) {
    print_result(look_field_help());
  } else if (output.empty()) {
    print_result(look_schema());
  } else {
    write_text_whole(output, look_schema() + "\n");
    print_note("wrote " + output);
  }
  return done;
}
}  // namespace

const std::vector<Subcommand>& look_subcommands() {
  static const std::vector<Subcommand> all{
      {"list", "the looks that are found by name", look_list},
      {"check", "errors in looks, and their albedo by view angle", look_check},
      {"resolve", "a look with its parents merged, and where each value comes from", look_resolve},
      {"diff", "the fields in which two looks differ", look_diff},
      {"schema", "JSON Schema of look files, or a list of all fields", look_schema_command},
  };
  return all;
}

int run_look(const std::vector<std::string>& words) {
  return run_group("sateen look", "Looks: what a cloth is made of, as JSON files.", look_subcommands(), words);
}

}  // namespace sateen::app
