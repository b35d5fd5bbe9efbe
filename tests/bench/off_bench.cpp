#include <fmt/format.h>

#include <array>
#include <memory>
#include <vector>

#include "bench.h"
#include "integrator/path.h"
#include "render/assemble.h"
#include "render/effects.h"

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#endif

namespace sateen::bench {

namespace {

constexpr int samples = 4, rounds = 21;
constexpr int usual_width = 240, counted_width = 64;  // of the pictures that are timed and counted
constexpr Effect effects[] = {Effect::back,   Effect::maps,           Effect::pattern,     Effect::weave,
                              Effect::ground, Effect::depth_of_field, Effect::motion_blur, Effect::backdrop};

SceneSettings settings_of(const char* look, int width) {
  SceneSettings settings;
  settings.look = look;
  settings.width = width;
  settings.height = width * 9 / 16;
  // Counting programs are slow, and how a scene is made is not asked.
  if (width == counted_width) settings.approximations.table_size = settings.approximations.quadrature = 0.125f;
  settings.level = 2;
  return settings;
}

Scene scene_of(const SceneSettings& settings) {
  SceneReport report;
  return assemble_scene(settings, ColorManager(), report);
}

/// A scene that has the effect switched off, and one that never had it.
struct OffPair {
  Effect effect;
  Scene off, never;
};

OffPair pair_of(Effect effect, int width) {
  SceneSettings with = settings_of(default_look, width), without = with;
  switch (effect) {
    case Effect::back:
      with = without = settings_of("polyester_satin_charmeuse", width);
      with.look_overrides = {"back=polyester_satin_charmeuse_back"};
      without.look_overrides = {"back="};
      break;
    case Effect::maps:
      with = without = settings_of("printed_silk", width);
      break;
    case Effect::pattern:
      with = without = settings_of("silk_damask", width);
      break;
    case Effect::weave:
      with.look_overrides = {"weave.draft=plain"};
      without.look_overrides = {"weave.draft="};
      break;
    case Effect::ground:
      with.stage.ground = GroundSettings();
      break;
    case Effect::depth_of_field:
      with.stage.lens = LensSettings();
      break;
    case Effect::motion_blur:
      with.stage.shutter_deg = 3;
      break;
    default:
      with.backdrop = Backdrop::environment;
      break;
  }
  OffPair pair{effect, scene_of(with), scene_of(without)};
  LightSettings light;
  remove_effect(effect, pair.off, light);
  if (effect == Effect::maps || effect == Effect::pattern) {
    // No look without textures has the means of these: the fabric is the same and knows of no maps.
    pair.never.front_maps = pair.never.back_maps = nullptr;
    pair.never.front.varying = nullptr;
    pair.never.has_maps = false;
  }
  return pair;
}

/// Sum of all samples, traced as a pass does it.
double trace_all(const Scene& scene, PathScratch& scratch) {
  std::array<SampleId, batch_size> ids;
  std::array<CameraSample, batch_size> out;
  double sum = 0;
  size_t waiting = 0;
  const auto trace = [&] {
    trace_samples(scene, LightSettings(), 1, {ids.data(), waiting}, scratch, out.data());
    for (size_t k = 0; k < waiting; ++k) sum += double(out[k].total().x) + double(out[k].alpha);
    waiting = 0;
  };
  for (int y = 0; y < scene.camera.height; ++y)
    for (int x = 0; x < scene.camera.width; ++x)
      for (int n = 0; n < samples; ++n) {
        ids[waiting++] = {x, y, n % replicates, std::uint32_t(n / replicates)};
        if (waiting == ids.size()) trace();
      }
  trace();
  return sum;
}

/// The same; under callgrind its instructions, and no others, are dumped by that name.
double count_all(const Scene& scene, PathScratch& scratch, [[maybe_unused]] const std::string& name) {
#ifdef CALLGRIND_START_INSTRUMENTATION
  CALLGRIND_START_INSTRUMENTATION;
  const double sum = trace_all(scene, scratch);
  CALLGRIND_STOP_INSTRUMENTATION;
  CALLGRIND_DUMP_STATS_AT(name.c_str());
  return sum;
#else
  return trace_all(scene, scratch);
#endif
}

}  // namespace

void off() {
  fmt::print("an effect that is there and switched off against a scene that never had it, one thread, in turn\n");
  fmt::print("{:<18}{:>14}{:>14}{:>12}{:>20}\n", "effect", "off CPU-ms", "never CPU-ms", "off/never", "min to max");
  auto scratch = std::make_unique<PathScratch>();
  for (const Effect effect : effects) {
    const OffPair pair = pair_of(effect, usual_width);
    const std::string& name = effect_info(effect).name;
    require(trace_all(pair.off, *scratch) == trace_all(pair.never, *scratch), name + " off changes the picture");
    const Pair time = interleaved(
        rounds, [&] { trace_all(pair.off, *scratch); }, [&] { trace_all(pair.never, *scratch); });
    fmt::print("{:<18}{:>14.1f}{:>14.1f}{:>12.4f}{:>10.3f} to {:.3f}\n", name, 1e3 * time.a, 1e3 * time.b, time.ratio,
               time.low, time.high);
  }
}

void off_once() {
  fmt::print("the same pairs, each traced once more than to warm up; their instructions are counted by\n");
  fmt::print("valgrind --tool=callgrind --instr-atstart=no build/bin/sateen_bench off-once\n");
  auto scratch = std::make_unique<PathScratch>();
  for (const Effect effect : effects) {
    const OffPair pair = pair_of(effect, counted_width);
    const std::string& name = effect_info(effect).name;
    // What a first run alone does, such as finding what is open to the light, is no part of either.
    require(trace_all(pair.off, *scratch) == trace_all(pair.never, *scratch), name + " off changes the picture");
    const double off = count_all(pair.off, *scratch, name + " off");
    const double never = count_all(pair.never, *scratch, name + " never");
    require(off == never, name + " off changes the picture");
    fmt::print("{}\n", name);
  }
}

}  // namespace sateen::bench
