#include "host_tools/bake/scene/motion_description.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>

namespace tactus::host {
namespace {

using rendering::ContactMethod;
using rendering::Motion;

constexpr std::array kMotionKeys{KeySpec{"velocity_m_per_s", "m_per_s"},
                                 KeySpec{"sway_m", "m"},
                                 KeySpec{"sway_hz", "hz"},
                                 KeySpec{"spin_rad_per_s", "rad_per_s"},
                                 KeySpec{"pivot_m", "m"},
                                 KeySpec{"wave_m", "m"},
                                 KeySpec{"wave_hz", "hz"},
                                 KeySpec{"waves_per_m", "per_m"}};

Motion read(const toml::table& table, const TomlSection& object, std::string_view file,
            const MotionDescription& description, const Vec3& rest) {
  const TomlSection section(table, file, object.title() + " motion", kMotionKeys);
  const Vec3 none = Vec3::Zero();
  const Motion motion{.velocity_W = section.vector("velocity_m_per_s").value_or(none),
                      .sway_W = section.vector("sway_m").value_or(none),
                      .sway_Hz = section.number("sway_hz", kZeroOrMore).value_or(0.0),
                      .spin_W = section.vector("spin_rad_per_s").value_or(none),
                      .pivot_W = section.vector("pivot_m").value_or(rest),
                      .wave_m = section.number("wave_m", kAnyNumber).value_or(0.0),
                      .wave_Hz = section.number("wave_hz", kZeroOrMore).value_or(0.0),
                      .wave_per_m = section.vector("waves_per_m").value_or(none)};
  if (motion.wave_m != 0.0 && !description.deforms) {
    section.fail("wave_m", "only a mesh that deforms has waves; write deforms = true");
  }
  if (section.has("sway_m") != section.has("sway_hz")) {
    section.fail("sway_m",
                 "sway_m and sway_hz belong together; write sway_m = [0.0, 0.01, 0.0] and sway_hz "
                 "= 1.0");
  }
  if (!valid(motion)) {
    section.fail("velocity_m_per_s", fmt::format("a length is above {} m; write it in metres",
                                                 rendering::kWorldBound_m));
  }
  return motion;
}

}  // namespace

MotionDescription read_motion(const TomlSection& object, std::string_view file,
                              const ShapeDescription& shape, ContactMethod contact,
                              const Vec3& rest) {
  const toml::table* const table = object.table("motion");
  MotionDescription description{.deforms = object.flag("deforms").value_or(false)};
  description.moves = object.flag("moves").value_or(table != nullptr);
  const bool is_mesh = std::holds_alternative<std::monostate>(shape);
  if (description.deforms && (!is_mesh || !rendering::renders_deforming(contact))) {
    object.fail("deforms",
                "only a mesh with contact = \"sphere_proxy\" or \"god_object\" can deform; leave "
                "deforms out or change the contact");
  }
  if (table != nullptr && !description.moves) {
    object.fail("moves", "moves is false, and yet there is a motion; leave one of the two out");
  }
  if (table != nullptr) {
    description.motion = read(*table, object, file, description, rest);
  }
  return description;
}

}  // namespace tactus::host
