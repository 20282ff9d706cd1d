#include "host_tools/cli/bench_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hal/angle.h"
#include "host_tools/benchmark/crowd.h"
#include "host_tools/benchmark/instruction_count.h"
#include "host_tools/benchmark/moving_scenes.h"
#include "host_tools/benchmark/multiplications.h"
#include "host_tools/benchmark/touch_benchmark.h"
#include "host_tools/benchmark/workload.h"
#include "host_tools/friction/parameter_names.h"
#include "host_tools/simulation/run.h"
#include "rendering/limits.h"

namespace tactus::host {
namespace {

nlohmann::ordered_json json_of(const InstructionCount& count) {
  return {{"mean", count.mean},
          {"median", count.median},
          {"p99", count.p99},
          {"p999", count.p999},
          {"max", count.max}};
}

std::string words_of(const InstructionCount& count) {
  return fmt::format(
      "instructions a tick: mean {:.0f}, median {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max {:.0f}",
      count.mean, count.median, count.p99, count.p999, count.max);
}

void print_json(const TouchFigures& figures) {
  const TouchTiming& timing = figures.timing;
  nlohmann::ordered_json json{{"bench", "touch"},
                              {"mesh", figures.mesh},
                              {"triangles", figures.triangles},
                              {"radius_m", figures.radius_m},
                              {"friction", figures.friction},
                              {"motion", figures.motion},
                              {"ticks", timing.ticks},
                              {"median_ns", timing.median_ns},
                              {"p99_ns", timing.p99_ns},
                              {"p999_ns", timing.p999_ns},
                              {"max_ns", timing.max_ns},
                              {"once_p999_ns", timing.once_p999_ns},
                              {"once_max_ns", timing.once_max_ns},
                              {"contact_ticks", timing.contact_ticks},
                              {"flagged_ticks", timing.flagged_ticks},
                              {"peak_candidates", timing.peak_candidates},
                              {"late_ticks", figures.lateness.late_ticks},
                              {"late_worst_m", figures.lateness.worst_m},
                              {"late_turn_rad", figures.lateness.worst_turn_rad},
                              {"late_in_a_row", figures.lateness.in_a_row},
                              {"late_turned", figures.lateness.turned_ticks}};
  if (const auto& count = figures.instructions) {
    json["instructions"] = json_of(*count);
  }
  if (figures.paced && figures.cold) {
    json["paced"] = {{"median_ns", figures.paced->median_ns}, {"p999_ns", figures.paced->p999_ns}};
    json["cold"] = {{"median_ns", figures.cold->median_ns}, {"p999_ns", figures.cold->p999_ns}};
  }
  fmt::print("{}\n", json.dump());
}

// Returns how late the ticks are, in words; nothing if none is.
std::string late_words(const Lateness& lateness) {
  return lateness.late_ticks == 0
             ? std::string()
             : fmt::format(
                   ", by {:.3g} mm and {:.0f} degrees of the force at most, at most {} in a row",
                   1e3 * lateness.worst_m, hal::degrees_of(lateness.worst_turn_rad),
                   lateness.in_a_row);
}

void print_single_times(const TouchFigures& figures) {
  if (figures.paced && figures.cold) {
    fmt::print(
        "      once each: after a sleep to the next ms median {:.0f} ns, p99.9 {:.0f}; with cold "
        "caches median {:.0f}, p99.9 {:.0f}\n",
        figures.paced->median_ns, figures.paced->p999_ns, figures.cold->median_ns,
        figures.cold->p999_ns);
  }
}

void print_text(const TouchFigures& figures) {
  const TouchTiming& timing = figures.timing;
  fmt::print(
      "touch {:<7} {:>8} triangles, radius {:>3.1f} mm, {:<6} median {:>6.0f} ns, p99 {:>7.0f}, "
      "p99.9 {:>7.0f}, max {:>7.0f} (run once {:.0f}, {:.0f}); {} of {} ticks late{}\n",
      figures.mesh, figures.triangles, 1e3 * figures.radius_m, figures.motion + ":",
      timing.median_ns, timing.p99_ns, timing.p999_ns, timing.max_ns, timing.once_p999_ns,
      timing.once_max_ns, figures.lateness.late_ticks, timing.ticks, late_words(figures.lateness));
  if (const auto& count = figures.instructions) {
    fmt::print("      {}\n", words_of(*count));
  }
  print_single_times(figures);
}

// A path of the tool with its name in the figures.
struct Motion {
  std::string name;
  std::vector<Vec3> path;
};

// Follows one path over one mesh, and prints and appends its row.
void bench_motion(const TickBenchOptions& options, const BenchmarkMesh& mesh, double radius_m,
                  const Motion& motion, FiguresFile* file) {
  const rendering::Object object = object_of(mesh, !options.frictionless);
  TouchFigures figures{.mesh = mesh.name,
                       .triangles = mesh.mesh.triangles.size(),
                       .radius_m = radius_m,
                       .friction = !options.frictionless,
                       .motion = motion.name,
                       .timing = time_touch({&object, 1}, radius_m, motion.path, options.runs),
                       .lateness = lateness_of({&object, 1}, radius_m, motion.path)};
  if (options.instructions) {
    figures.instructions =
        count_instructions(scene_of(mesh, figures.friction, radius_m), motion.path);
  }
  if (options.paced) {
    figures.paced = time_single_ticks({&object, 1}, radius_m, motion.path, Before::sleep);
    figures.cold = time_single_ticks({&object, 1}, radius_m, motion.path, Before::cold_cache);
  }
  options.json ? print_json(figures) : print_text(figures);
  std::fflush(stdout);
  if (file != nullptr) {
    file->append(figures);
  }
}

}  // namespace

void bench_touch(const TickBenchOptions& options, const BenchmarkMesh& mesh, FiguresFile* file) {
  const rendering::Object object = object_of(mesh, !options.frictionless);
  for (const double radius_m : options.radii_m) {
    const std::vector<Vec3> jumps = stroke_workload(object.mesh, radius_m, options.ticks);
    bench_motion(options, mesh, radius_m, {"hand", hand_workload(object, radius_m, jumps)}, file);
    bench_motion(options, mesh, radius_m, {"jumps", jumps}, file);
  }
}

void bench_objects(const TickBenchOptions& options) {
  constexpr double kToolRadius_m = 0.002;
  double alone_ns = 0.0;
  for (const std::size_t count : {std::size_t{1}, std::size_t{64}, std::size_t{1000}}) {
    const Crowd crowd(count);
    const std::vector<Vec3> path =
        stroke_workload(crowd.objects()[0].mesh, kToolRadius_m, options.ticks);
    const TouchTiming timing = time_touch(crowd.objects(), kToolRadius_m, path, options.runs);
    alone_ns = count == 1 ? timing.median_ns : alone_ns;
    if (options.json) {
      const nlohmann::ordered_json json{{"bench", "objects"},
                                        {"objects", count},
                                        {"radius_m", kToolRadius_m},
                                        {"ticks", timing.ticks},
                                        {"median_ns", timing.median_ns},
                                        {"p99_ns", timing.p99_ns},
                                        {"p999_ns", timing.p999_ns},
                                        {"max_ns", timing.max_ns}};
      fmt::print("{}\n", json.dump());
    } else {
      fmt::print("objects {:>4}: median {:>6.0f} ns, {:+.0f} against one alone; p99 {:>7.0f}\n",
                 count, timing.median_ns, timing.median_ns - alone_ns, timing.p99_ns);
    }
    std::fflush(stdout);
  }
}

// Callgrind takes milliseconds for a tick of these scenes, so it counts fewer ticks than others.
void bench_moving(const TickBenchOptions& options) {
  constexpr std::size_t kMostTicks = 5000;
  constexpr int kCoarse = 2;
  constexpr int kFine = 3;
  const std::size_t ticks = std::min(options.ticks, kMostTicks);
  for (const MovingScene& moving :
       {swarm("64 movers near", kCoarse, 1.0, ticks),
        swarm("64 fast movers near", kFine, 5.0, ticks), sheets(ticks), wall("8 bodies", 8, ticks),
        wall("32 bodies", rendering::kMaxBodies, ticks), layers(ticks)}) {
    const InstructionCount count = count_instructions(moving.scene, moving.path);
    if (options.json) {
      const nlohmann::ordered_json json{{"bench", "moving"},
                                        {"scene", moving.name},
                                        {"radius_m", moving.scene.tool_radius_m},
                                        {"ticks", ticks},
                                        {"instructions", json_of(count)}};
      fmt::print("{}\n", json.dump());
    } else {
      fmt::print("moving {:<19}: {}\n", moving.name, words_of(count));
    }
    std::fflush(stdout);
  }
}

void bench_multiplications(const TickBenchOptions& options) {
  const Multiplications here = count_multiplications();
  for (std::size_t planes = 1; planes <= here.size(); ++planes) {
    const std::size_t taught = kMultiplicationsOfTheLecture.at(planes - 1);
    const std::size_t counted = here.at(planes - 1);
    if (options.json) {
      const nlohmann::ordered_json json{
          {"bench", "multiplications"}, {"planes", planes}, {"lecture", taught}, {"here", counted}};
      fmt::print("{}\n", json.dump());
    } else {
      fmt::print("multiplications {} active plane{}: the lecture {}, here {}\n", planes,
                 planes == 1 ? " " : "s", taught, counted);
    }
  }
}

// The cone comes first, since the others are compared with it.
void bench_friction(const TickBenchOptions& options) {
  constexpr int kLevel = 5;
  constexpr double kToolRadius_m = 0.002;
  const BenchmarkMesh ball = sphere_mesh(kLevel);
  rendering::Object object = object_of(ball, true);
  const std::vector<Vec3> path = stroke_workload(object.mesh, kToolRadius_m, options.ticks);
  double cone_ns = 0.0;
  for (const rendering::FrictionModelTraits& kind : rendering::kFrictionModels) {
    object.material.friction = fingertip_friction(kind.kind);
    const TouchTiming timing = time_touch({&object, 1}, kToolRadius_m, path, options.runs);
    cone_ns = kind.kind == rendering::FrictionKind::cone ? timing.median_ns : cone_ns;
    if (options.json) {
      const nlohmann::ordered_json json{{"bench", "friction"},           {"model", kind.name},
                                        {"radius_m", kToolRadius_m},     {"ticks", timing.ticks},
                                        {"median_ns", timing.median_ns}, {"p99_ns", timing.p99_ns},
                                        {"p999_ns", timing.p999_ns},     {"max_ns", timing.max_ns}};
      fmt::print("{}\n", json.dump());
    } else {
      fmt::print("friction {:<15}: median {:>6.0f} ns, {:+.0f} against the cone; p99 {:>7.0f}\n",
                 kind.name, timing.median_ns, timing.median_ns - cone_ns, timing.p99_ns);
    }
    std::fflush(stdout);
  }
}

void bench_sim(const TickBenchOptions& options, const BenchmarkMesh& mesh) {
  constexpr double kToolRadius_m = 0.002;
  rendering::Object object = object_of(mesh, !options.frictionless);
  RunOptions run_options;
  run_options.seconds = options.seconds;
  const RunPlan plan = plan_run(run_options, {&object, 1}, kToolRadius_m);
  Simulation simulation(plan.devices, {&object, 1}, kToolRadius_m);
  const RunSummary summary =
      run(simulation, plan.seconds, run_options.rate_hz, [](const Simulation&) {}).front();
  if (options.json) {
    const nlohmann::ordered_json json{{"bench", "sim"},
                                      {"mesh", mesh.name},
                                      {"triangles", mesh.mesh.triangles.size()},
                                      {"radius_m", kToolRadius_m},
                                      {"rate_hz", run_options.rate_hz},
                                      {"simulated_s", summary.simulated_s()},
                                      {"contact_ticks", summary.contact_ticks},
                                      {"simulated_s_per_s", summary.ratio()}};
    fmt::print("{}\n", json.dump());
  } else {
    fmt::print(
        "sim   {:<24} {:>9} triangles, radius {:>5.1f} mm: {:.0f} simulated seconds a second\n",
        mesh.name, mesh.mesh.triangles.size(), 1e3 * kToolRadius_m, summary.ratio());
  }
}

}  // namespace tactus::host
