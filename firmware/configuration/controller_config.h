// The configuration of the controller: everything that is set before the start. Names end in units;
// the defaults are safe on a bench. Plain data; not for a tick.
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
#include "rendering/objects/object_body.h"

namespace tactus::firmware {

// The limits of a joint: rad and N m for a revolute joint, m and N for a prismatic one. A position
// outside lower to upper is kFaultJointLimit.
struct JointLimits {
  // The lowest allowed position.
  double lower = -0.25;
  // The highest allowed position.
  double upper = 0.25;
  // The largest effort. All joints' efforts are scaled down together to keep each joint within
  // this.
  double max_effort = 10.0;
};

// A stop between two links that are both driven from the base, as in a parallelogram. If the
// position of `joint` minus that of `minus` is outside lower to upper, it is kFaultJointLimit. The
// default is no stop: the difference of a joint with itself is 0.
struct CoupledLimit {
  // The indices of the two joints; 0 is the first.
  std::size_t joint = 0;
  std::size_t minus = 0;
  // The range of the difference, rad or m.
  double lower = 0.0;
  double upper = 0.0;
};

// The measured friction of a joint, and the share of it that the motor compensates
// (control/friction_compensation.h). Levels are in N and N s/m, or N m and N m s/rad.
struct JointFriction {
  // The measured friction. The compensation uses its Coulomb and viscous levels; its presliding
  // length follows from its largest level at rest and its stiffness.
  rendering::FrictionParameters model;
  // The compensated share of Coulomb and viscous friction, 0 to kMaxCompensatedShare; 0 is off. It
  // must be below 1 by as much as the true friction may be below the model's, or the joint moves by
  // itself.
  double compensated_share = 0.0;
  // The least displacement over which the compensation changes its sign, m or rad: a few encoder
  // counts. With 0 the model's presliding length alone counts, if it has a stiffness.
  double turn_length = 0.0;
};

// Returns the displacement over which the compensation of a joint changes its sign, m or rad; 0 if
// neither the model nor turn_length gives one.
double presliding_length(const JointFriction& joint);

// The limits and thresholds of the guards (firmware/safety/README.md). Force and speed are those of
// the tool.
struct SafetyConfig {
  // The largest force on the hand, N: the length of the vector.
  double max_force_N = 10.0;
  // The fastest change of the force vector, N/s, up and down.
  double force_slew_N_per_s = 4000.0;
  // After activation the force's gain rises from 0 to 1 in this time.
  double soft_start_s = 0.5;
  // The same after the first contact since activation, for all but effects.
  double contact_start_s = 0.02;
  // An older sample is stale, us.
  std::uint32_t max_sample_age_us = 5000;
  // This many stale samples in a row are kFaultStaleSamples.
  std::uint32_t stale_ticks_to_fault = 3;
  // This many late ticks in a row are kFaultLateTicks.
  std::uint32_t late_ticks_to_fault = 3;
  // Missed ticks in a row that take at least this long, s, are kFaultTickOverrun.
  double max_tick_gap_s = 0.005;

  // safety/encoder_guard.h: the largest speed between two samples, rad/s or m/s.
  double max_joint_speed = 100.0;
  // The largest integral of the velocity while the position stays the same, rad or m.
  double frozen_travel = 0.05;
  // A change of the effort by more than this share of the joint's largest must move the joint.
  double blocked_effort_share = 0.5;
  // The time, s, within which it must move.
  double blocked_s = 0.5;

  // safety/motor_sign_check.h: the largest push at the handle, N, that checks a motor's direction
  // after activation. 0 switches the check off, for tests whose samples do not depend on the
  // effort.
  double sign_check_N = 1.0;
  // The device's mass at the handle, kg. A joint that answers a push more than twice as strongly as
  // this mass allows is kFaultEffortMismatch. 0: the mass is not known, and only the direction is
  // checked.
  double moving_mass_kg = 0.0;

  // safety/motion_guard.h: a faster tool is kFaultOverspeed. Force along the motion fades from half
  // of it.
  double max_tool_speed_m_per_s = 5.0;
  // A tool that is faster than this, and that no force pushes in its direction, runs away.
  double runaway_speed_m_per_s = 2.5;
  // A tool that runs away over this distance is kFaultMotionWithoutTorque.
  double runaway_travel_m = 0.25;

  // safety/workspace_walls.h: the corners of the box that the tool shall not leave, world frame, m.
  // The default is so large that there are no walls.
  Vec3 workspace_lower_W = Vec3::Constant(-10.0);
  Vec3 workspace_upper_W = Vec3::Constant(10.0);
  double workspace_stiffness_N_per_m = 500.0;
  double workspace_damping_Ns_per_m = 1.0;
  // A tool that is deeper in a wall than this is kFaultWorkspace.
  double workspace_overrun_m = 0.02;

  // safety/passivity.h: the time from a sample until half of the force that answers it is there, s.
  double device_delay_s = 0.0015;
  // The least damping of the device without a hand. It takes back what sampling adds.
  double device_damping_Ns_per_m = 0.3;
  // The most damping that the controller adds; 0: none.
  double passivity_damping_Ns_per_m = 5.0;
  // A debt above max_force_N times this is kFaultNotPassive.
  double passivity_fault_travel_m = 0.003;

  // The FaultBits that are not raised, for tests. A device's file has no key for it, and every tick
  // reports the limit guards_off.
  std::uint64_t guards_off = 0;
};

// The devices of a controller that a fault of this one stops.
enum class OnFault : std::uint8_t { all, own };

// The configuration of the controller of one device. validate() checks it.
struct ControllerConfig {
  // The number of ticks per second.
  double rate_hz = 1000.0;
  // The instructions that a tick's rendering may take: its objects, effects and contacts. 0: those
  // that follow from the rate (rendering/tick_budget.h), 2 million at 1 kHz. A slow board needs
  // fewer, and `tactus doctor` says how many.
  double tick_instructions = 0.0;
  // The kind of mechanism with its lengths and weights.
  MechanismGeometry mechanism = CartesianGeometry{};
  // The origin of the world frame in the device frame, m. Both frames have the same directions.
  Vec3 workspace_origin_D = Vec3::Zero();
  // The acceleration of gravity in the device frame, m/s^2, in the direction in which things fall
  // (control/gravity_compensation.h).
  Vec3 gravity_D = rendering::standard_gravity_W();
  // The cutoff of the first-order low-pass on the tool's velocity, Hz; 0 is none.
  double velocity_cutoff_hz = 0.0;
  // The limits of the mechanism's joints. Entries beyond them are unused.
  std::array<JointLimits, kJointCount> joints{};
  // The stops between two links; unused ones have the default.
  std::array<CoupledLimit, kMaxCoupledLimits> coupled_limits{};
  // The friction of the joints and the compensated share.
  std::array<JointFriction, kJointCount> friction{};
  SafetyConfig safety;
  // The stiffness that surfaces may have. Without a certificate any scene may be loaded.
  StiffnessCertificate certificate;
  // True: a scene beyond the certificate is loaded too.
  bool allow_uncertified = false;
  // `all`: a fault takes the force from the controller's other devices as well. `own`: they go on,
  // but for an operator's stop.
  OnFault on_fault = OnFault::all;
};

// Returns the instructions that a tick's rendering may take with this configuration.
double tick_instructions(const ControllerConfig& config);

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
