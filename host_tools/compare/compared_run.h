// One run of a comparison: a path over a scene that is baked in memory.
#pragma once

#include <string>
#include <vector>

#include "host_tools/bake/scene/progress.h"
#include "host_tools/bake/scene/scene_description.h"
#include "host_tools/touch/tool_path.h"
#include "rendering/touch.h"

namespace tactus::host {

// One tick of the first tool, world frame.
struct ComparedTick {
  double t_s = 0.0;
  Vec3 tool_W = Vec3::Zero();
  rendering::Touch touch;
  // The signed distance of the proxy from the surface that it touches, as the scene gives it, less
  // the tool's radius for sphere_proxy, m: below 0 the proxy is inside. On a formula to first
  // order; 0 without contact and on objects that move.
  double height_m = 0.0;
};

// A run, with at least one tick.
struct ComparedRun {
  std::string name;
  std::vector<ComparedTick> ticks;
};

// Bakes the scene and follows the path. Throws InputError that names the file if the scene cannot
// be baked.
ComparedRun follow(const std::string& name, const SceneDescription& scene, const ToolPath& path,
                   const Progress& progress);

}  // namespace tactus::host
