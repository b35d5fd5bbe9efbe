#include "render/bill.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/parallel.h"

namespace sateen {

namespace {

class Biller {
 public:
  Biller(const Scene& scene, const LightSettings& light, const BillSettings& settings, const ColorManager& colors,
         std::uint32_t seed, int threads)
      : scene_(scene),
        light_(light),
        settings_(settings),
        colors_(colors),
        seed_(seed),
        threads_(threads),
        error_floor_(error_floor_at(double(settings.exposure_ev))) {
    grid_.columns = std::min(settings.columns, scene.camera.width);
    grid_.rows = std::clamp(int(std::lround(double(grid_.columns) * scene.camera.height / scene.camera.width)), 1,
                            scene.camera.height);
    grid_.samples = settings.samples;
    // Also warms caches: the first of equals would seem dearer.
    for (auto& [effect, part] : parts_) less_[effect] = blank_picture(scene, grid_);
    trace_grid(scene, light, seed, grid_, threads, [&](int i, std::span<const CameraSample> samples) {
      for (const auto& [effect, part] : parts_)
        for (const CameraSample& s : samples)
          add_sample(less_.at(effect).pixels[size_t(i)], s.total() - part(s.direct), s.coverage, no_grain);
    });
    whole_ = trace_picture(scene, light, seed, grid_, threads);
    noise_ = relative_variance(whole_, error_floor_);
  }

  Image shown(const GridPicture& picture) const {
    return develop_display(grid_image(picture), colors_, settings_.display, settings_.exposure_ev);
  }
  Image shown() const { return shown(whole_); }

  /// The picture less what a part of the cloth model brings to it; nothing for a part that is not billed alone.
  std::optional<BillItem> part_of_model(Effect effect) const {
    const auto less = less_.find(effect);
    return less == less_.end() ? std::nullopt : std::optional(billed(effect, less->second));
  }

  BillItem removable(Effect effect) const {
    Scene without = scene_;
    LightSettings light = light_;
    remove_effect(effect, without, light);
    const GridPicture less = trace_picture(without, light, seed_, grid_, threads_);
    BillItem item = billed(effect, less);
    if (whole_.work.cpu_seconds > 0) item.time_share = 1 - less.work.cpu_seconds / whole_.work.cpu_seconds;
    return item;
  }

 private:
  BillItem billed(Effect effect, const GridPicture& less) const {
    BillItem item;
    item.effect = effect;
    item.loss = picture_loss(differences(less, whole_, error_floor_), error_floor_);
    if (noise_ > 0) item.variance_share = 1 - relative_variance(less, error_floor_) / noise_;
    item.without = shown(less);
    item.difference = shown();
    for (size_t i = 0; i < item.difference.pixels.size(); ++i) {
      const float off = std::abs(item.difference.pixels[i] - item.without.pixels[i]);
      item.visible = std::max(item.visible, 255 * double(off));
      item.difference.pixels[i] = std::min(off * difference_gain, 1.0f);
    }
    return item;
  }

  // The isotropic part of the volume is billed with the directed one: the kernel adds them up.
  const std::map<Effect, Color (*)(const LobeLight&)> parts_{
      {Effect::families, [](const LobeLight& l) { return l.surface[1] + l.volume[1]; }},
      {Effect::surface_lobe, [](const LobeLight& l) { return l.surface[0] + l.surface[1]; }},
      {Effect::directed_volume, [](const LobeLight& l) { return l.volume[0] + l.volume[1]; }}};
  std::map<Effect, GridPicture> less_;
  const Scene& scene_;
  LightSettings light_;
  const BillSettings& settings_;
  const ColorManager& colors_;
  std::uint32_t seed_;
  int threads_;
  double error_floor_;
  PixelGrid grid_;
  GridPicture whole_;
  double noise_ = 0;
};

}  // namespace

Bill make_bill(const Scene& scene, const Plan& plan, const LightSettings& light, const BillSettings& settings,
               const ColorManager& colors, std::uint32_t seed, int threads) {
  const double start = cpu_seconds();
  BillSettings opaque = settings;
  opaque.display.transparent = false;
  const Biller biller(scene, light, opaque, colors, seed, threads);
  Bill bill;
  bill.picture = biller.shown();
  for (const PlannedEffect& planned : plan.effects) {
    if (!planned.on) continue;
    if (std::optional<BillItem> part = biller.part_of_model(planned.effect))
      bill.items.push_back(std::move(*part));
    else if (effect_info(planned.effect).switchable && planned.effect != Effect::references)
      bill.items.push_back(biller.removable(planned.effect));
  }
  bill.cpu_seconds = cpu_seconds() - start;
  return bill;
}

void write_bill(JsonWriter& w, const Bill& bill) {
  w.key("bill").open_object().member("cpu_seconds", bill.cpu_seconds).key("effects").open_list();
  for (const BillItem& item : bill.items) {
    w.open_object().member("effect", effect_info(item.effect).name);
    w.key("time_share");
    item.time_share ? w.value(*item.time_share) : w.null();
    w.key("variance_share");
    item.variance_share ? w.value(*item.variance_share) : w.null();
    w.key("loss").open_object().member("value", item.loss.value).member("low", item.loss.low);
    w.member("high", item.loss.high).close();
    w.member("largest_display_difference", item.visible).close();
  }
  w.close().close();
}

}  // namespace sateen
