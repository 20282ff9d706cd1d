// Everything that is set before the controller runs: units in the names, defaults that are safe on
// a bench.
#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <string_view>

#include "firmware/kinematics/mechanism.h"
#include "firmware/limits.h"
#include "rendering/friction/friction_model.h"
#include "rendering/geometry/vector.h"

namespace tactus::firmware {

// rad and N m for a revolute joint, m and N for a prismatic one.
struct JointLimits {
  double lower = -0.25;  // beyond either: kFaultJointLimit
  double upper = 0.25;
  double max_effort = 10.0;  // the whole effort vector is scaled down to keep each joint's within
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
};

struct ControllerConfig {
  double rate_hz = 1000.0;
  MechanismGeometry mechanism = CartesianGeometry{};
  Vec3 workspace_origin_D =
      Vec3::Zero();  // m: the point of the device frame that is the world frame's origin
  double velocity_cutoff_hz = 0.0;  // first-order low-pass on the tool's velocity; 0 is none
  std::array<JointLimits, kJointCount> joints{};
  std::array<JointFriction, kJointCount> friction{};
  SafetyConfig safety;
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

// Three prismatic axes of +-0.25 m and 10 N.
ControllerConfig cartesian_config();

// Novint Falcon: its delta, its rated 8 N, the world's origin at the middle of its workspace.
ControllerConfig falcon_config();

}  // namespace tactus::firmware
