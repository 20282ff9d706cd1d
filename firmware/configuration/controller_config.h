// The configuration of the controller. Names end in units; the defaults are safe on a bench.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <string_view>

#include "firmware/kinematics/mechanism.h"
#include "firmware/kinematics/range_check.h"
#include "firmware/limits.h"
#include "firmware/safety/certificate.h"
#include "rendering/friction/friction_model.h"
#include "rendering/geometry/vector.h"

namespace tactus::firmware {

// The limits of a joint: rad and N m for a revolute joint, m and N for a prismatic one.
struct JointLimits {
  double lower = -0.25;  // a position outside lower to upper is kFaultJointLimit
  double upper = 0.25;
  double max_effort = 10.0;  // all efforts are scaled down together to keep each joint within this
};

// A stop between two links that are both driven from the base, as in a parallelogram. If the
// position of `joint` minus that of `minus` is outside lower to upper, it is kFaultJointLimit. The
// default is no stop.
struct CoupledLimit {
  std::size_t joint = 0;  // 0 is the first
  std::size_t minus = 0;
  double lower = 0.0;
  double upper = 0.0;
};

// The measured friction of a joint, and the share of it that the motor compensates
// (control/friction_compensation.h). Levels are in N and N s/m, or N m and N m s/rad.
struct JointFriction {
  rendering::FrictionParameters model;
  // Compensated share of Coulomb and viscous friction, 0 to kMaxCompensatedShare; 0 is off. It must
  // be below 1 by as much as the true friction may be below the model's.
  double compensated_share = 0.0;
  // The least displacement over which the compensation changes its sign, m or rad: a few encoder
  // counts. With 0 the model's presliding length alone counts, if it has a stiffness.
  double turn_length = 0.0;
};

// Returns the displacement over which the compensation of a joint changes its sign, m or rad; 0 if
// neither the model nor turn_length gives one.
double presliding_length(const JointFriction& joint);

struct SafetyConfig {
  double max_force_N = 10.0;           // largest force on the hand, vector magnitude
  double force_slew_N_per_s = 4000.0;  // fastest change of the force vector
  double soft_start_s = 0.5;  // after activation the force's gain rises from 0 to 1 in this time
  double contact_start_s = 0.02;  // the same after the first contact since activation
  std::uint32_t max_sample_age_us = 5000;
  std::uint32_t stale_ticks_to_fault = 3;  // this many samples in a row that are too old
  std::uint32_t late_ticks_to_fault = 3;   // this many late ticks in a row
  double max_tick_gap_s = 0.005;           // a gap of missed ticks longer than this is a fault

  // safety/encoder_guard.h; rad and rad/s for a revolute joint, m and m/s for a prismatic one.
  double max_joint_speed = 100.0;     // between two samples
  double frozen_travel = 0.05;        // largest integral of the velocity at an unchanged position
  double blocked_effort_share = 0.5;  // a change by this share of the largest effort must move it
  double blocked_s = 0.5;             // within this time

  // safety/motor_sign_check.h: the largest push at the handle that checks a motor's direction after
  // activation. 0 switches the check off, for tests whose samples do not depend on the effort.
  double sign_check_N = 1.0;
  // The device's mass at the handle. A joint that answers a push more than twice as strongly as
  // this mass allows is a fault. 0: the mass is not known, and nothing is checked.
  double moving_mass_kg = 0.0;

  // safety/motion_guard.h
  double max_tool_speed_m_per_s = 5.0;
  double runaway_speed_m_per_s = 2.5;  // a tool faster than this without a push ...
  double runaway_travel_m = 0.25;      // ... over this distance runs away

  // safety/workspace_walls.h: by default there are no walls. World frame, m.
  Vec3 workspace_lower_W = Vec3::Constant(-10.0);
  Vec3 workspace_upper_W = Vec3::Constant(10.0);
  double workspace_stiffness_N_per_m = 500.0;
  double workspace_damping_Ns_per_m = 1.0;
  double workspace_overrun_m = 0.02;  // deeper in a wall than this is a fault

  // safety/passivity.h
  double device_delay_s = 0.0015;  // from a sample until half of the force that answers it is there
  double device_damping_Ns_per_m = 0.3;     // least damping of the device without a hand
  double passivity_damping_Ns_per_m = 5.0;  // most damping that the controller adds; 0: none
  double passivity_fault_travel_m = 0.003;  // a debt above max_force_N times this is a fault

  // FaultBits that are not raised, for tests. A device's file has no key for it, and every tick
  // reports the limit guards_off.
  std::uint64_t guards_off = 0;
};

struct ControllerConfig {
  double rate_hz = 1000.0;  // ticks per second
  MechanismGeometry mechanism = CartesianGeometry{};
  Vec3 workspace_origin_D = Vec3::Zero();  // origin of the world frame in the device frame, m
  // Acceleration of gravity in the device frame, m/s^2, in the direction in which things fall
  // (control/gravity_compensation.h).
  Vec3 gravity_D = {0.0, -kStandardGravity_m_per_s2, 0.0};
  double velocity_cutoff_hz = 0.0;  // first-order low-pass on the tool's velocity; 0 is none
  std::array<JointLimits, kJointCount> joints{};  // the mechanism's joints; further ones are unused
  std::array<CoupledLimit, kMaxCoupledLimits> coupled_limits{};
  std::array<JointFriction, kJointCount> friction{};
  SafetyConfig safety;
  // The stiffness that surfaces may have. Without a certificate any scene may be loaded.
  StiffnessCertificate certificate;
  bool allow_uncertified = false;  // load a scene beyond the certificate too
};

// Returns the first field that is out of range as the error. Not real time.
std::expected<void, ConfigError> validate(const ControllerConfig& config);

// Configurations of known mechanisms. configuration/presets.cpp says where the figures come from
// and which are assumptions. The weights are zero, so that there is no gravity compensation, unless
// the comment says otherwise.

// Three prismatic axes of +-0.25 m and 10 N.
ControllerConfig cartesian_config();

// Novint Falcon with its rated 8 N; the world's origin in the middle of its workspace.
ControllerConfig falcon_config();

// Hapkit with Stanford's dimensions; the world's origin at the handle straight up.
ControllerConfig hapkit_config();

// Haply development kit, flat on the table; the world's origin in the middle of its workspace.
ControllerConfig haply_pantograph_config();

// PHANToM Premium 1.5; the world's origin at the tool with the upper arm level and the forearm
// hanging. The largest efforts are the motors' continuous ratings.
ControllerConfig phantom_premium_config();

// WoodenHaptics of 2015, with its weights; the world's origin is that of its own software.
ControllerConfig woodenhaptics_config();

struct Preset {
  std::string_view name;  // `kind` of [mechanism] in TOML, and of `tactus sim --device`
  ControllerConfig (*config)();
};

inline constexpr std::array kPresets{
    Preset{"cartesian", cartesian_config},
    Preset{"falcon", falcon_config},
    Preset{"hapkit", hapkit_config},
    Preset{"haply_pantograph", haply_pantograph_config},
    Preset{"phantom_premium", phantom_premium_config},
    Preset{"woodenhaptics", woodenhaptics_config},
};

// The names of the presets, in that order.
inline constexpr auto kPresetNames = [] {
  std::array<std::string_view, kPresets.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = kPresets[i].name;
  }
  return names;
}();

// Returns the configuration with one of kPresetNames, or nothing for another name.
std::optional<ControllerConfig> preset_config(std::string_view name);

}  // namespace tactus::firmware
