// The text of the files that `tactus init arm` writes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "host_tools/init/device_plan.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

// The numbers that follow from a plan once its mechanism has been solved.
struct SolvedPlan {
  // The middle of the workspace in the device's frame, and half of its smallest side, m.
  Vec3 middle_m = Vec3::Zero();
  double half_m = 0.02;
  // The joints with the handle in the middle, rad or m.
  Vec3 joints = Vec3::Zero();
  // The force that the motors give everywhere in the workspace, N.
  double force_N = 1.0;
};

// Returns device.toml.
std::string device_text(const DevicePlan& plan, const SolvedPlan& solved);
// Returns scene.toml: one soft box in the middle of the workspace, or a wall for a paddle.
std::string scene_text(const DevicePlan& plan, const SolvedPlan& solved);
// Returns README.md, the next steps.
std::string readme_text(const DevicePlan& plan, const SolvedPlan& solved);

}  // namespace tactus::host
