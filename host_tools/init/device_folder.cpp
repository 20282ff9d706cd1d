#include "host_tools/init/device_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "host_tools/bake/device/device_bake.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/private_folder.h"
#include "host_tools/init/device_text.h"
#include "host_tools/input_error.h"
#include "host_tools/reach/reach_summary.h"
#include "host_tools/simulation/device_workspace.h"

namespace tactus::host {
namespace {

constexpr std::array<std::string_view, 3> kFolderFiles{"device.toml", "scene.toml", "README.md"};

void write_text_file(const std::filesystem::path& file, std::string_view text) {
  write_file_atomically(file, std::as_bytes(std::span(text)));
}

// Returns the device of a plan. Throws InputError without the name of the temporary file.
LoadedDevice baked_plan(const DevicePlan& plan, const SolvedPlan& solved) {
  const PrivateFolder folder;
  const std::filesystem::path file = folder.path() / kFolderFiles[0];
  write_text_file(file, device_text(plan, solved));
  try {
    return bake_device(file);
  } catch (const InputError& error) {
    std::string words = error.what();
    if (const std::size_t at = words.find(file.string()); at != std::string::npos) {
      words.replace(at, file.string().size(), kFolderFiles[0]);
    }
    throw InputError(fmt::format("these answers do not make a device: {}", words));
  }
}

// Returns the middle of the workspace, the joints there and the force that is left.
SolvedPlan solve_plan(const DevicePlan& plan) {
  SolvedPlan solved;
  const LoadedDevice loaded = baked_plan(plan, solved);
  const ReachMap map(loaded.config());
  const PlantParameters& plant = map.device().device.plant;
  solved.middle_m = map.device().centre_B;
  MechanismPose pose;
  solve_mechanism(plant.mechanism, solved.middle_m, pose);
  solved.joints = joints_at(plant.mechanism, pose);
  solved.half_m = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double half_m = 0.5 * (plant.stop_upper_B[axis] - plant.stop_lower_B[axis]);
    solved.half_m = half_m > 0.0 ? std::min(solved.half_m, half_m) : solved.half_m;
  }
  constexpr double kMostForce_N = 10.0;
  constexpr double kLeastForce_N = 0.1;
  const double weakest_N = summarise_reach(map).weakest_N;
  solved.force_N = std::clamp(std::floor(10.0 * weakest_N) / 10.0, kLeastForce_N, kMostForce_N);
  return solved;
}

}  // namespace

void refuse_taken_folder(const std::filesystem::path& folder) {
  for (const std::string_view name : kFolderFiles) {
    if (std::filesystem::exists(folder / name)) {
      throw InputError(fmt::format("{}: is there already and is kept; name another folder",
                                   (folder / name).string()));
    }
  }
}

std::vector<std::filesystem::path> write_device_folder(const DevicePlan& plan,
                                                       const std::filesystem::path& folder) {
  refuse_taken_folder(folder);
  const SolvedPlan solved = solve_plan(plan);
  static_cast<void>(baked_plan(plan, solved));
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw InputError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  }
  const std::array<std::string, 3> texts{device_text(plan, solved), scene_text(plan, solved),
                                         readme_text(plan, solved)};
  std::vector<std::filesystem::path> files;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    files.push_back(folder / kFolderFiles[i]);
    write_text_file(files.back(), texts[i]);
  }
  return files;
}

}  // namespace tactus::host
