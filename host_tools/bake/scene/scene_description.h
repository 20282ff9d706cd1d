// scene.toml as people write it. host_tools/bake/README.md lists every key with unit and default.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/bake/scene/detail_description.h"
#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/motion_description.h"
#include "host_tools/bake/scene/placement.h"
#include "host_tools/bake/scene/shape_description.h"
#include "host_tools/bake/scene/target_device.h"
#include "rendering/effects/effect.h"
#include "rendering/objects/object.h"

namespace tactus::host {

struct ObjectDescription {
  std::string name;
  ShapeDescription shape;
  rendering::ContactMethod contact = rendering::ContactMethod::sphere_proxy;
  std::filesystem::path mesh;  // relative paths are resolved against the scene file's folder; empty
                               // with a shape
  std::size_t line = 0;        // of the mesh key or the shape's, for errors in it
  Placement placement;
  rendering::Sides sides = rendering::Sides::one;
  rendering::Material material;
  std::size_t friction_line = 0;  // of its friction, for errors in it
  MeshBakeOptions mesh_options;
  MotionDescription motion;
  DetailDescription detail;
};

struct SceneDescription {
  std::string file;  // as errors name it
  double tool_radius_m = 0.0;
  std::size_t tool_count = 1;
  TargetDevice device;
  std::vector<ObjectDescription> objects;  // at least one
  std::vector<rendering::Effect> effects;
};

inline constexpr double kDefaultToolRadius_m = 0.002;
inline constexpr double kDefaultStiffness_N_per_m = 500.0;

// Throws InputError `file:line: ...` on anything that is not a scene. Mesh files are not opened.
SceneDescription read_scene_description(const std::filesystem::path& path);
SceneDescription parse_scene_description(std::string_view text, const std::filesystem::path& path);

}  // namespace tactus::host
