#include "host_tools/cli/bench_loop.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "host_tools/install_command.h"
#include "host_tools/plot/panels.h"

namespace tactus::host {
namespace {

void print_json(std::string_view what, const LoopBenchOptions& options, const Jitter& jitter) {
  const nlohmann::ordered_json json{{"bench", what},
                                    {"rate_hz", options.plan.rate_hz},
                                    {"wake_ups", jitter.count},
                                    {"real_time", jitter.not_real_time.empty()},
                                    {"min_us", jitter.min_us},
                                    {"mean_us", jitter.mean_us},
                                    {"p99_us", percentile_us(jitter, 0.99)},
                                    {"p999_us", percentile_us(jitter, 0.999)},
                                    {"max_us", jitter.max_us}};
  fmt::print("{}\n", json.dump());
}

void print_text(std::string_view what, const LoopBenchOptions& options, const Jitter& jitter) {
  fmt::print(
      "{:<10} {:g} Hz, {} wake-ups late by: min {:.1f} us, mean {:.1f}, p99 {:.0f}, p99.9 {:.0f}, "
      "max {:.1f}\n{}",
      what, options.plan.rate_hz, jitter.count, jitter.min_us, jitter.mean_us,
      percentile_us(jitter, 0.99), percentile_us(jitter, 0.999), jitter.max_us,
      jitter_bars(jitter, 30));
}

void print(std::string_view what, const LoopBenchOptions& options, const Jitter& jitter) {
  options.json ? print_json(what, options, jitter) : print_text(what, options, jitter);
  std::fflush(stdout);
}

// Returns a curve of the bins that are not empty, with logarithmic counts, so that one wake-up in a
// million can be seen.
Curve curve_of(const char* name, const Jitter& jitter, CurveStyle style) {
  Curve curve{.name = name, .x = {}, .y = {}, .style = style};
  for (std::size_t i = 0; i < kJitterBins; ++i) {
    if (jitter.bins[i] > 0) {
      curve.x.push_back(static_cast<double>(i) + 0.5);
      curve.y.push_back(std::log10(static_cast<double>(jitter.bins[i])));
    }
  }
  return curve;
}

// Draws both histograms into the file that the user named.
void draw(const LoopBenchOptions& options, const Jitter& loop,
          const std::optional<Jitter>& cyclictest) {
  Panel panel{.x_label = "wake-up late by, us", .y_label = "log10 of wake-ups", .curves = {}};
  panel.curves.push_back(curve_of("tactus", loop, CurveStyle::line_with_points));
  if (cyclictest) {
    panel.curves.push_back(curve_of("cyclictest", *cyclictest, CurveStyle::points));
  }
  draw_panels(
      fmt::format("Wake-ups at {:g} Hz: longest {:.0f} us{}", options.plan.rate_hz, loop.max_us,
                  cyclictest ? fmt::format(", cyclictest {:.0f} us", cyclictest->max_us) : ""),
      std::array{panel}, options.figure);
  fmt::print(stderr, "{}\n", options.figure);
}

}  // namespace

void bench_loop(const LoopBenchOptions& options) {
  const Jitter loop = measure_loop(options.plan);
  if (!loop.not_real_time.empty()) {
    fmt::print(stderr, "tactus bench: not in real time ({}); tactus doctor says what mends it\n",
               loop.not_real_time);
  }
  print("loop", options, loop);
  // The comparison runs with real-time priority only if the loop had it.
  const auto cyclictest = measure_cyclictest(options.plan, loop.not_real_time.empty());
  if (!cyclictest) {
    fmt::print(stderr, "tactus bench: nothing to compare with: no cyclictest; {}\n",
               install_command("rt-tests"));
  } else {
    print("cyclictest", options, *cyclictest);
    if (!options.json && cyclictest->max_us > 0.0) {
      fmt::print("the loop's longest is {:.2f} times cyclictest's\n",
                 loop.max_us / cyclictest->max_us);
    }
  }
  if (!options.figure.empty()) {
    draw(options, loop, cyclictest);
  }
}

}  // namespace tactus::host
