// The measurements of `tactus bench` that count the time of ticks. Each prints its figures.
#pragma once

#include <cstddef>
#include <vector>

#include "host_tools/benchmark/benchmark_mesh.h"
#include "host_tools/benchmark/figures_file.h"

namespace tactus::host {

// The extent of the measurements, and the form in which they are shown.
struct TickBenchOptions {
  // The tool's radii for bench_touch.
  std::vector<double> radii_m{0.0, 0.002};
  // The number of ticks of a measurement, and the number of runs of the same ticks.
  std::size_t ticks = 20000;
  std::size_t runs = 5;
  // The simulated time for bench_sim.
  double seconds = 20.0;
  bool frictionless = false;
  // True: bench_touch counts instructions too.
  bool instructions = false;
  // True: bench_touch measures ticks after a sleep and with cold caches too.
  bool paced = false;
  bool json = false;
};

// Strokes one mesh with each tool radius: with a hand's motion, and with the path that jumps. The
// figures are appended to `file` if it is not null.
void bench_touch(const TickBenchOptions& options, const BenchmarkMesh& mesh, FiguresFile* file);

// Strokes one ball, alone and among others, to show what the others cost.
void bench_objects(const TickBenchOptions& options);

// Counts the instructions of ticks with 64 objects that move near the tool, slowly and fast, and
// with eight sheets that wave. It needs valgrind; throws InputError without it.
void bench_moving(const TickBenchOptions& options);

// Prints the multiplications and divisions of the god-object's position, and those of the lecture.
void bench_multiplications(const TickBenchOptions& options);

// Strokes one ball under every friction model.
void bench_friction(const TickBenchOptions& options);

// Runs the whole simulation on a mesh, to show simulated seconds for each second.
void bench_sim(const TickBenchOptions& options, const BenchmarkMesh& mesh);

}  // namespace tactus::host
