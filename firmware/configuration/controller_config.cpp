#include "firmware/configuration/controller_config.h"

#include <algorithm>
#include <cmath>

#include "firmware/kinematics/range_check.h"
#include "rendering/tick_budget.h"

namespace tactus::firmware {
namespace {

// The bounds of a desktop device: of a joint's range, m or rad, and of its effort, N or N m. They
// only exclude wrong units; the limits that protect are configured.
constexpr double kWidest = 10.0;
constexpr double kStrongest = 1000.0;
// The largest push of the sign check. It leaves 0.5 N of the 2 N that a hand may feel unchecked.
constexpr double kMostSignCheck_N = 1.5;
constexpr double kLeastEffort = 1e-6;
constexpr double kStiffest = 1e12;
constexpr double kMostMargin = 100.0;
constexpr double kLeastTurnLength = 1e-9;
// The largest gravity in each direction, m/s^2: Jupiter's, the largest of the planets.
constexpr double kStrongestGravity = 25.0;

// The instructions of a tick: enough to touch one mesh, and more than any period has.
constexpr double kFewestInstructions = 50e3;
constexpr double kMostInstructions = 1e9;

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
    // A length of 0 would make the bristle of the compensation infinitely stiff.
    check.in("friction.turn_length", presliding_length(joint), kLeastTurnLength, 1.0);
  }
}

void check_coupled_limit(RangeCheck& check, const CoupledLimit& limit) {
  constexpr auto kLast = static_cast<double>(kJointCount - 1);
  check.in("coupled_limits.joint", static_cast<double>(limit.joint), 0.0, kLast);
  check.in("coupled_limits.minus", static_cast<double>(limit.minus), 0.0, kLast);
  check.in("coupled_limits.lower", limit.lower, -2.0 * kWidest, 2.0 * kWidest);
  check.in("coupled_limits.upper", limit.upper, limit.lower, 2.0 * kWidest);
}

void check_walls(RangeCheck& check, const SafetyConfig& safety) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double lower = safety.workspace_lower_W[axis];
    check.in("safety.workspace_lower_W", lower, -kWidest, kWidest);
    check.in("safety.workspace_upper_W", safety.workspace_upper_W[axis], lower, kWidest);
  }
  check.in("safety.workspace_stiffness_N_per_m", safety.workspace_stiffness_N_per_m, 0.0, 1e5);
  check.in("safety.workspace_damping_Ns_per_m", safety.workspace_damping_Ns_per_m, 0.0, kStrongest);
  check.in("safety.workspace_overrun_m", safety.workspace_overrun_m, 0.0, kWidest);
}

void check_safety(RangeCheck& check, const SafetyConfig& safety) {
  check.in("safety.max_force_N", safety.max_force_N, 0.0, kMaxForce_N);
  check.in("safety.force_slew_N_per_s", safety.force_slew_N_per_s, 1.0, 1e6);
  check.in("safety.soft_start_s", safety.soft_start_s, 0.0, 60.0);
  check.in("safety.contact_start_s", safety.contact_start_s, 0.0, 60.0);
  check.in("safety.max_sample_age_us", safety.max_sample_age_us, 0.0, 1e6);
  check.in("safety.stale_ticks_to_fault", safety.stale_ticks_to_fault, 1.0, 1000.0);
  check.in("safety.late_ticks_to_fault", safety.late_ticks_to_fault, 1.0, 1000.0);
  check.in("safety.max_tick_gap_s", safety.max_tick_gap_s, 0.0, 1.0);
  check.in("safety.max_joint_speed", safety.max_joint_speed, 0.0, 1e6);
  check.in("safety.frozen_travel", safety.frozen_travel, 0.0, kWidest);
  check.in("safety.blocked_effort_share", safety.blocked_effort_share, 0.0, 2.0);
  check.in("safety.blocked_s", safety.blocked_s, 0.0, 60.0);
  check.in("safety.sign_check_N", safety.sign_check_N, 0.0, kMostSignCheck_N);
  check.in("safety.moving_mass_kg", safety.moving_mass_kg, 0.0, kWidest);
  check.in("safety.max_tool_speed_m_per_s", safety.max_tool_speed_m_per_s, 0.01, 1000.0);
  check.in("safety.runaway_speed_m_per_s", safety.runaway_speed_m_per_s, 0.01, 1000.0);
  check.in("safety.runaway_travel_m", safety.runaway_travel_m, 0.0, kWidest);
  check_walls(check, safety);
  check.in("safety.device_delay_s", safety.device_delay_s, 0.0, 0.1);
  check.in("safety.device_damping_Ns_per_m", safety.device_damping_Ns_per_m, 0.0, kStrongest);
  check.in("safety.passivity_damping_Ns_per_m", safety.passivity_damping_Ns_per_m, 0.0, kStrongest);
  check.in("safety.passivity_fault_travel_m", safety.passivity_fault_travel_m, 0.0, kWidest);
}

void check_certificate(RangeCheck& check, const StiffnessCertificate& certificate) {
  check.in("certificate.count", static_cast<double>(certificate.count), 0.0, kMaxCertifiedPoints);
  check.in("certificate.margin", certificate.margin, 1.0, kMostMargin);
  const std::size_t count = std::min(certificate.count, kMaxCertifiedPoints);
  double least_damping = 0.0;
  for (const CertifiedPoint& point : std::span(certificate.points).first(count)) {
    check.in("certificate.damping_Ns_per_m", point.damping_Ns_per_m, least_damping, kStiffest);
    check.in("certificate.stiffness_N_per_m", point.stiffness_N_per_m, 0.0, kStiffest);
    // The dampings must rise, because stiffness is interpolated between neighbours.
    least_damping = std::nextafter(point.damping_Ns_per_m, kStiffest);
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

double tick_instructions(const ControllerConfig& config) {
  return config.tick_instructions > 0.0
             ? config.tick_instructions
             : rendering::default_tick_instructions(1.0 / config.rate_hz);
}

std::expected<void, ConfigError> validate(const ControllerConfig& config) {
  RangeCheck check;
  check.in("rate_hz", config.rate_hz, kMinRate_Hz, kMaxRate_Hz);
  if (config.tick_instructions != 0.0) {
    check.in("tick_instructions", config.tick_instructions, kFewestInstructions, kMostInstructions);
  }
  check_mechanism(check, config.mechanism);
  for (const double coordinate : config.workspace_origin_D) {
    check.in("workspace_origin_D", coordinate, -kWidest, kWidest);
  }
  for (const double component : config.gravity_D) {
    check.in("gravity_D", component, -kStrongestGravity, kStrongestGravity);
  }
  check.in("velocity_cutoff_hz", config.velocity_cutoff_hz, 0.0, config.rate_hz);
  for (const JointLimits& joint : config.joints) {
    check.in("joints.lower", joint.lower, -kWidest, kWidest);
    check.in("joints.upper", joint.upper, joint.lower, kWidest);
    check.in("joints.max_effort", joint.max_effort, kLeastEffort, kStrongest);
  }
  for (const CoupledLimit& limit : config.coupled_limits) {
    check_coupled_limit(check, limit);
  }
  for (const JointFriction& joint : config.friction) {
    check_friction(check, joint);
  }
  check_safety(check, config.safety);
  check_certificate(check, config.certificate);
  return check.result();
}

}  // namespace tactus::firmware
