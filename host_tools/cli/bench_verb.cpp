#include "host_tools/cli/bench_verb.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host_tools/bake/mesh_bake.h"
#include "host_tools/bake/mesh_import.h"
#include "host_tools/bake/placement.h"
#include "host_tools/benchmark/debian_bunny.h"
#include "host_tools/benchmark/touch_benchmark.h"
#include "host_tools/benchmark/workload.h"
#include "host_tools/input_error.h"
#include "host_tools/mesh/icosphere.h"
#include "host_tools/simulation/run.h"

namespace tactus::host {
namespace {

constexpr const char* kExamples =
    "touch: the tool presses 1 to 3 mm into the mesh, strokes, leaves and comes back every two "
    "seconds, friction\n"
    "0.6 / 0.4, 1000 N/m; spheres of 0.1 m radius from 1,280 to 1,310,720 triangles and Debian's "
    "bunny, each with a\n"
    "god-object point and a 2 mm sphere. sim: hand, device and controller in lockstep at 1 kHz. "
    "Times are of this\n"
    "machine and noisy: compare ratios within one run.\n"
    "\n"
    "Examples:\n"
    "  tactus bench\n"
    "  tactus bench touch --json > touch.jsonl\n"
    "  tactus bench touch --mesh dragon.ply --longest-side-m 0.2 --radius-m 0.002\n"
    "  tactus bench sim --seconds 30 --json | jq .simulated_s_per_s";

struct Options {
  std::string what = "all";
  std::string mesh;
  double longest_side_m = 0.15;
  std::vector<double> radii_m{0.0, 0.002};
  std::size_t ticks = 20000;
  double seconds = 20.0;
  bool frictionless = false;
  bool json = false;
};

struct NamedMesh {
  std::string name;
  BakedMesh mesh;
};

rendering::Object object_of(const NamedMesh& named, bool frictionless) {
  const rendering::ConeFriction friction{.static_coefficient = 0.6, .dynamic_coefficient = 0.4};
  return {.mesh = named.mesh.view(),
          .sides = rendering::Sides::one,
          .material = {.stiffness_N_per_m = 1000.0,
                       .friction = frictionless ? rendering::ConeFriction{} : friction}};
}

void print_touch(const Options& options, const NamedMesh& named, double radius_m,
                 const TouchTiming& timing) {
  if (options.json) {
    const nlohmann::ordered_json json{{"bench", "touch"},
                                      {"mesh", named.name},
                                      {"triangles", named.mesh.triangles.size()},
                                      {"radius_m", radius_m},
                                      {"friction", !options.frictionless},
                                      {"ticks", timing.ticks},
                                      {"median_ns", timing.median_ns},
                                      {"p99_ns", timing.p99_ns},
                                      {"p999_ns", timing.p999_ns},
                                      {"max_ns", timing.max_ns},
                                      {"contact_ticks", timing.contact_ticks},
                                      {"flagged_ticks", timing.flagged_ticks},
                                      {"peak_candidates", timing.peak_candidates}};
    fmt::print("{}\n", json.dump());
  } else {
    fmt::print(
        "touch {:<24} {:>9} triangles, radius {:>5.1f} mm: median {:>7.0f} ns, p99 {:>7.0f}, p99.9 "
        "{:>7.0f}, "
        "max {:>8.0f}; {} triangles near at most\n",
        named.name, named.mesh.triangles.size(), 1e3 * radius_m, timing.median_ns, timing.p99_ns,
        timing.p999_ns, timing.max_ns, timing.peak_candidates);
  }
  std::fflush(stdout);
}

void bench_touch(const Options& options, const NamedMesh& named) {
  const rendering::Object object = object_of(named, options.frictionless);
  for (const double radius_m : options.radii_m) {
    const std::vector<Vec3> path = stroke_workload(object.mesh, radius_m, options.ticks);
    print_touch(options, named, radius_m, time_touch(object, radius_m, path));
  }
}

void bench_sim(const Options& options, const NamedMesh& named) {
  constexpr double kToolRadius_m = 0.002;
  rendering::Object object = object_of(named, options.frictionless);
  RunOptions run_options;
  run_options.seconds = options.seconds;
  const RunPlan plan = plan_run(run_options, {&object, 1}, kToolRadius_m);
  Simulation simulation(plan.config, {&object, 1}, kToolRadius_m);
  const RunSummary summary =
      run(simulation, plan.seconds, run_options.rate_hz, [](const Simulation&) {});
  if (options.json) {
    const nlohmann::ordered_json json{{"bench", "sim"},
                                      {"mesh", named.name},
                                      {"triangles", named.mesh.triangles.size()},
                                      {"radius_m", kToolRadius_m},
                                      {"rate_hz", run_options.rate_hz},
                                      {"simulated_s", summary.simulated_s()},
                                      {"contact_ticks", summary.contact_ticks},
                                      {"simulated_s_per_s", summary.ratio()}};
    fmt::print("{}\n", json.dump());
  } else {
    fmt::print(
        "sim   {:<24} {:>9} triangles, radius {:>5.1f} mm: {:.0f} simulated seconds a second\n",
        named.name, named.mesh.triangles.size(), 1e3 * kToolRadius_m, summary.ratio());
  }
}

NamedMesh import(const std::string& name, const std::filesystem::path& file,
                 double longest_side_m) {
  ImportedMesh imported = import_mesh(file);
  const Placement placement{.longest_side_m = longest_side_m};
  return {.name = name, .mesh = bake_mesh(place(imported, placement))};
}

// Every mesh in turn; only one is held at a time.
void for_each_mesh(const Options& options, const std::function<void(const NamedMesh&)>& use) {
  if (!options.mesh.empty()) {
    use(import(std::filesystem::path(options.mesh).stem().string(), options.mesh,
               options.longest_side_m));
    return;
  }
  constexpr double kSphereRadius_m = 0.1;
  constexpr int kCoarsest = 3;
  constexpr int kFinest = 8;
  if (options.what != "sim") {
    for (int level = kCoarsest; level <= kFinest; ++level) {
      use({.name = "sphere", .mesh = bake_mesh(icosphere(kSphereRadius_m, level))});
    }
  }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("tactus-bench-{}", ::getpid());
  std::filesystem::create_directories(folder);
  const auto bunny = extract_debian_bunny(folder);
  if (bunny) {
    use(import("bunny", *bunny, options.longest_side_m));
  } else {
    fmt::print(
        stderr,
        "tactus bench: no bunny: install Debian's libcgal-demo, or give a mesh with --mesh\n");
  }
  std::filesystem::remove_all(folder);
}

void run_bench(const Options& options) {
  for_each_mesh(options, [&](const NamedMesh& named) {
    if (options.what != "sim") {
      bench_touch(options, named);
    }
    if (options.what != "touch" && named.name != "sphere") {
      bench_sim(options, named);
    }
  });
}

}  // namespace

void add_bench_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("bench", "Measure how long a tick takes");
  const auto options = std::make_shared<Options>();
  verb->add_option("what", options->what, "touch, sim or all")
      ->check(CLI::IsMember({"touch", "sim", "all"}))
      ->capture_default_str();
  verb->add_option("--mesh", options->mesh,
                   "Measure on this mesh file instead of spheres and bunny");
  verb->add_option("--longest-side-m", options->longest_side_m, "Size of the bunny or the mesh")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--radius-m", options->radii_m, "Tool radii for touch")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->add_option("--ticks", options->ticks, "Ticks a measurement for touch")
      ->check(CLI::Range(std::size_t{10}, std::size_t{100'000'000}))
      ->capture_default_str();
  verb->add_option("--seconds", options->seconds, "Simulated seconds for sim")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_flag("--frictionless", options->frictionless, "Without friction");
  verb->add_flag("--json", options->json, "Print one JSON object a line");
  verb->footer(kExamples);
  verb->callback([options] { run_bench(*options); });
}

}  // namespace tactus::host
