// Everything that is set before the controller runs: units in the names, defaults that are safe on
// a bench.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <string_view>

#include "firmware/kinematics/mechanism.h"
#include "firmware/limits.h"
#include "firmware/safety/certificate.h"
#include "rendering/friction/friction_model.h"
#include "rendering/geometry/vector.h"

namespace tactus::firmware {

// rad and N m for a revolute joint, m and N for a prismatic one.
struct JointLimits {
  double lower = -0.25;  // beyond either: kFaultJointLimit
  double upper = 0.25;
  double max_effort = 10.0;  // the whole effort vector is scaled down to keep each joint's within
};

// A stop between two links that are both driven from the base, as in a parallelogram: beyond it,
// position of `joint` - position of `minus`, kFaultJointLimit. The default holds nothing back.
struct CoupledLimit {
  std::size_t joint = 0;  // 0 is the first
  std::size_t minus = 0;
  double lower = 0.0;
  double upper = 0.0;
};

// The friction of a joint as it was measured, and how much of it the motor takes over
// (control/friction_compensation.h). Levels are N and N s/m, or N m and N m s/rad.
struct JointFriction {
  rendering::FrictionParameters model;
  // Of the Coulomb and the viscous friction, 0 to kMaxCompensatedShare; 0 is off. Less than one by
  // what the true friction may be below the model's.
  double compensated_share = 0.0;
  // m or rad: the push turns round over no less than this. A few counts of the encoder; 0 leaves it
  // to the model's own presliding, if it has a stiffness.
  double turn_length = 0.0;
};

// The displacement over which the compensation of a joint turns round, m or rad; 0 if neither the
// model nor turn_length says one.
double presliding_length(const JointFriction& joint);

struct SafetyConfig {
  double max_force_N = 10.0;           // largest force on the hand, vector magnitude
  double force_slew_N_per_s = 4000.0;  // fastest change of the force vector
  double soft_start_s = 0.5;      // the force's gain rises from 0 to 1 in this time from activation
  double contact_start_s = 0.02;  // and again from the first contact after activation
  std::uint32_t max_sample_age_us = 5000;
  std::uint32_t stale_ticks_to_fault = 3;  // samples in a row that are too old
  std::uint32_t late_ticks_to_fault = 3;   // ticks in a row that the loop calls late
  double max_tick_gap_s = 0.005;           // skipped at once, by the loop's count of missed ticks

  // safety/encoder_guard.h; rad and rad/s of a revolute joint, m and m/s of a prismatic one.
  double max_joint_speed = 100.0;     // from sample to sample
  double frozen_travel = 0.05;        // that its velocity claims while its position stands still
  double blocked_effort_share = 0.5;  // of its largest: so much a change of effort has to move it
  double blocked_s = 0.5;             // within this time

  // safety/motor_sign_check.h: the largest push at the handle that asks a motor for its direction
  // after activation; 0 asks none, for samples that a test makes up and no effort moves.
  double sign_check_N = 1.0;
  // The device's mass as the hand feels it at the handle. A joint that answers a push more than
  // twice as strongly as this mass allows is a fault. 0: the mass is not known, nothing is checked.
  double moving_mass_kg = 0.0;

  // safety/motion_guard.h
  double max_tool_speed_m_per_s = 5.0;
  double runaway_speed_m_per_s = 2.5;
  double runaway_travel_m = 0.25;

  // safety/workspace_walls.h: by default no walls
  Vec3 workspace_lower_W = Vec3::Constant(-10.0);
  Vec3 workspace_upper_W = Vec3::Constant(10.0);
  double workspace_stiffness_N_per_m = 500.0;
  double workspace_damping_Ns_per_m = 1.0;
  double workspace_overrun_m = 0.02;  // deeper in a wall than this is a fault

  // safety/passivity.h
  double device_delay_s = 0.0015;  // from a sample to the force that answers it, half way there
  double device_damping_Ns_per_m = 0.3;     // what the device has without a hand, at least
  double passivity_damping_Ns_per_m = 5.0;  // the most that the controller adds; 0: none
  double passivity_fault_travel_m = 0.003;  // max_force_N over this way: more debt is a fault

  // A seam for tests: faults that are not raised. No key of a device's file reaches it, and every
  // tick says so with guards_off.
  std::uint64_t guards_off = 0;
};

struct ControllerConfig {
  double rate_hz = 1000.0;
  MechanismGeometry mechanism = CartesianGeometry{};
  Vec3 workspace_origin_D =
      Vec3::Zero();  // m: the point of the device frame that is the world frame's origin
  // m/s^2, the way things fall, in the device frame: what the mechanism's weights are held up
  // against (control/gravity_compensation.h).
  Vec3 gravity_D = {0.0, -kStandardGravity_m_per_s2, 0.0};
  double velocity_cutoff_hz = 0.0;  // first-order low-pass on the tool's velocity; 0 is none
  std::array<JointLimits, kJointCount> joints{};  // those that the mechanism does not have: unused
  std::array<CoupledLimit, kMaxCoupledLimits> coupled_limits{};
  std::array<JointFriction, kJointCount> friction{};
  SafetyConfig safety;
  // What surfaces may be loaded; without one any.
  StiffnessCertificate certificate;
  bool allow_uncertified = false;  // load a scene beyond the certificate all the same
};

// What is wrong with a configuration: the field as written in this header, its value, and the
// allowed closed range.
struct ConfigError {
  std::string_view field;
  double value = 0.0;
  double least = 0.0;
  double greatest = 0.0;
};

// The first field that is out of range, or nothing. Not for a tick.
std::expected<void, ConfigError> validate(const ControllerConfig& config);

// Ready configurations of known mechanisms (configuration/presets.cpp says where the figures come
// from, and which are assumptions). Weights are zero, so no gravity compensation, where it is not
// said otherwise.

// Three prismatic axes of +-0.25 m and 10 N.
ControllerConfig cartesian_config();

// Novint Falcon: its delta, its rated 8 N, the world's origin at the middle of its workspace.
ControllerConfig falcon_config();

// Hapkit with Stanford's dimensions; the world's origin at the handle straight up.
ControllerConfig hapkit_config();

// Haply development kit, flat on the desk; the world's origin in the middle of what it reaches.
ControllerConfig haply_pantograph_config();

// PHANToM Premium 1.5; the world's origin at the tool with the upper arm level and the forearm
// hanging. Efforts are what its motors bear for good.
ControllerConfig phantom_premium_config();

// WoodenHaptics of 2015, with its weights; the world's origin where its own software has it.
ControllerConfig woodenhaptics_config();

inline constexpr std::array<std::string_view, 6> kPresetNames = {
    "cartesian", "falcon", "hapkit", "haply_pantograph", "phantom_premium", "woodenhaptics"};

// By one of kPresetNames, or nothing.
std::optional<ControllerConfig> preset_config(std::string_view name);

}  // namespace tactus::firmware
