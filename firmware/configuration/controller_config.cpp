#include "firmware/configuration/controller_config.h"

#include <algorithm>
#include <cmath>

namespace tactus::firmware {
namespace {

// Remembers the first value that is out of range. NaN is out of every range.
class RangeCheck {
 public:
  void in(std::string_view field, double value, double least, double greatest) {
    const bool inside = value >= least && value <= greatest;
    if (good_ && !inside) {
      good_ = false;
      error_ = {field, value, least, greatest};
    }
  }

  [[nodiscard]] std::expected<void, ConfigError> result() const {
    if (good_) {
      return {};
    }
    return std::unexpected(error_);
  }

 private:
  bool good_ = true;
  ConfigError error_;
};

// A device on a desk, in any unit that a joint has: metres, radians, newtons, newton metres.
constexpr double kWidest = 10.0;
constexpr double kStrongest = 1000.0;
constexpr double kLeastEffort = 1e-6;
constexpr double kStiffest = 1e12;
constexpr double kLeastTurnLength = 1e-9;

void check_geometry(RangeCheck& check, const DeltaGeometry& g) {
  check.in("mechanism.arm_m", g.arm_m, 0.001, 1.0);
  check.in("mechanism.rod_m", g.rod_m, 0.001, 1.0);
  check.in("mechanism.hinge_offset_m", g.hinge_offset_m, 0.0, g.rod_m);
  check.in("mechanism.base_radius_m", g.base_radius_m, 0.0, 1.0);
  check.in("mechanism.base_tangent_m", g.base_tangent_m, -1.0, 1.0);
  check.in("mechanism.platform_radius_m", g.platform_radius_m, 0.0, 1.0);
  check.in("mechanism.platform_tangent_m", g.platform_tangent_m, -1.0, 1.0);
  for (const double azimuth : g.azimuth_rad) {
    check.in("mechanism.azimuth_rad", azimuth, -6.3, 6.3);
  }
  check.in("mechanism.nominal_height_m", g.nominal_height_m, 0.0, 2.0);
}

void check_friction(RangeCheck& check, const JointFriction& joint) {
  check.in("friction.compensated_share", joint.compensated_share, 0.0, kMaxCompensatedShare);
  check.in("friction.turn_length", joint.turn_length, 0.0, 1.0);
  if (joint.compensated_share > 0.0) {
    const rendering::FrictionParameters& model = joint.model;
    check.in("friction.model.coulomb", model.coulomb, 0.0, kStrongest);
    check.in("friction.model.static_level", model.static_level,
             rendering::has_static_level(model.kind) ? model.coulomb : 0.0, kStrongest);
    check.in("friction.model.viscous_s_per_m", model.viscous_s_per_m, 0.0, kStrongest);
    check.in("friction.model.stiffness_N_per_m", model.stiffness_N_per_m, 0.0, kStiffest);
    check.in("friction.turn_length", presliding_length(joint), kLeastTurnLength, 1.0);
  }
}

}  // namespace

double presliding_length(const JointFriction& joint) {
  const rendering::FrictionParameters& model = joint.model;
  const double own = model.stiffness_N_per_m > 0.0
                         ? rendering::holding_level(model) / model.stiffness_N_per_m
                         : 0.0;
  return std::max(own, joint.turn_length);
}

std::expected<void, ConfigError> validate(const ControllerConfig& config) {
  RangeCheck check;
  check.in("rate_hz", config.rate_hz, kMinRate_Hz, kMaxRate_Hz);
  if (const auto* delta = std::get_if<DeltaGeometry>(&config.mechanism)) {
    check_geometry(check, *delta);
  }
  for (const double coordinate : config.workspace_origin_D) {
    check.in("workspace_origin_D", coordinate, -kWidest, kWidest);
  }
  check.in("velocity_cutoff_hz", config.velocity_cutoff_hz, 0.0, config.rate_hz);
  for (const JointLimits& joint : config.joints) {
    check.in("joints.lower", joint.lower, -kWidest, kWidest);
    check.in("joints.upper", joint.upper, joint.lower, kWidest);
    check.in("joints.max_effort", joint.max_effort, kLeastEffort, kStrongest);
  }
  for (const JointFriction& joint : config.friction) {
    check_friction(check, joint);
  }
  const SafetyConfig& safety = config.safety;
  check.in("safety.max_force_N", safety.max_force_N, 0.0, kMaxForce_N);
  check.in("safety.force_slew_N_per_s", safety.force_slew_N_per_s, 1.0, 1e6);
  check.in("safety.soft_start_s", safety.soft_start_s, 0.0, 60.0);
  check.in("safety.contact_start_s", safety.contact_start_s, 0.0, 60.0);
  check.in("safety.max_sample_age_us", safety.max_sample_age_us, 0.0, 1e6);
  check.in("safety.stale_ticks_to_fault", safety.stale_ticks_to_fault, 1.0, 1000.0);
  return check.result();
}

ControllerConfig cartesian_config() {
  return {};
}

ControllerConfig falcon_config() {
  ControllerConfig config;
  const DeltaGeometry geometry;
  config.mechanism = geometry;
  config.workspace_origin_D = {0.0, 0.0, geometry.nominal_height_m};
  // Contains every pose within 50 mm of the workspace's middle (-43 to 75 degrees). 0.67 N m is
  // what 8 N takes at the worst place and direction within 40 mm of it; the Falcon's true limit is
  // not published.
  config.joints.fill({.lower = -0.80, .upper = 1.45, .max_effort = 0.7});
  config.safety.max_force_N = 8.0;
  return config;
}

}  // namespace tactus::firmware
