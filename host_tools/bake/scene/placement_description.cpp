#include "host_tools/bake/scene/placement_description.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>

#include "hal/angle.h"

namespace tactus::host {
namespace {

constexpr std::array kRotationKeys{KeySpec{"axis", ""}, KeySpec{"angle_deg", "deg"},
                                   KeySpec{"quaternion_wxyz", ""}};

// Returns the rotation of a table, given as axis and angle or as a quaternion. The quaternion need
// not have unit length.
Eigen::Quaterniond read_rotation(const toml::table& table, const TomlSection& object,
                                 std::string_view file) {
  const TomlSection section(table, file, object.title() + " rotation", kRotationKeys);
  const auto axis = section.vector("axis");
  const auto angle_deg = section.number("angle_deg", kAnyNumber);
  const auto quaternion = section.numbers("quaternion_wxyz", 4);
  if (quaternion && !axis && !angle_deg) {
    const Eigen::Quaterniond q((*quaternion)[0], (*quaternion)[1], (*quaternion)[2],
                               (*quaternion)[3]);
    if (!(q.norm() > 0.0)) {
      section.fail("quaternion_wxyz", "quaternion_wxyz is zero; write [1.0, 0.0, 0.0, 0.0]");
    }
    return q.normalized();
  }
  if (quaternion || !axis || !angle_deg) {
    section.fail("axis",
                 "must be either { axis = [0.0, 1.0, 0.0], angle_deg = 90.0 } or "
                 "{ quaternion_wxyz = [1.0, 0.0, 0.0, 0.0] }; write one of the two");
  }
  const Vec3& direction = *axis;
  if (!(direction.norm() > 0.0)) {
    section.fail("axis", "axis is zero; write the direction to turn about, as in [0.0, 1.0, 0.0]");
  }
  return Eigen::Quaterniond(Eigen::AngleAxisd(hal::radians_of(*angle_deg), direction.normalized()));
}

}  // namespace

Placement read_placement(const TomlSection& section, std::string_view file) {
  Placement placement;
  placement.longest_side_m = section.number("longest_side_m", kAboveZero);
  const std::optional<double> scale = section.number("scale", kAboveZero);
  if (placement.longest_side_m && scale) {
    section.fail("scale", "both longest_side_m and scale set the size; leave one of them out");
  }
  placement.scale = scale.value_or(1.0);
  placement.position_m = section.vector("position_m").value_or(placement.position_m);
  if (const toml::table* rotation = section.table("rotation")) {
    placement.rotation = read_rotation(*rotation, section, file);
  }
  return placement;
}

}  // namespace tactus::host
