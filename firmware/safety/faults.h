// The faults and limits of a tick, with stable codes: a code never gets a new meaning. This is the
// only table of trigger, reaction and recovery; `tactus faults --markdown` writes the table of the
// README from it.
//
// A fault (codes 0 to 15 and 32 to 47) stops the device: zero effort and motor power off in the
// same tick, latched until a reset with healthy inputs. A limit (codes 16 to 31 and 48 to 63) does
// not stop: it says that this tick's output was held back.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

namespace tactus::firmware {

// One bit for each fault and limit; the bit's number is the stable code.
enum FaultBits : std::uint64_t {
  kNoFault = 0,
  kFaultNotConfigured = 1ULL << 0,
  kFaultJointNotFinite = 1ULL << 1,
  kFaultJointLimit = 1ULL << 2,
  kFaultStaleSamples = 1ULL << 3,
  kFaultReferenceLost = 1ULL << 4,
  kFaultEncoder = 1ULL << 5,
  kFaultDrive = 1ULL << 6,
  kFaultDeviceLost = 1ULL << 7,
  kFaultEmergencyStop = 1ULL << 8,
  kFaultOperatorStop = 1ULL << 9,
  kFaultKinematicsNotConverged = 1ULL << 10,
  kFaultKinematicsSingular = 1ULL << 11,
  kFaultToolNotFinite = 1ULL << 12,
  kFaultForceNotFinite = 1ULL << 13,
  kFaultCommandNotFinite = 1ULL << 14,
  kFaultLateTicks = 1ULL << 15,

  kLimitSoftStart = 1ULL << 16,
  kLimitForce = 1ULL << 17,
  kLimitSlew = 1ULL << 18,
  kLimitEffort = 1ULL << 19,
  kLimitStaleSample = 1ULL << 20,
  kLimitTouch = 1ULL << 21,
  kLimitCompensation = 1ULL << 22,
  kLimitGravity = 1ULL << 23,

  kFaultTickOverrun = 1ULL << 32,
  kFaultWatchdog = 1ULL << 33,
  kFaultWorkspace = 1ULL << 34,
  kFaultOverspeed = 1ULL << 35,
  kFaultEncoderFrozen = 1ULL << 36,
  kFaultEncoderJump = 1ULL << 37,
  kFaultTorqueWithoutMotion = 1ULL << 38,
  kFaultMotionWithoutTorque = 1ULL << 39,
  kFaultOverTemperature = 1ULL << 40,
  kFaultNotPassive = 1ULL << 41,
  kFaultHelperCrashed = 1ULL << 42,
  kFaultMotorReversed = 1ULL << 43,
  kFaultEffortMismatch = 1ULL << 44,
  kFaultOtherDevice = 1ULL << 45,
  kFaultLineLost = 1ULL << 46,

  kLimitLateTick = 1ULL << 48,
  kLimitWorkspace = 1ULL << 49,
  kLimitSpeed = 1ULL << 50,
  kLimitPassivity = 1ULL << 51,
  kLimitGuardsOff = 1ULL << 52,
  kLimitChange = 1ULL << 53,
  kLimitSignCheck = 1ULL << 54,
};

// The bits of all faults, and of all limits.
inline constexpr std::uint64_t kFaultMask = 0x0000'FFFF'0000'FFFFULL;
inline constexpr std::uint64_t kLimitMask = ~kFaultMask;

// The row of a fault or limit in the table.
struct FaultText {
  FaultBits bit;
  // The name, for programs.
  std::string_view name;
  // The trigger, for people.
  std::string_view meaning;
  // The reaction in addition to the zero effort of every fault.
  std::string_view reaction;
  // The way back. "reset" stands for: remove the cause, then reset, home, enable.
  std::string_view recovery;
};

// The texts, in the order of the codes.
inline constexpr auto kFaultTexts = std::to_array<FaultText>({
    {kFaultNotConfigured, "not_configured", "tick before a successful configure", "stop",
     "call `configure`"},
    {kFaultJointNotFinite, "joint_not_finite", "joint position or velocity NaN or infinite",
     "stop; tool held where it was", "reset"},
    {kFaultJointLimit, "joint_limit", "joint position outside its configured range", "stop",
     "move back inside by hand, reset"},
    {kFaultStaleSamples, "stale_samples", "too many samples in a row too old", "stop", "reset"},
    {kFaultReferenceLost, "reference_lost",
     "joint's zero may have moved (its drive or board restarted, lost power or fell silent), or "
     "device not ready or homing while active",
     "stop; that joint's reference is gone", "reset, home again"},
    {kFaultEncoder, "encoder", "device reports an encoder fault", "stop", "reset"},
    {kFaultDrive, "drive", "device reports a motor drive fault", "stop", "reset"},
    {kFaultDeviceLost, "device_lost", "no way to reach the motors",
     "stop; the device must stop by itself", "reset"},
    {kFaultEmergencyStop, "emergency_stop", "emergency stop line is open", "stop",
     "close the line, reset"},
    {kFaultOperatorStop, "operator_stop", "stop requested by the operator or a program", "stop",
     "reset"},
    {kFaultKinematicsNotConverged, "kinematics_not_converged", "no tool position fits the joints",
     "stop", "reset; check geometry and homing"},
    {kFaultKinematicsSingular, "kinematics_singular", "pose too near a singularity", "stop",
     "move toward the middle, reset"},
    {kFaultToolNotFinite, "tool_not_finite", "tool position or velocity NaN or infinite",
     "stop; tool held where it was", "reset"},
    {kFaultForceNotFinite, "force_not_finite", "touch gave a NaN or infinite result",
     "stop; touch forgotten", "reset; check the scene's material"},
    {kFaultCommandNotFinite, "command_not_finite", "joint effort NaN or infinite", "stop", "reset"},
    {kFaultLateTicks, "late_ticks", "too many ticks in a row began too late", "stop",
     "reset; `tactus doctor` says what holds the loop up"},
    {kLimitSoftStart, "soft_start", "force still rising after activation or first contact",
     "force scaled down", "by itself"},
    {kLimitForce, "limiting_force", "force held at its largest magnitude",
     "force shortened, direction kept", "by itself"},
    {kLimitSlew, "limiting_slew", "change of force held at its largest rate", "force follows late",
     "by itself"},
    {kLimitEffort, "limiting_effort", "force scaled down to a joint's largest effort",
     "all efforts scaled alike", "by itself"},
    {kLimitStaleSample, "stale_sample", "sample too old, used once more",
     "tick computed from the repeated sample", "by the next fresh sample"},
    {kLimitTouch, "limiting_touch", "touch gave up something: see the touch flags",
     "bounded force, see `TouchFlags`", "by itself"},
    {kLimitCompensation, "limiting_compensation",
     "friction compensation held back by a force or effort limit", "less friction is taken over",
     "by itself"},
    {kLimitGravity, "limiting_gravity", "gravity compensation cut at a joint's largest effort",
     "the mechanism sags there; no room is left for the rendered force",
     "by itself; check the weights"},
    {kFaultTickOverrun, "tick_overrun", "loop skipped too many ticks at once", "stop",
     "reset; `tactus doctor` says what holds the loop up"},
    {kFaultWatchdog, "watchdog", "watchdog output could not be driven", "stop",
     "reset; check its line"},
    {kFaultWorkspace, "workspace", "tool went through a wall of the workspace", "stop",
     "move back inside by hand, reset"},
    {kFaultOverspeed, "overspeed", "tool faster than a hand moves it", "stop", "reset"},
    {kFaultEncoderFrozen, "encoder_frozen", "joint has a velocity and its position stands still",
     "stop", "reset; check the encoder"},
    {kFaultEncoderJump, "encoder_jump", "joint moved further in a tick than it can", "stop",
     "reset; check the encoder"},
    {kFaultTorqueWithoutMotion, "torque_without_motion",
     "effort of a joint changed by much and the joint never moved", "stop",
     "reset; check encoder, motor and what blocks the joint"},
    {kFaultMotionWithoutTorque, "motion_without_torque",
     "tool runs away and the commanded force does not push it", "stop",
     "reset; check the encoder's direction and the drive"},
    {kFaultOverTemperature, "over_temperature", "drive or motor reports that it is too hot", "stop",
     "let it cool, reset"},
    {kFaultNotPassive, "not_passive",
     "surfaces gave the hand energy that damping could not take back", "stop",
     "reset; less stiffness, or more damping in the device"},
    {kFaultHelperCrashed, "helper_crashed", "a thread beside the loop crashed", "stop",
     "the program ends; start it again"},
    {kFaultMotorReversed, "motor_reversed",
     "a joint answers a push, or its rising effort, the wrong way: `fault_joint` says which",
     "stop",
     "check that joint's motor wires and encoder direction, their `direction` keys, ratio and "
     "torque "
     "constant; `tactus commission`; reset"},
    {kFaultEffortMismatch, "effort_mismatch",
     "a drive measures another torque than commanded, or a joint answers a push more strongly than "
     "the device's mass allows: `fault_joint` says the joint",
     "stop",
     "check that joint's torque constant, ratio, encoder counts, current limit and motor wires, "
     "and "
     "`moving_mass_kg`; `tactus commission`; reset"},
    {kFaultOtherDevice, "other_device",
     "another device of this controller has a fault: `fault_device` says which", "stop",
     "see that device's fault; reset both"},
    {kFaultLineLost, "line_lost",
     "the host that supervises this board has been silent on its serial line for half a second",
     "stop", "check cable and host, connect again, reset"},
    {kLimitLateTick, "late_tick", "tick began too late", "none but the count", "by itself"},
    {kLimitWorkspace, "workspace_wall", "tool is in a wall of the workspace", "wall pushes back",
     "by itself"},
    {kLimitSpeed, "limiting_speed", "tool nearly too fast", "force along the motion taken away",
     "by itself"},
    {kLimitPassivity, "limiting_passivity", "surfaces gave the hand energy",
     "damping takes it back; see the ledger", "by itself"},
    {kLimitGuardsOff, "guards_off", "a test has switched guards off", "those guards are silent",
     "configure without"},
    {kLimitChange, "limiting_change", "a changed parameter is still coming in",
     "force follows it gradually", "by itself"},
    {kLimitSignCheck, "sign_check", "a motor has not answered yet which way it turns",
     "force stays within 2 N; small pushes", "by itself; hold the handle loosely if it stays"},
});

// Returns the stable code of a single bit, 0 to 63.
constexpr int fault_code(FaultBits bit) {
  return std::countr_zero(static_cast<std::uint64_t>(bit));
}

// Returns the name of a single bit, or "unknown" for a bit without a meaning.
constexpr std::string_view fault_name(FaultBits bit) {
  for (const FaultText& text : kFaultTexts) {
    if (text.bit == bit) {
      return text.name;
    }
  }
  return "unknown";
}

}  // namespace tactus::firmware
