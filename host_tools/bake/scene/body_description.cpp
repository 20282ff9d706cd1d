#include "host_tools/bake/scene/body_description.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>

#include "rendering/bodies/rigid_body.h"

namespace tactus::host {
namespace {

using rendering::ContactMethod;

constexpr std::array kBodyKeys{KeySpec{"mass_kg", "kg"},
                               KeySpec{"density_kg_per_m3", "kg_per_m3"},
                               KeySpec{"inertia_kg_m2", "kg_m2"},
                               KeySpec{"center_of_mass_m", "m"},
                               KeySpec{"part", ""},
                               KeySpec{"velocity_m_per_s", "m_per_s"},
                               KeySpec{"angular_velocity_rad_per_s", "rad_per_s"},
                               KeySpec{"linear_damping_per_s", "per_s"},
                               KeySpec{"angular_damping_per_s", "per_s"},
                               KeySpec{"restitution", ""},
                               KeySpec{"rolling_friction_m", "m"},
                               KeySpec{"spinning_friction_m", "m"}};

// Throws InputError for an object that cannot move by forces.
void require_movable(const TomlSection& object, ContactMethod contact,
                     const MotionDescription& motion) {
  if (motion.motion) {
    object.fail("motion", "a body moves by forces; leave out its motion or its body");
  }
  if (motion.deforms) {
    object.fail("deforms", "a body is rigid; leave out deforms or the body");
  }
  if (object.has("moves") && !motion.moves) {
    object.fail("moves", "moves is false, and yet there is a body; leave one of the two out");
  }
  if (!rendering::meets_proxy(contact)) {
    object.fail("contact",
                "a body is touched by contact = \"sphere_proxy\" or \"god_object\"; write one of "
                "them, or leave out the body");
  }
}

// Returns the torque over the normal force, m; 0 if the key is left out.
double read_turn_friction(const TomlSection& section, const char* key) {
  const double friction_m = section.number(key, kZeroOrMore).value_or(0.0);
  if (friction_m > rendering::kMostTurnFriction_m) {
    section.fail(key, fmt::format("{} is {} m, where {} m is the most: the torque over the normal "
                                  "force; is it in millimetres?",
                                  key, friction_m, rendering::kMostTurnFriction_m));
  }
  return friction_m;
}

}  // namespace

std::optional<BodyDescription> read_body(const TomlSection& object, std::string_view file,
                                         const BodyOwner& owner, MotionDescription& motion) {
  const toml::table* const table = object.table("body");
  if (table == nullptr) {
    return std::nullopt;
  }
  require_movable(object, owner.contact, motion);
  motion.moves = true;
  const TomlSection section(*table, file, object.title() + " body", kBodyKeys);
  if (section.has("mass_kg") && section.has("density_kg_per_m3")) {
    section.fail("density_kg_per_m3",
                 "mass_kg and density_kg_per_m3 say the same; leave one of the two out");
  }
  if (section.has("center_of_mass_m") &&
      !(section.has("mass_kg") && section.has("inertia_kg_m2"))) {
    section.fail("center_of_mass_m",
                 "the inertia is about the centre of mass; write mass_kg and inertia_kg_m2 beside "
                 "it, or leave it out");
  }
  const Vec3 none = Vec3::Zero();
  BodyDescription body{
      .line = object.line("body"),
      .mass_kg = section.number("mass_kg", kAboveZero),
      .density_kg_per_m3 =
          section.number("density_kg_per_m3", kAboveZero).value_or(kDefaultDensity_kg_per_m3),
      .inertia_kg_m2 = section.list("inertia_kg_m2").value_or(std::vector<double>{}),
      .center_of_mass_B = section.vector("center_of_mass_m"),
      .parts = read_parts(section, *table, file, owner.folder, owner.placement),
      .linear_damping_per_s = section.number("linear_damping_per_s", kZeroOrMore).value_or(0.0),
      .angular_damping_per_s = section.number("angular_damping_per_s", kZeroOrMore).value_or(0.0),
      .restitution = section.number("restitution", kZeroOrMore).value_or(0.0),
      .rolling_friction_m = read_turn_friction(section, "rolling_friction_m"),
      .spinning_friction_m = read_turn_friction(section, "spinning_friction_m"),
      .velocity_W = section.vector("velocity_m_per_s").value_or(none),
      .angular_velocity_B = section.vector("angular_velocity_rad_per_s").value_or(none)};
  if (!(body.velocity_W.norm() <= rendering::kFastestBody_m_per_s)) {
    section.fail("velocity_m_per_s",
                 fmt::format("the speed is {} m/s, where {} is the most", body.velocity_W.norm(),
                             rendering::kFastestBody_m_per_s));
  }
  if (!(body.angular_velocity_B.norm() <= rendering::kFastestBodyTurn_rad_per_s)) {
    section.fail(
        "angular_velocity_rad_per_s",
        fmt::format("the angular velocity is {} rad/s, where {} is the most",
                    body.angular_velocity_B.norm(), rendering::kFastestBodyTurn_rad_per_s));
  }
  if (body.restitution > 1.0) {
    section.fail("restitution", fmt::format("restitution is {}, where 1 is the most: the share of "
                                            "the speed that is left after a bounce",
                                            body.restitution));
  }
  return body;
}

}  // namespace tactus::host
