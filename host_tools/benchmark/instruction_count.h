// Counts the instructions of a tick with valgrind's callgrind. Unlike times, they are the same in
// every run, whatever else the machine does, so a change of a few percent shows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <vector>

#include "host_tools/bake/scene/image_writer.h"
#include "host_tools/benchmark/benchmark_mesh.h"

namespace tactus::host {

// Instructions a tick, over all ticks of a path.
struct InstructionCount {
  // The mean, and percentiles of the ticks.
  double mean = 0.0;
  double median = 0.0;
  double p99 = 0.0;
  double p999 = 0.0;
  double max = 0.0;
};

// Starts this program again under callgrind, which counts World::touch in every tick of `path` and
// nothing else. `path` has the tool's positions, m, world frame. It takes about a millisecond a
// tick, and 4 kB a tick in the folder for temporary files. Throws InputError if valgrind is missing
// or fails.
InstructionCount count_instructions(const BakedScene& scene, std::span<const Vec3> path);

// Returns the scene of one mesh with the material of object_of().
BakedScene scene_of(const BenchmarkMesh& mesh, bool friction, double tool_radius_m);

// Runs inside the program that count_instructions() has started: touches the scene in `folder`
// along the path there.
void touch_to_be_counted(const std::filesystem::path& folder);

// Returns the total of every part of callgrind's output that counted anything, in order.
std::vector<double> totals_of(std::istream& callgrind_out);

}  // namespace tactus::host
