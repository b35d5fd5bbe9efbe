#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>

#include "base/parallel.h"
#include "bench.h"
#include "fabric/fabric.h"
#include "look/read.h"
#include "sampling/sampler.h"

namespace sateen::bench {

namespace {

constexpr const char* looks[] = {"linen_plain", "silk_crepe_de_chine", "polyester_satin_charmeuse", "velvet"};

std::vector<Vec3> directions(int count, int stream) {
  std::vector<Vec3> all;
  const Sequence sequence = pixel_sequence(7, stream, 0, 0);
  for (int i = 0; i < count; ++i) {
    const auto u = draw2(sequence, Dimension::uniform, std::uint32_t(i));
    const float z = 1 - float(u[0]) * 0.99f, r = std::sqrt(1 - z * z), a = 2 * pi * float(u[1]);
    all.emplace_back(r * std::cos(a), r * std::sin(a), z);
  }
  return all;
}

volatile float sink;

}  // namespace

void kernel() {
  fmt::print("{:<28}{:>10}{:>14}{:>12}{:>12}\n", "look", "tangents", "ns/direction", "ns/tangent", "ns/view");
  const std::vector<Vec3> wi = directions(1024, 1), wo = directions(64, 2);
  for (const char* name : looks) {
    const Fabric fabric = compile_fabric(read_look(name), same_space, {.table = false});
    // The answer first: the float kernel against the same template in double.
    const Look look = read_look(name);
    const auto quadrature = [&](const ThreadFamily& f) {
      return render_quadrature(f.offsets_deg, f.lengths, double(radians(std::min(f.gamma_s_deg, f.gamma_v_deg))),
                               double(radians(look.masking_width_deg)));
    };
    const Threads<double> exact = compile_threads<double>(look, quadrature(look.warp), quadrature(look.weft));
    auto view = std::make_unique<FabricView>();
    auto view_exact = std::make_unique<ThreadView<double>>();
    for (const Vec3& o : wo) {
      prepare_view(fabric, o, FabricSampler::uniform, *view);
      prepare_view<double>(exact, o.x, o.y, o.z, *view_exact);
      for (int i = 0; i < 16; ++i) {
        const ThreadSums<float> f = evaluate_parts(*view, wi[size_t(i) * 61]);
        const Vec3 w = wi[size_t(i) * 61];
        const ThreadSums<double> d = scatter<double>(exact, *view_exact, w.x, w.y, w.z);
        require(std::abs(double(f.volume[0]) - d.volume[0]) <= 1e-3 * d.volume[0] + 1e-6, "kernel against double");
      }
    }
    const double ns = nanoseconds(15, 1,
                                  [&] {
                                    float sum = 0;
                                    for (int v = 0; v < 16; ++v) {
                                      prepare_view(fabric, wo[size_t(v)], FabricSampler::uniform, *view);
                                      for (const Vec3& w : wi) sum += evaluate_parts(*view, w).surface[0];
                                    }
                                    sink = sum;
                                  }) /
                      (16 * double(wi.size()));
    const double view_ns = nanoseconds(15, 200,
                                       [&] {
                                         for (const Vec3& o : wo)
                                           prepare_view(fabric, o, FabricSampler::uniform, *view);
                                       }) /
                           double(wo.size());
    fmt::print("{:<28}{:>10}{:>14.1f}{:>12.2f}{:>12.1f}\n", name, fabric.threads.count, ns, ns / fabric.threads.count,
               view_ns);
  }
}

void samplers() {
  fmt::print("{:<28}{:>12}{:>12}{:>12}{:>12}{:>12}{:>14}\n", "look", "table CPU-s", "table KB", "sample ns", "pdf ns",
             "view ns", "variance/unif");
  const std::vector<Vec3> wo = directions(64, 3), wi = directions(1024, 4);
  for (const char* name : looks) {
    const Look look = read_look(name);
    const double start = cpu_seconds();
    const Fabric fabric = compile_fabric(look, same_space);
    const double compile = cpu_seconds() - start;
    auto view = std::make_unique<FabricView>();

    // The answer first: with sampled directions the mean of F / pdf is the albedo, and its variance is small.
    double variance = 0, uniform = 0;
    const Vec3 o = normalize(Vec3(0.4f, 0.3f, 0.7f));
    prepare_view(fabric, o, FabricSampler::table, *view);
    double sum = 0, squares = 0, uniform_squares = 0;
    constexpr int n = 20000;
    const Sequence sequence = pixel_sequence(1, 0, 0, 0);
    for (std::uint32_t i = 0; i < n; ++i) {
      FabricRandom u;
      u.choice = draw(sequence, Dimension::table_view, i);
      u.direction = draw2(sequence, Dimension::table, i);
      const Vec3 w = *sample(view->sampler, u);
      const double f = mean_component(evaluate(*view, w)), x = f / pdf(view->sampler, w);
      sum += x / n;
      squares += x * x / n;
      uniform_squares += f * x * 2 * double(pi) / n;
    }
    const double truth = mean_component(albedo_color(fabric, o));
    require(std::abs(sum - truth) < 0.01 * truth, "table sampling against the albedo");
    variance = squares - sum * sum;
    uniform = uniform_squares - sum * sum;

    const double view_ns = nanoseconds(15, 50,
                                       [&] {
                                         for (const Vec3& d : wo) sink = prepare_table(fabric.table, d).turn[0];
                                       }) /
                           double(wo.size());
    const double sample_ns =
        nanoseconds(
            15, 5,
            [&] {
              for (std::uint32_t i = 0; i < 1024; ++i) {
                const double a = (i * 0.618033988749895), b = i * 0.754877666246693;
                sink = sample_table(view->sampler.table, a - std::floor(a), b - std::floor(b), (i + 0.5) / 1024).x;
              }
            }) /
        1024;
    const double pdf_ns = nanoseconds(15, 5,
                                      [&] {
                                        float all = 0;
                                        for (const Vec3& d : wi) all += table_pdf(view->sampler.table, d);
                                        sink = all;
                                      }) /
                          double(wi.size());
    fmt::print("{:<28}{:>12.3f}{:>12.0f}{:>12.1f}{:>12.1f}{:>12.1f}{:>14.4f}\n", name, compile,
               double(fabric.table.cumulative.size()) * 4 / 1024, sample_ns, pdf_ns, view_ns, variance / uniform);
  }
}

}  // namespace sateen::bench
