// Reads scene.toml into structs. host_tools/bake/README.md lists every key with its unit and
// default.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/bake/scene/body_description.h"
#include "host_tools/bake/scene/detail_description.h"
#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/motion_description.h"
#include "host_tools/bake/scene/needle_description.h"
#include "host_tools/bake/scene/placement.h"
#include "host_tools/bake/scene/shape_description.h"
#include "host_tools/bake/scene/target_device.h"
#include "rendering/effects/effect.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// An [[object]] of the scene.
struct ObjectDescription {
  // Unique in the scene; the mesh file's name without its extension unless the scene gives one.
  std::string name;
  // The primitive or formula; nothing for a mesh.
  ShapeDescription shape;
  // How the surface is rendered.
  rendering::ContactMethod contact = rendering::ContactMethod::sphere_proxy;
  // The height above a facet where the textbook's methods put their point, m.
  double push_out_m = rendering::kDefaultPushOut_m;
  // The mesh file, resolved against the scene file's folder; empty if the object has a shape.
  std::filesystem::path mesh;
  // The line of the mesh or the shape, for errors in it.
  std::size_t line = 0;
  // The object's place in the world, and its scale.
  Placement placement;
  rendering::Sides sides = rendering::Sides::one;
  rendering::Material material;
  // The line of the friction, for errors in it.
  std::size_t friction_line = 0;
  // The mesh's faces are turned around, since its file has them inside out.
  bool flip = false;
  // How the mesh is cleaned.
  MeshBakeOptions mesh_options;
  MotionDescription motion;
  // The body that moves by forces; nothing for an object that is none.
  std::optional<BodyDescription> body;
  // The tissue of a layer that a needle pierces; none for other objects.
  std::optional<rendering::Tissue> tissue;
  // Shading and textures.
  DetailDescription detail;
};

// A scene as its file describes it.
struct SceneDescription {
  // The file as errors name it.
  std::string file;
  double tool_radius_m = 0.0;
  // How many tools touch the scene, 1 to kMaxTools.
  std::size_t tool_count = 1;
  // The gravity that acts on bodies, m/s^2; nothing for the earth's, downward.
  std::optional<Vec3> gravity_W;
  // The effective modulus of soft fingers, Pa; 0 for fingers that touch bodies in a point.
  double soft_finger_modulus_Pa = 0.0;
  // The time for which bodies are at rest before they fall asleep, s; 0: never.
  double sleep_after_s = 0.0;
  // The needle of every tool; nothing for tools without one.
  std::optional<rendering::Needle> needle;
  // The device for which the friction is checked.
  TargetDevice device;
  // At least one.
  std::vector<ObjectDescription> objects;
  // The [[effect]] tables.
  std::vector<rendering::Effect> effects;
};

// The values for keys that the scene leaves out.
inline constexpr double kDefaultToolRadius_m = 0.002;
inline constexpr double kDefaultStiffness_N_per_m = 500.0;

// Reads a scene from its file or from a text; `path` is then its name for errors and for relative
// paths. Mesh files are not opened. Throws InputError `file:line: ...` for anything that is not a
// scene.
SceneDescription read_scene_description(const std::filesystem::path& path);
SceneDescription parse_scene_description(std::string_view text, const std::filesystem::path& path);

}  // namespace tactus::host
