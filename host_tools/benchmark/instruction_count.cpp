// Callgrind is told by the name of a function when to count, and to write what it has counted and
// begin anew at every call of it: one part of its output for each tick.
#include "host_tools/benchmark/instruction_count.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <istream>
#include <memory>
#include <string>

#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/benchmark/percentile.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/private_folder.h"
#include "host_tools/input_error.h"
#include "host_tools/programs/external_program.h"
#include "rendering/scene/scene_world.h"
#include "rendering/world/world.h"

// Callgrind counts inside of this function only, and writes a part of its output before every call:
// one part for each tick. The name has C linkage, so that it can stand in callgrind's command line.
extern "C" [[gnu::noinline]] void tactus_counted_touch(tactus::rendering::World& world,
                                                       const tactus::Vec3& p_W) {
  world.touch({.p_W = p_W});
}

namespace tactus::host {
namespace {

namespace fs = std::filesystem;

// The files in the folder that both programs share.
constexpr const char* kScene = "scene.tactus";
constexpr const char* kPath = "path";
constexpr const char* kCounts = "callgrind.out";

// Writes the scene and the path for the program under callgrind.
void write_work(const fs::path& folder, const BakedScene& scene, std::span<const Vec3> path) {
  write_file_atomically(folder / kScene, write_image(scene));
  write_file_atomically(folder / kPath, std::as_bytes(path));
}

// Returns the positions that write_work() has written: bytes of the same program.
std::vector<Vec3> read_path(const fs::path& file) {
  const std::string bytes = read_file(file);
  std::vector<Vec3> path(bytes.size() / sizeof(Vec3));
  std::copy_n(bytes.data(), path.size() * sizeof(Vec3), reinterpret_cast<char*>(path.data()));
  return path;
}

}  // namespace

BakedScene scene_of(const BenchmarkMesh& mesh, bool friction, double tool_radius_m) {
  const rendering::Object object = object_of(mesh, friction);
  BakedScene scene{.tool_radius_m = tool_radius_m};
  scene.objects.push_back(
      {.name = mesh.name, .sides = object.sides, .material = object.material, .mesh = mesh.mesh});
  return scene;
}

InstructionCount count_instructions(const BakedScene& scene, std::span<const Vec3> path) {
  if (!command_succeeds("command -v valgrind")) {
    throw InputError("--instructions needs valgrind; install it (Debian: valgrind)");
  }
  const PrivateFolder folder;
  write_work(folder.path(), scene, path);
  const fs::path counts = folder.path() / kCounts;
  const std::string command = fmt::format(
      "valgrind --tool=callgrind --toggle-collect=tactus_counted_touch "
      "--dump-before=tactus_counted_touch --combine-dumps=yes --dump-line=no "
      "--callgrind-out-file={} {} bench --touch-to-be-counted {}",
      shell_quoted(counts), shell_quoted(fs::read_symlink("/proc/self/exe")),
      shell_quoted(folder.path()));
  if (!command_succeeds(command)) {
    throw InputError("callgrind failed; see whether `valgrind --tool=callgrind true` runs");
  }
  std::ifstream file(counts);
  std::vector<double> ticks = totals_of(file);
  if (ticks.size() != path.size()) {
    throw InputError(
        fmt::format("callgrind counted {} of {} ticks; --instructions needs valgrind 3.19 or newer",
                    ticks.size(), path.size()));
  }
  double sum = 0.0;
  for (const double tick : ticks) {
    sum += tick;
  }
  std::ranges::sort(ticks);
  return {.mean = sum / static_cast<double>(ticks.size()),
          .median = percentile(ticks, 0.5),
          .p99 = percentile(ticks, 0.99),
          .p999 = percentile(ticks, 0.999),
          .max = ticks.back()};
}

void touch_to_be_counted(const fs::path& folder) {
  const MappedScene scene(folder / kScene);
  const auto world = std::make_unique<rendering::World>();
  world->set_scene(scene.image().objects(), rendering::world_of(scene.image()));
  for (const Vec3& p : read_path(folder / kPath)) {
    tactus_counted_touch(*world, p);
  }
}

std::vector<double> totals_of(std::istream& callgrind_out) {
  const std::string key = "totals:";
  std::vector<double> totals;
  for (std::string line; std::getline(callgrind_out, line);) {
    if (line.starts_with(key)) {
      const double total = std::stod(line.substr(key.size()));
      if (total > 0.0) {
        totals.push_back(total);
      }
    }
  }
  return totals;
}

}  // namespace tactus::host
