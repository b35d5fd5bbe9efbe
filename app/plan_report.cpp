#include "plan_report.h"

#include <fmt/format.h>

#include "base/files.h"
#include "console.h"
#include "report/page.h"

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

std::string percent_text(const Interval& i) {
  return fmt::format("{:.3g} % ({:.3g} to {:.3g})", 100 * i.value, 100 * i.low, 100 * i.high);
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

Table bill_table(const Bill& bill) {
  Table table{{"effect", "time", "variance", "E without it (95 % interval)", "largest difference", ""}, {}};
  const auto share = [](const std::optional<double>& s) { return s ? fmt::format("{:.1f} %", 100 * *s) : "-"; };
  for (const BillItem& item : bill.items) {
    const EffectInfo& info = effect_info(item.effect);
    table.rows.push_back({info.name, share(item.time_share), share(item.variance_share), percent_text(item.loss),
                          fmt::format("{:.0f} of 255", item.visible), info.what});
  }
  return table;
}

void write_bill_page(const std::filesystem::path& path, const Bill& bill, const std::string& lead) {
  Page page("What every effect costs and is worth", lead);
  page.table(bill_table(bill));
  page.note(fmt::format(
      "time: share of a sample's CPU time; variance: share of E^2; both measured on {} x {} pixels spread over the "
      "picture, with and without the effect. A part of the cloth model counts by the direct light that comes by way "
      "of "
      "it. The bill took {:.1f} CPU-seconds.",
      bill.picture.width, bill.picture.height, bill.cpu_seconds));
  for (const BillItem& item : bill.items) {
    const EffectInfo& info = effect_info(item.effect);
    page.section(info.name);
    page.slider(fmt::format("{}. Without it the picture is off by E {}.", info.what, percent_text(item.loss)),
                {{"with", picture_uri(bill.picture)},
                 {"without", picture_uri(item.without)},
                 {fmt::format("difference x {:.0f}", difference_gain), picture_uri(item.difference)}},
                640);
  }
  write_text_whole(path, page.html());
}

}  // namespace sateen::app
