// What can go wrong in a tick, numbered for good: a code is never given a new meaning.
//
// Faults (codes 0 to 15) stop: zero effort and motor power off in the same tick, latched until a
// reset with healthy inputs. Limits (codes 16 to 31) do not stop: they say that this tick's output
// was held back.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

namespace tactus::firmware {

enum FaultBits : std::uint32_t {
  kNoFault = 0,
  kFaultNotConfigured = 1U << 0,
  kFaultJointNotFinite = 1U << 1,
  kFaultJointLimit = 1U << 2,
  kFaultStaleSamples = 1U << 3,
  kFaultReferenceLost = 1U << 4,
  kFaultEncoder = 1U << 5,
  kFaultDrive = 1U << 6,
  kFaultDeviceLost = 1U << 7,
  kFaultEmergencyStop = 1U << 8,
  kFaultOperatorStop = 1U << 9,
  kFaultKinematicsNotConverged = 1U << 10,
  kFaultKinematicsSingular = 1U << 11,
  kFaultToolNotFinite = 1U << 12,
  kFaultForceNotFinite = 1U << 13,
  kFaultCommandNotFinite = 1U << 14,

  kLimitSoftStart = 1U << 16,
  kLimitForce = 1U << 17,
  kLimitSlew = 1U << 18,
  kLimitEffort = 1U << 19,
  kLimitStaleSample = 1U << 20,
  kLimitTouch = 1U << 21,
  kLimitCompensation = 1U << 22,
  kLimitGravity = 1U << 23,
};

inline constexpr std::uint32_t kFaultMask = 0x0000'FFFFU;
inline constexpr std::uint32_t kLimitMask = 0xFFFF'0000U;

struct FaultText {
  FaultBits bit;
  std::string_view name;     // for programs
  std::string_view meaning;  // for people
};

// In order of code.
inline constexpr auto kFaultTexts = std::to_array<FaultText>({
    {kFaultNotConfigured, "not_configured", "tick before a successful configure"},
    {kFaultJointNotFinite, "joint_not_finite", "joint position or velocity NaN or infinite"},
    {kFaultJointLimit, "joint_limit", "joint position outside its configured range"},
    {kFaultStaleSamples, "stale_samples", "too many samples in a row too old"},
    {kFaultReferenceLost, "reference_lost", "device not ready or homing while active"},
    {kFaultEncoder, "encoder", "device reports an encoder fault"},
    {kFaultDrive, "drive", "device reports a motor drive fault"},
    {kFaultDeviceLost, "device_lost", "no way to reach the motors"},
    {kFaultEmergencyStop, "emergency_stop", "emergency stop line is open"},
    {kFaultOperatorStop, "operator_stop", "stop requested by the operator or a program"},
    {kFaultKinematicsNotConverged, "kinematics_not_converged", "no tool position fits the joints"},
    {kFaultKinematicsSingular, "kinematics_singular", "pose too near a singularity"},
    {kFaultToolNotFinite, "tool_not_finite", "tool position or velocity NaN or infinite"},
    {kFaultForceNotFinite, "force_not_finite", "touch gave a NaN or infinite result"},
    {kFaultCommandNotFinite, "command_not_finite", "joint effort NaN or infinite"},
    {kLimitSoftStart, "soft_start", "force still rising after activation or first contact"},
    {kLimitForce, "limiting_force", "force held at its largest magnitude"},
    {kLimitSlew, "limiting_slew", "change of force held at its largest rate"},
    {kLimitEffort, "limiting_effort", "force scaled down to a joint's largest effort"},
    {kLimitStaleSample, "stale_sample", "sample too old, used once more"},
    {kLimitTouch, "limiting_touch", "touch gave up something: see the touch flags"},
    {kLimitCompensation, "limiting_compensation",
     "friction compensation held back by a force or effort limit"},
    {kLimitGravity, "limiting_gravity", "gravity compensation cut at a joint's largest effort"},
});

// The stable code of a single bit, 0 to 31.
constexpr int fault_code(FaultBits bit) {
  return std::countr_zero(static_cast<std::uint32_t>(bit));
}

// The name of a single bit; "unknown" for a bit without a meaning.
constexpr std::string_view fault_name(FaultBits bit) {
  for (const FaultText& text : kFaultTexts) {
    if (text.bit == bit) {
      return text.name;
    }
  }
  return "unknown";
}

}  // namespace tactus::firmware
