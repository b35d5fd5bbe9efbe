#include "plan_report.h"

#include <fmt/format.h>

#include <cmath>

#include "base/files.h"
#include "console.h"
#include "mesh/subdivide.h"
#include "report/table.h"

namespace sateen::app {

namespace {

std::string share_text(const std::optional<Interval>& share) {
  if (!share) return "";
  return fmt::format("{:.1f} +- {:.1f} %", 100 * share->value, 50 * (share->high - share->low));
}

std::string cost_text(const PlannedEffect& planned) {
  if (planned.cost < 0.005) return "";
  return planned.on ? fmt::format("+{:.0f} %", 100 * planned.cost)
                    : fmt::format("saves {:.0f} %", 100 * planned.cost);
}

}  // namespace

std::string plan_text(const Plan& plan) {
  Table table{{"effect", "state", "by", "light", "time", "why"}, {}};
  for (const PlannedEffect& p : plan.effects)
    table.rows.push_back({effect_info(p.effect).name, p.on ? "on" : "off", basis_name(p.basis), share_text(p.share),
                          cost_text(p), p.reason});
  return fmt::format("planned for an error of {:.3g} %{}\n\n{}", 100 * plan.error,
                     plan.error_asked ? "" : ", since none is asked for", table_text(table));
}

std::string levels_text(const Plan& plan, const SceneReport& report) {
  Table table{{"level", "triangles", "silhouettes off", "memory", "to set up", ""}, {}};
  for (int level = std::max(report.level - 1, 0); level <= std::min(report.level + 1, finest_level); ++level) {
    const double more = std::exp2(2.0 * (level - report.level));  // chords fall as the triangles grow
    const double triangles = double(report.triangles) * more;
    table.rows.push_back({fmt::format("{}", level), fmt::format("{:.0f}", triangles),
                          fmt::format("{:.2g} pixels", double(plan.detail.off_pixels) / more),
                          fmt::format("{:.0f} MB", triangles / 2 * double(bytes_per_quad) * 1e-6),
                          fmt::format("{:.2g} s", (report.mesh_seconds + report.tracer_seconds) * more),
                          level == report.level ? "taken" : ""});
  }
  return table_text(table);
}

bool report_verdicts(const Plan& plan, const std::vector<Verdict>& verdicts) {
  bool all_right = true;
  for (const Verdict& v : verdicts) {
    const std::string& name = effect_info(v.effect).name;
    if (!v.tested) {
      print_detail(fmt::format("{}: nothing to switch on; {}", name, v.note));
      continue;
    }
    const std::string line = fmt::format("{}: switched on it changes the picture by E {}, {:.3g} % are asked for",
                                         name, percent_text(v.loss), 100 * plan.error);
    switch (v.outcome) {
      case Verdict::Outcome::right:
        print_note(fmt::format("plan holds. {}{}", line, v.note.empty() ? "" : "; " + v.note));
        break;
      case Verdict::Outcome::undecided:
        print_warning(fmt::format("plan may be wrong. {}", line));
        break;
      case Verdict::Outcome::wrong:
        all_right = false;
        print_error(fmt::format("error: the plan is WRONG. {}\n  help: render with --effects +{}", line, name));
    }
  }
  return all_right;
}

void write_bill_page(const std::filesystem::path& path, const Bill& bill, const std::string& lead) {
  Page page("What every effect costs and is worth", lead);
  add_bill(page, bill);
  write_text_whole(path, page.html());
}

}  // namespace sateen::app
