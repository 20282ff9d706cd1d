// Encodes and decodes the frames of ODrive CANSimple, for firmware 0.5.x and 0.6.x, without state.
//
// A frame's identifier is node << 5 | command; everything is little endian. The drive counts in
// turns; here angles are in rad. Torque is in N m at the motor shaft.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/can_frame.h"

namespace tactus::drivers::odrive {

// The largest node number. 0x3F stands for a drive that has no number.
inline constexpr std::uint8_t kMaxNode = 0x3E;

enum class Generation : std::uint8_t { unknown, v0_5, v0_6 };

enum class Command : std::uint8_t {
  get_version = 0x00,  // 0.6; 0.5 does not answer
  heartbeat = 0x01,
  get_error = 0x03,          // 0.6
  get_motor_error = 0x03,    // 0.5
  get_encoder_error = 0x04,  // 0.5
  set_axis_state = 0x07,
  get_estimates = 0x09,
  set_controller_mode = 0x0B,
  set_input_torque = 0x0E,
  set_limits = 0x0F,
  get_iq = 0x14,
  get_temperature = 0x15,  // 0.6
  get_bus = 0x17,
  clear_errors = 0x18,
  get_torques = 0x1C,           // 0.6
  get_controller_error = 0x1D,  // 0.5
};

enum class AxisState : std::uint8_t { idle = 1, closed_loop = 8 };

// The drive's versions of hardware and firmware (major.minor.revision).
struct Version {
  std::uint8_t protocol = 0;  // 2
  std::uint8_t product_line = 0;
  std::uint8_t hardware_version = 0;
  std::uint8_t hardware_variant = 0;
  std::uint8_t major = 0;
  std::uint8_t minor = 0;
  std::uint8_t revision = 0;
  bool unreleased = false;
};

// The content of a heartbeat.
struct Heartbeat {
  std::uint32_t error = 0;            // 0.5: the axis's errors; 0.6: all active errors
  std::uint8_t state = 0;             // AxisState and others
  std::uint8_t procedure_result = 0;  // 0.6 only: result of the last request for a state
};

// The drive's estimates of its shaft.
struct Estimates {
  double position_rad = 0.0;
  double velocity_rad_per_s = 0.0;
};

// Firmware 0.6: error bits that are active now, and those that took the axis out of closed loop.
struct Errors {
  std::uint32_t active = 0;
  std::uint32_t disarm_reason = 0;
};

// The temperatures of the inverter and of the motor.
struct Temperature {
  double inverter_C = 0.0;
  double motor_C = 0.0;
};

// Voltage and current of the drive's supply (its DC bus).
struct BusPower {
  double bus_V = 0.0;
  double bus_A = 0.0;  // always zero in 0.5.5 and older
};

// The motor current that makes torque (Iq).
struct Current {
  double setpoint_A = 0.0;
  double measured_A = 0.0;
};

// Firmware 0.6: the commanded torque and the drive's estimate of it, at the motor shaft.
struct Torques {
  double target_Nm = 0.0;
  double estimate_Nm = 0.0;
};

constexpr std::uint32_t frame_id(std::uint8_t node, Command command) {
  return (std::uint32_t{node} << 5U) | static_cast<std::uint32_t>(command);
}
constexpr std::uint32_t node_of(std::uint32_t id) {
  return id >> 5U;
}
constexpr Command command_of(std::uint32_t id) {
  return static_cast<Command>(id & 0x1FU);
}

// Returns a request for the frame of that command: a remote frame, or a data frame without bytes
// for adapters that cannot send remote frames (0.5.5 and later understand it).
hal::CanFrame request(std::uint8_t node, Command command, bool by_remote_frame);
hal::CanFrame set_axis_state(std::uint8_t node, AxisState state);
// Returns a frame that sets torque control with a setpoint that acts at once. Do not send it in
// closed loop.
hal::CanFrame set_torque_mode(std::uint8_t node);
// Returns a torque in 4 bytes, which saves bus time.
hal::CanFrame set_input_torque(std::uint8_t node, float torque_Nm);
hal::CanFrame set_limits(std::uint8_t node, double speed_rad_per_s, double current_A);
hal::CanFrame clear_errors(std::uint8_t node);

// These decode a frame. They return nothing if its length is wrong. The caller checks that numbers
// are finite.
std::optional<Version> read_version(const hal::CanFrame& frame);
std::optional<Heartbeat> read_heartbeat(const hal::CanFrame& frame);
std::optional<Estimates> read_estimates(const hal::CanFrame& frame);
std::optional<Errors> read_errors(const hal::CanFrame& frame);
std::optional<std::uint64_t> read_motor_error(const hal::CanFrame& frame);
// Decodes the error of the encoder or of the controller.
std::optional<std::uint32_t> read_part_error(const hal::CanFrame& frame);
std::optional<Temperature> read_temperature(const hal::CanFrame& frame);
std::optional<BusPower> read_bus_power(const hal::CanFrame& frame);
std::optional<Current> read_current(const hal::CanFrame& frame);
std::optional<Torques> read_torques(const hal::CanFrame& frame);

}  // namespace tactus::drivers::odrive
