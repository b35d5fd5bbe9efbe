#include <fmt/format.h>

#include <map>

#include "look/json_writer.h"
#include "study/report_folder.h"
#include "study/study_report.h"

namespace sateen {

namespace {
void write_interval(JsonWriter& w, const char* name, const Interval& i) {
  w.key(name).open_object().member("value", i.value).member("low", i.low).member("high", i.high).close();
}
}  // namespace

std::string study_json(const StudyResult& result, const std::string& version, const std::string& command_line) {
  JsonWriter w;
  w.open_object().member("version", version).member("command", command_line);
  w.member("interrupted", result.interrupted).member("cpu_seconds", result.cpu_seconds);
  w.member("seconds", result.seconds).member("mesh", result.settings.scene.mesh);
  w.key("size").open_list().value(result.settings.scene.width).value(result.settings.scene.height).close();
  w.member("seeds", result.settings.seeds).member("equal_time_samples", result.settings.samples);
  w.member("ours", strategy_name(result.ours));
  w.member("measure", "relative MSE: mean of (x - r)^2 / (r^2 + floor^2), floor 0.1 as the picture is exposed");
  w.key("skipped").open_list();
  for (const std::string& each : result.skipped) w.value(each);
  w.close().key("bars").open_list();
  for (const Bar& bar : study_bars(result)) {
    w.open_object().member("ratio", bar.what).member("limit", bar.limit).member("passed", bar.passed);
    write_interval(w, "found", bar.found);
    w.close();
  }
  w.close().key("claims").open_list();
  for (const Claim& claim : study_claims(result)) {
    w.open_object().member("scene", result.scenes[size_t(claim.scene)].label());
    w.member("sampler", strategy_name(claim.sampler)).member("samples", claim.samples);
    write_interval(w, "over_uniform", claim.equal);
    write_interval(w, "over_uniform_with_4_times_the_samples", claim.against_four);
    w.member("at_most_a_quarter", claim.quarter).member("better_than_4_times", claim.beats_four);
    w.member("why", claim.why).close();
  }
  w.close().key("threads").open_list();
  for (const ThreadRow& row : result.thread_rows) {
    w.open_object().member("look", row.look).member("family", row.warp ? "warp" : "weft");
    w.member("volume_azimuth", row.azimuth == VolumeAzimuth::flat ? "flat" : "cosine");
    w.member("lobe_choice", row.choice == LobeChoice::half ? "half" : "weight");
    w.key("variance_over_uniform").open_list();
    for (size_t i = 0; i < row.ratios.size(); ++i)
      w.open_object().member("view_deg", thread_views_deg()[i]).member("ratio", row.ratios[i]).close();
    w.close().close();
  }
  w.close().key("talk_figures").open_list();
  for (const TalkFigure& f : result.talk_figures) {
    w.open_object().member("look", f.look).member("light", light_label(f.light)).member("bounces", f.bounces);
    write_interval(w, "threads_over_uniform", f.threads.equal);
    write_interval(w, "threads_over_uniform_with_4_times_the_samples", f.threads.against_four);
    write_interval(w, "cloth_over_uniform", f.cloth.equal);
    write_interval(w, "cloth_over_uniform_with_4_times_the_samples", f.cloth.against_four);
    w.close();
  }
  w.close().key("scenes").open_list();
  for (int i = 0; i < int(result.scenes.size()); ++i) {
    const StudyScene& s = result.scenes[size_t(i)];
    w.open_object().member("look", s.look).member("light", light_label(s.light)).member("bounces", s.bounces);
    w.member("finished", s.finished);
    if (s.finished) {
      w.member("reference_samples", s.reference_samples).member("reference_mse", s.reference_error.relative);
      w.member("half_of_the_light_from_share_of_sphere", s.light_share);
    }
    if (const Winner winner = scene_winner(result, i, Measure::relative); s.all_strategies && winner.known) {
      w.member("best", strategy_name(winner.strategy)).member("best_is_clear", winner.clear);
      w.member("cpu_seconds", common_time(result, i)).key("equal_time").open_list();
      for (const std::string& name : strategy_names()) {
        const Strategy strategy = strategy_from_name(name);
        const Ratio ratio = equal_time_ratio(result, i, result.ours, strategy, Measure::relative);
        if (!ratio.known) continue;
        w.open_object().member("strategy", name);
        w.member("samples", samples_at_time(result, i, strategy, common_time(result, i)));
        write_interval(w, "ours_over_this", ratio.interval);
        const Ratio absolute = equal_time_ratio(result, i, result.ours, strategy, Measure::absolute);
        write_interval(w, "ours_over_this_absolute_mse", absolute.interval);
        w.close();
      }
      w.close();
    }
    w.close();
  }
  return w.close().close().text() + "\n";
}

std::vector<std::string> write_study(const std::filesystem::path& folder, const StudyResult& result,
                                     const std::string& version, const std::string& command_line) {
  ReportFolder report(folder);
  report.text("study.csv", table_csv(run_table(result)));
  report.text("study.json", study_json(result, version, command_line));
  report.text("study.txt", study_text(result));
  report.plots(study_plots(result));
  for (size_t i = 0; i < result.pictures.size(); ++i)
    report.picture(fmt::format("{:02}.jpg", i), result.pictures[i].image);
  report.text("index.html", study_page(result, folder / "pictures"));
  return report.names;
}

}  // namespace sateen
