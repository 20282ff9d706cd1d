// The interface between the controller and a haptic device, which may be wired to a board or
// simulated. The controller uses it once a tick.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace tactus::drivers {

inline constexpr std::size_t kMaxJoints = 6;

// The state and the faults of a device, one bit each; 0 means that all is well. A driver latches
// each fault that the device reports until `clear_faults`.
enum DeviceStatus : std::uint32_t {
  kDeviceOk = 0,
  kDeviceNotReady = 1U << 0,  // not homed, or the drive is still starting
  kDeviceStale = 1U << 1,     // no fresh sample before the deadline; the last one is repeated
  kDeviceEncoderFault = 1U << 2,
  kDeviceDriveFault = 1U << 3,
  kDeviceEmergencyStop = 1U << 4,
  kDeviceLost = 1U << 5,    // unplugged or bus off: the motors cannot be reached
  kDeviceHoming = 1U << 6,  // moves, or is moved, to its reference
  kDeviceTooHot = 1U << 7,  // a drive or a motor reports over-temperature
  // The encoder may count from another zero than before, because its drive or board lost power,
  // restarted, or stopped answering. The joint has lost its reference, and only homing restores it.
  kDeviceReferenceLost = 1U << 8,
};

// A reading of all joints. A revolute joint is in rad, rad/s and N m; a prismatic one in m, m/s and
// N.
struct JointSample {
  std::array<double, kMaxJoints> position{};
  std::array<double, kMaxJoints> velocity{};
  // The effort that the motors' drives measure, converted by the transmission to N m or N at the
  // joint. It is valid only for joints whose bit is set in effort_known, since not every device
  // reports torque or current.
  std::array<double, kMaxJoints> effort{};
  std::uint32_t effort_known = 0;  // one bit per joint; joint 0 is the lowest
  // A bit for each joint whose drive has measured its effort since the last sample. Other efforts
  // are repeated: a drive may measure more seldom than the controller ticks.
  std::uint32_t effort_is_new = 0;
  std::uint32_t age_us = 0;  // time since the encoders were read
  std::uint32_t status = kDeviceOk;
};

// The command to all joints in a tick.
struct JointCommand {
  std::array<double, kMaxJoints> effort{};  // N m or N
  bool enable = false;  // motor power; false makes every effort zero at the device
  bool home = false;    // finds the reference: the device may move by itself, gently
  // The controller is in fault. The power stage goes off, even in a device that keeps it on at zero
  // torque while `enable` is false (it does so to be enabled without a bring-up).
  bool power_off = false;
};

// A device has these calls. `read` and `write` never throw, allocate, or wait beyond the device's
// own deadline. No two calls may run at the same time.
//   joint_count  returns the number of joints, at most kMaxJoints
//   read         fills in the newest sample. Faults come as DeviceStatus bits in it
//   write        sends a command and returns faults as DeviceStatus bits
//   clear_faults forgets latched faults
template <class D>
concept Device = requires(D device, JointSample& sample, const JointCommand& command) {
  { device.joint_count() } -> std::convertible_to<std::size_t>;
  { device.read(sample) } -> std::same_as<void>;
  { device.write(command) } -> std::same_as<std::uint32_t>;
  { device.clear_faults() } -> std::same_as<void>;
};

}  // namespace tactus::drivers
