#include "environment_text.h"

#include <fmt/format.h>

namespace sateen::app {

std::string environment_text(const std::string& path, const std::string& space, const EnvironmentReport& r) {
  std::string text = fmt::format("{}  {} x {}, {}\n", path, r.width, r.height, space);
  text += fmt::format("  luminance {:.4g} to {:.4g}, mean {:.4g}; largest over mean {:.4g}; {:.1f} stops\n",
                      r.smallest, r.largest, r.mean, r.largest_over_mean, r.stops);
  text += fmt::format("  metered exposure {:+.2f} EV\n", r.metered_ev);
  for (const std::string& note : r.notes) text += "  " + note + "\n";
  if (r.repairs.wide.count > 0)
    text += fmt::format("  {} pixels negative in the file are colours of the working space: kept\n",
                        r.repairs.wide.count);
  for (const std::string& notice : r.notices) text += "  note: " + notice + "\n";
  for (const LightRegion& region : r.regions)
    text +=
        fmt::format("  light at azimuth {:.0f}, elevation {:.0f}: {:.1f} % of the energy, {:.3g} sr, peak {:.4g}\n",
                    region.azimuth_deg, region.elevation_deg, 100 * region.share, region.solid_angle, region.peak);
  return text;
}

void write_environment(JsonWriter& w, const std::string& path, const std::string& space, const EnvironmentReport& r) {
  w.open_object()
      .member("path", path)
      .member("color_space", space)
      .member("width", r.width)
      .member("height", r.height);
  w.member("smallest", r.smallest).member("largest", r.largest).member("mean", r.mean);
  w.member("largest_over_mean", r.largest_over_mean).member("stops", r.stops).member("metered_ev", r.metered_ev);
  w.key("repairs").open_object();
  const auto add = [&](const char* name, const EnvironmentRepairs::Kind& kind) {
    w.key(name).open_object().member("count", kind.count);
    if (kind.count > 0) w.key("first").open_list().value(kind.first_x).value(kind.first_y).close();
    w.close();
  };
  add("not_a_number", r.repairs.not_a_number);
  add("infinite", r.repairs.infinite);
  add("negative", r.repairs.negative);
  add("out_of_gamut", r.repairs.out_of_gamut);
  add("wide", r.repairs.wide);
  add("spike", r.repairs.spike);
  w.close().key("notes").open_list();
  for (const std::string& note : r.notes) w.value(note);
  w.close().key("notices").open_list();
  for (const std::string& notice : r.notices) w.value(notice);
  w.close().key("lights").open_list();
  for (const LightRegion& region : r.regions)
    w.open_object()
        .member("azimuth_deg", region.azimuth_deg)
        .member("elevation_deg", region.elevation_deg)
        .member("share", region.share)
        .member("solid_angle", region.solid_angle)
        .member("peak", region.peak)
        .close();
  w.close().close();
}

}  // namespace sateen::app
