#include "study/bill_report.h"

#include <fmt/format.h>

#include <cmath>

namespace sateen {

Table bill_table(const Bill& bill) {
  Table table{{"effect", "time", "variance", "E without it (95 % interval)", "largest difference", ""}, {}};
  const auto share = [](const std::optional<double>& s) {
    if (!s) return std::string("-");
    if (*s < -0.0005) return fmt::format("{:.3g} times without it", 1 - *s);
    return fmt::format("{:.1f} %", 100 * std::abs(*s));
  };
  for (const BillItem& item : bill.items) {
    const EffectInfo& info = effect_info(item.effect);
    table.rows.push_back({info.name, share(item.time_share), share(item.variance_share), percent_text(item.loss),
                          fmt::format("{:.0f} of 255", item.visible), info.what});
  }
  return table;
}

void add_bill(Page& page, const Bill& bill) {
  page.table(bill_table(bill));
  page.note(fmt::format(
      "time: share of a sample's CPU time that taking the effect out alone saves; variance: share of E^2 that it "
      "takes away, or how many times as large E^2 is without an effect that calms the picture, as shadows do by what "
      "they "
      "hide. Effects share work and noise: the columns do not add up to the whole. Measured on {} x {} pixels spread "
      "over the picture. A part of the cloth model counts by the direct light that comes by way "
      "of it. The bill took {:.1f} CPU-seconds.",
      bill.picture.width, bill.picture.height, bill.cpu_seconds));
  for (const BillItem& item : bill.items) {
    page.section(effect_info(item.effect).name);
    page.slider(fmt::format("{}. Without it the picture is off by E {}.", effect_info(item.effect).what,
                            percent_text(item.loss)),
                {{"with", picture_uri(bill.picture)},
                 {"without", picture_uri(item.without)},
                 {fmt::format("difference x {:.0f}", difference_gain), picture_uri(item.difference)}},
                640);
  }
}

}  // namespace sateen
