// The per-tick device seam: what the controller asks of a haptic device, whether wired to a board
// or simulated.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace tactus::drivers {

inline constexpr std::size_t kMaxJoints = 6;

// Device trouble, one bit each; 0 is well. A driver latches what the device reports until
// `clear_faults`.
enum DeviceStatus : std::uint32_t {
  kDeviceOk = 0,
  kDeviceNotReady = 1U << 0,  // not homed, or the drive is still starting
  kDeviceStale = 1U << 1,     // no fresh sample before the deadline: the last one is repeated
  kDeviceEncoderFault = 1U << 2,
  kDeviceDriveFault = 1U << 3,
  kDeviceEmergencyStop = 1U << 4,
  kDeviceLost = 1U << 5,    // unplugged, bus off: no way to reach the motors
  kDeviceHoming = 1U << 6,  // moving or being moved to its reference
  kDeviceTooHot = 1U << 7,  // a drive or a motor reports over-temperature
  // The encoder may count from another zero than before: its drive or board lost power, restarted,
  // or stopped answering. The joint's reference is lost with it, and only homing brings it back.
  kDeviceReferenceLost = 1U << 8,
};

// A revolute joint is in rad, rad/s, N m; a prismatic one in m, m/s, N.
struct JointSample {
  std::array<double, kMaxJoints> position{};
  std::array<double, kMaxJoints> velocity{};
  // As the motors' drives measure it, through the transmission, N m or N. Meaningful where the
  // joint's bit is set in effort_known: not every device reports torque or current.
  std::array<double, kMaxJoints> effort{};
  std::uint32_t effort_known = 0;  // a bit per joint, joint 0 the lowest
  std::uint32_t age_us = 0;        // from the encoder's reading to now
  std::uint32_t status = kDeviceOk;
};

struct JointCommand {
  std::array<double, kMaxJoints> effort{};  // N m or N
  bool enable = false;  // motor power; false makes every effort zero at the device
  bool home = false;    // find the reference: the device may move by itself, gently
};

// `read` fills the newest sample within the device's own deadline; `write` sends a command. Neither
// throws, allocates or waits beyond that deadline; trouble comes back as DeviceStatus bits, in the
// sample and from write.
template <class D>
concept Device = requires(D device, JointSample& sample, const JointCommand& command) {
  { device.joint_count() } -> std::convertible_to<std::size_t>;
  { device.read(sample) } -> std::same_as<void>;
  { device.write(command) } -> std::same_as<std::uint32_t>;
  { device.clear_faults() } -> std::same_as<void>;
};

}  // namespace tactus::drivers
