#include <fmt/format.h>

#include <cmath>

#include "base/parallel.h"
#include "look/json_writer.h"
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
  w.open_object().member("setting", p.setting).member("cpu_seconds", p.cpu_seconds);
  w.member("setup_seconds", p.setup_seconds).member("noise", p.noise);
  if (list.has_finest) {
    write_interval(w, "bias", p.bias.error);
    w.member("visible_code_values", p.bias.visible);
  }
  w.key("flags").open_list();
  for (const std::string& flag : p.flags) w.value(flag);
  w.close().close();
}

Table csv_table(const CostResult& result) {
  Table table{{"part", "setting", "samples", "cpu_seconds", "setup_seconds", "error", "low", "high",
               "claimed_or_noise", "visible", "enough"},
              {}};
  for (const CostPoint& p : result.points)
    table.rows.push_back({"error against time", "", std::to_string(p.samples), number_text(p.cpu_seconds, 6), "",
                          number_text(p.true_error.value, 6), number_text(p.true_error.low, 6),
                          number_text(p.true_error.high, 6), number_text(p.claimed_error, 6), "", ""});
  for (const PriceList& list : result.lists)
    for (size_t i = 0; i < list.prices.size(); ++i) {
      const Price& p = list.prices[i];
      table.rows.push_back({list.name, p.setting, std::to_string(result.settings.price_samples),
                            number_text(p.cpu_seconds, 6), number_text(p.setup_seconds, 4),
                            number_text(p.bias.error.value, 6), number_text(p.bias.error.low, 6),
                            number_text(p.bias.error.high, 6), number_text(p.noise, 6),
                            number_text(p.bias.visible, 4), int(i) == list.enough ? "yes" : ""});
    }
  return table;
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
  w.key("error_against_time").open_list();
  for (const CostPoint& p : result.points) {
    w.open_object().member("samples", p.samples).member("cpu_seconds", p.cpu_seconds);
    write_interval(w, "true_error", p.true_error);
    w.member("claimed_error", p.claimed_error).close();
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
          .member("cpu_seconds", q.cpu_seconds);
    w.close();
  }
  return w.close().close().text() + "\n";
}

std::string cost_page(const CostResult& result, const std::filesystem::path& picture_folder) {
  const CostSettings& s = result.settings;
  const std::vector<std::string> halvings = halving_sentences(result);
  Page page("What accuracy costs in time",
            fmt::format("{} on {} under {}, {} x {} pixels{}", s.scene.look, light_label(s.scene.mesh),
                        light_label(s.scene.environment), s.scene.width, s.scene.height,
                        halvings.empty() ? "." : ". E " + halvings.back()));
  if (result.interrupted) page.paragraph("INTERRUPTED: only what was finished is here.");
  page.paragraph(
      "E is the relative error of the whole picture: sqrt of the mean over pixels and channels of (x - r)^2 / (r^2 + "
      "0.01) in the working space. 10 % is grainy, 4 % can be judged, 1 % is clean.");
  const std::vector<NamedPlot> plots = cost_plots(result);
  page.section("Error against time");
  for (const NamedPlot& plot : plots)
    if (plot.name == "error_time") page.plot(plot.sheet, plot.caption);
  page.table(point_table(result));
  const int threads = thread_count(s.threads);
  for (const std::string& sentence : halvings)
    page.paragraph(fmt::format("{}, with {} thread{}.", sentence, threads, threads == 1 ? "" : "s"));
  std::vector<SliderPicture> shown;
  for (size_t i = 0; i < result.ladder_pictures.size(); ++i)
    shown.push_back({result.ladder_pictures[i].first, picture_uri(picture_folder / fmt::format("n_{}.jpg", i))});
  if (shown.size() > 1) page.slider("The same picture at growing samples.", shown, 760);
  page.section("Recommended settings");
  page.table(quality_table(result));
  page.note(
      "The cheapest combination whose noise and bias together stay below E. Settings are taken to act independently: "
      "their times multiply and the squares of their biases add.");
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
  page.paragraph(
      fmt::format("On a picture of {} x {} pixels with the subdivision level of the whole one; CPU-seconds are "
                  "scaled by the number "
                  "of pixels, {:.1f}. Bias is measured between pairs of pictures with two seeds: in the product of "
                  "both differences "
                  "noise has no expectation. The visible difference is the largest that both pairs agree on, in "
                  "8-bit code values "
                  "of the display picture, means over 4 x 4 pixels. A setting is enough where it is below one code "
                  "value and 0.1 % "
                  "or lost in noise.",
                  result.width, result.height, result.scale));
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
