// Reads [object.body]: what makes an object a body that moves by forces.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "host_tools/bake/scene/motion_description.h"
#include "host_tools/bake/scene/part_description.h"
#include "host_tools/bake/toml/toml_section.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// The density of a body whose scene gives neither mass nor density, that of water.
inline constexpr double kDefaultDensity_kg_per_m3 = 1000.0;

// A body as its scene describes it. Vectors are given along the axes of the object.
struct BodyDescription {
  // The line of the table, for errors in it.
  std::size_t line = 0;
  // The mass, or nothing where the density says it.
  std::optional<double> mass_kg;
  double density_kg_per_m3 = kDefaultDensity_kg_per_m3;
  // Three or nine numbers; none where the shape says it.
  std::vector<double> inertia_kg_m2;
  // The centre of mass in the object's frame, m; nothing where the shape says it.
  std::optional<Vec3> center_of_mass_B;
  // The convex parts by which others are met; none where the hull of the shape is.
  std::vector<PartDescription> parts;
  double linear_damping_per_s = 0.0;
  double angular_damping_per_s = 0.0;
  double restitution = 0.0;
  double rolling_friction_m = 0.0;
  double spinning_friction_m = 0.0;
  // The velocity of the centre of mass (world frame, m/s), and the angular velocity along the axes
  // of the object, rad/s.
  Vec3 velocity_W = Vec3::Zero();
  Vec3 angular_velocity_B = Vec3::Zero();
};

// The object to which a body belongs: the folder of its scene, its place and its contact.
struct BodyOwner {
  std::filesystem::path folder;
  Placement placement;
  rendering::ContactMethod contact = rendering::ContactMethod::sphere_proxy;
};

// Reads the table, if there is one, and makes the object move. Throws InputError with the file and
// the line, also for an object that cannot be a body.
std::optional<BodyDescription> read_body(const TomlSection& object, std::string_view file,
                                         const BodyOwner& owner, MotionDescription& motion);

}  // namespace tactus::host
