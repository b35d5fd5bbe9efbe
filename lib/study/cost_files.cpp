#include <fmt/format.h>

#include <cmath>

#include "base/parallel.h"
#include "look/json_writer.h"
#include "render/quality.h"
#include "report/page.h"
#include "study/bill_report.h"
#include "study/cost_report.h"
#include "study/report_folder.h"

namespace sateen {

namespace {
void write_interval(JsonWriter& w, const char* name, const Interval& i) {
  w.key(name).open_object().member("value", i.value).member("low", i.low).member("high", i.high).close();
}

void write_price(JsonWriter& w, const Price& p, const PriceList& list) {
  w.open_object().member("setting", p.setting).member("asked", p.asked);
  write_interval(w, "cpu_seconds", p.cpu_seconds);
  w.member("start_seconds", p.start_seconds).member("noise", p.noise);
  write_interval(w, "time_factor", p.time_factor);
  write_interval(w, "noise_factor", p.noise_factor);
  if (list.has_finest) {
    write_interval(w, "bias", p.bias.error);
    w.member("visible_code_values", p.bias.visible);
  }
  w.key("flags").open_list();
  for (const std::string& flag : p.flags) w.value(flag);
  w.close().close();
}

Table csv_table(const CostResult& result) {
  Table table{{"part", "setting", "samples", "cpu_seconds", "cpu_low", "cpu_high", "error", "low", "high",
               "claimed_or_noise", "visible", "enough"},
              {}};
  for (const CostPoint& p : result.points)
    table.rows.push_back({"noise against time", "", std::to_string(p.samples), number_text(p.cpu_seconds.value, 6),
                          number_text(p.cpu_seconds.low, 6), number_text(p.cpu_seconds.high, 6),
                          number_text(p.noise.value, 6), number_text(p.noise.low, 6), number_text(p.noise.high, 6),
                          number_text(p.claimed_error, 6), "", ""});
  for (const PriceList& list : result.lists)
    for (size_t i = 0; i < list.prices.size(); ++i) {
      const Price& p = list.prices[i];
      table.rows.push_back(
          {list.name, p.setting, std::to_string(result.settings.price_samples), number_text(p.cpu_seconds.value, 6),
           number_text(p.cpu_seconds.low, 6), number_text(p.cpu_seconds.high, 6), number_text(p.bias.error.value, 6),
           number_text(p.bias.error.low, 6), number_text(p.bias.error.high, 6), number_text(p.noise, 6),
           number_text(p.bias.visible, 4), int(i) == list.enough ? "yes" : ""});
    }
  for (const Quality& q : result.qualities)
    if (q.measured)
      table.rows.push_back({"recommended " + q.name, q.flags, std::to_string(q.samples),
                            number_text(q.measured_seconds.value, 6), number_text(q.measured_seconds.low, 6),
                            number_text(q.measured_seconds.high, 6), number_text(q.measured_error.value, 6),
                            number_text(q.measured_error.low, 6), number_text(q.measured_error.high, 6), "", "", ""});
  return table;
}

std::string quality_words() {
  constexpr const char* words[] = {"is grainy", "can be judged", "is clean"};
  std::string text;
  for (size_t i = 0; i < std::size(named_qualities); ++i)
    text += fmt::format("{}{:.3g} % {} ({})", i > 0 ? ", " : "", 100 * named_qualities[i].error, words[i],
                        named_qualities[i].name);
  return text;
}

std::string file_of(size_t list, size_t setting) {
  return fmt::format("{}_{}.jpg", list, setting);
}
}  // namespace

std::string cost_json(const CostResult& result, const std::string& version, const std::string& command_line) {
  const CostSettings& s = result.settings;
  JsonWriter w;
  w.open_object().member("version", version).member("command", command_line);
  w.member("interrupted", result.interrupted).member("cpu_seconds", result.cpu_seconds);
  w.member("look", s.scene.look).member("mesh", s.scene.mesh).member("map", s.scene.environment);
  w.key("size").open_list().value(s.scene.width).value(s.scene.height).close();
  w.key("measured_size").open_list().value(result.width).value(result.height).close();
  w.member("level", result.level).member("threads", thread_count(s.threads));
  w.member("reference_samples", result.reference_samples);
  w.member("reference_error", std::sqrt(result.reference_error.relative));
  w.member("error_floor", result.error_floor);
  w.key("start").open_object();
  write_interval(w, "program", result.start.program);
  write_interval(w, "assembly", result.start.assembly);
  write_interval(w, "pilots", result.start.pilots);
  write_interval(w, "albedo_table", result.start.albedo_table);
  write_interval(w, "writing", result.start.writing);
  w.member("cpu_seconds", result.start.seconds()).close();
  w.key("error_against_time").open_list();
  for (const CostPoint& p : result.points) {
    w.open_object().member("samples", p.samples);
    write_interval(w, "cpu_seconds", p.cpu_seconds);
    write_interval(w, "noise", p.noise);
    w.member("error", p.error).member("claimed_error", p.claimed_error).close();
  }
  w.close();
  if (result.fit.known)
    w.member("slope", result.fit.slope)
        .member("slope_error", result.fit.slope_error)
        .member("factor", result.fit.factor);
  w.key("halvings").open_list();
  for (const std::string& sentence : halving_sentences(result)) w.value(sentence);
  w.close().key("prices").open_list();
  for (const PriceList& list : result.lists) {
    w.open_object().member("name", list.name).member("biased", list.biased).member("note", list.note);
    if (list.enough >= 0) w.member("enough", list.prices[size_t(list.enough)].setting);
    w.key("settings").open_list();
    for (const Price& p : list.prices) write_price(w, p, list);
    w.close().close();
  }
  w.close().key("plan").open_object();
  write_plan(w, result.plan);
  w.close();
  write_bill(w, result.bill);
  w.key("qualities").open_object();
  for (const Quality& q : result.qualities) {
    w.key(q.name).open_object().member("target", q.target).member("reached", q.reached);
    if (q.reached)
      w.member("flags", q.flags)
          .member("spp", q.samples)
          .member("noise", q.noise)
          .member("bias", q.bias)
          .member("error", q.error())
          .member("cpu_seconds", q.cpu_seconds);
    if (q.measured) {
      write_interval(w, "measured_error", q.measured_error);
      write_interval(w, "measured_cpu_seconds", q.measured_seconds);
    }
    w.close();
  }
  w.close().key("frontier").open_list();
  for (const Quality& q : result.frontier)
    w.open_object().member("flags", q.flags).member("error", q.error()).member("cpu_seconds", q.cpu_seconds).close();
  return w.close().close().text() + "\n";
}

std::string cost_page(const CostResult& result, const std::filesystem::path& picture_folder) {
  const CostSettings& s = result.settings;
  const std::vector<std::string> halvings = halving_sentences(result);
  Page page("What accuracy costs in time",
            fmt::format("{} on {} under {}, {} x {} pixels{}", s.scene.look, light_label(s.scene.mesh),
                        light_label(s.scene.environment), s.scene.width, s.scene.height,
                        halvings.empty() ? "." : ". Noise " + halvings.back()));
  if (result.interrupted) page.paragraph("INTERRUPTED: only what was finished is here.");
  page.paragraph(fmt::format(
      "E is the relative error of the picture, noise and what settings give away in one: sqrt of the mean over "
      "pixels "
      "and channels of (x - r)^2 / (r^2 + floor^2) in the working space, floor {:.3g}: 0.1 as the picture "
      "is exposed. {}. CPU-seconds are those of a whole render, from the start of the program to the "
      "files.",
      result.error_floor, quality_words()));
  if (!result.qualities.empty()) {
    page.section("Recommended settings");
    page.table(quality_table(result));
    page.note(
        "The cheapest settings whose noise and bias together stay below E. Another setting than the one asked for is "
        "taken where it is cheaper beyond the intervals; ties stay with what is asked for. The forecast takes "
        "settings "
        "to act independently: their times multiply and the squares of their biases add. Measured: rendered with "
        "these flags, from the start, against a reference with the finest settings.");
  }
  const std::vector<NamedPlot> plots = cost_plots(result);
  page.section("Error against time");
  for (const NamedPlot& plot : plots)
    if (plot.name == "error_time") page.plot(plot.sheet, plot.caption);
  page.table(point_table(result));
  page.table(start_table(result));
  const int threads = thread_count(s.threads);
  for (const std::string& sentence : halvings)
    page.paragraph(fmt::format("Noise {}, with {} thread{}.", sentence, threads, threads == 1 ? "" : "s"));
  std::vector<SliderPicture> shown;
  for (size_t i = 0; i < result.ladder_pictures.size(); ++i)
    shown.push_back({result.ladder_pictures[i].first, picture_uri(picture_folder / fmt::format("n_{}.jpg", i))});
  if (shown.size() > 1) page.slider("The same picture at growing samples.", shown, 760);
  page.section("The price of approximations");
  for (const NamedPlot& plot : plots)
    if (plot.name == "prices") page.plot(plot.sheet, plot.caption);
  for (size_t i = 0; i < result.lists.size(); ++i) {
    const PriceList& list = result.lists[i];
    page.section(list.name);
    if (!list.note.empty()) page.note(list.note + ".");
    page.table(price_table(list));
    shown.clear();
    for (size_t k = 0; k < list.prices.size(); ++k)
      shown.push_back({list.name + " " + list.prices[k].setting, picture_uri(picture_folder / file_of(i, k))});
    page.slider(fmt::format("Every setting at {} samples.", s.price_samples), shown, 760);
  }
  if (!result.bill.items.empty()) {
    page.section("The bill of effects");
    add_bill(page, result.bill);
  }
  page.section("How it was measured");
  page.paragraph(fmt::format(
      "On a picture of {} x {} pixels with the subdivision level of the whole one; CPU-seconds are "
      "scaled by the number "
      "of pixels, {:.1f}, those before and after the samples are not. Settings of a list are timed side by "
      "side, {} times; intervals hold 95 % (Student's t). Bias is measured between pairs of pictures with two seeds: "
      "in the product of "
      "both differences "
      "noise has no expectation. The visible difference is the largest that both pairs agree on, in "
      "8-bit code values "
      "of the display picture, means over 4 x 4 pixels. A setting is enough where it is below one code "
      "value and 0.1 % "
      "or lost in noise.",
      result.width, result.height, result.scale, s.seeds));
  return page.html();
}

std::vector<std::string> write_cost(const std::filesystem::path& folder, const CostResult& result,
                                    const std::string& version, const std::string& command_line) {
  ReportFolder report(folder);
  report.text("cost.csv", table_csv(csv_table(result)));
  report.text("cost.json", cost_json(result, version, command_line));
  report.text("cost.txt", cost_text(result));
  report.plots(cost_plots(result));
  for (size_t i = 0; i < result.ladder_pictures.size(); ++i)
    report.picture(fmt::format("n_{}.jpg", i), result.ladder_pictures[i].second);
  for (size_t i = 0; i < result.lists.size(); ++i)
    for (size_t k = 0; k < result.lists[i].prices.size(); ++k)
      report.picture(file_of(i, k), result.lists[i].prices[k].picture);
  report.text("index.html", cost_page(result, folder / "pictures"));
  return report.names;
}

}  // namespace sateen
