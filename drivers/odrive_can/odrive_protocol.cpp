#include "drivers/odrive_can/odrive_protocol.h"

#include <array>
#include <cstddef>
#include <numbers>

#include "drivers/common/little_endian.h"

namespace tactus::drivers::odrive {

namespace {

constexpr double kRadPerTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kReplyBytes = 8;

hal::CanFrame odrive_frame(std::uint8_t node, Command command, std::uint8_t length) {
  return {.id = frame_id(node, command), .length = length};
}

bool is_reply(const hal::CanFrame& frame) {
  return !frame.remote && !frame.fd && frame.length == kReplyBytes;
}

double float_at(const hal::CanFrame& frame, std::size_t at) {
  return static_cast<double>(load_little_endian<float>(frame.bytes(), at));
}

std::uint8_t byte_at(const hal::CanFrame& frame, std::size_t at) {
  return std::to_integer<std::uint8_t>(frame.data[at]);
}

// Decodes a reply of two floats.
template <class Pair>
std::optional<Pair> read_pair(const hal::CanFrame& frame) {
  if (!is_reply(frame)) {
    return std::nullopt;
  }
  return Pair{float_at(frame, 0), float_at(frame, 4)};
}

}  // namespace

hal::CanFrame request(std::uint8_t node, Command command, bool by_remote_frame) {
  hal::CanFrame frame = odrive_frame(node, command, 0);
  frame.remote = by_remote_frame;
  return frame;
}

hal::CanFrame set_axis_state(std::uint8_t node, AxisState state) {
  hal::CanFrame frame = odrive_frame(node, Command::set_axis_state, 4);
  store_little_endian(static_cast<std::uint32_t>(state), frame.data, 0);
  return frame;
}

hal::CanFrame set_torque_mode(std::uint8_t node) {
  constexpr std::uint32_t kTorqueControl = 1;
  constexpr std::uint32_t kPassthrough = 1;
  hal::CanFrame frame = odrive_frame(node, Command::set_controller_mode, 8);
  store_little_endian(kTorqueControl, frame.data, 0);
  store_little_endian(kPassthrough, frame.data, 4);
  return frame;
}

hal::CanFrame set_input_torque(std::uint8_t node, float torque_Nm) {
  hal::CanFrame frame = odrive_frame(node, Command::set_input_torque, 4);
  store_little_endian(torque_Nm, frame.data, 0);
  return frame;
}

hal::CanFrame set_limits(std::uint8_t node, double speed_rad_per_s, double current_A) {
  hal::CanFrame frame = odrive_frame(node, Command::set_limits, 8);
  store_little_endian(static_cast<float>(speed_rad_per_s / kRadPerTurn), frame.data, 0);
  store_little_endian(static_cast<float>(current_A), frame.data, 4);
  return frame;
}

hal::CanFrame clear_errors(std::uint8_t node) {
  return odrive_frame(node, Command::clear_errors, 1);
}

std::optional<Version> read_version(const hal::CanFrame& frame) {
  if (!is_reply(frame)) {
    return std::nullopt;
  }
  return Version{.protocol = byte_at(frame, 0),
                 .product_line = byte_at(frame, 1),
                 .hardware_version = byte_at(frame, 2),
                 .hardware_variant = byte_at(frame, 3),
                 .major = byte_at(frame, 4),
                 .minor = byte_at(frame, 5),
                 .revision = byte_at(frame, 6),
                 .unreleased = byte_at(frame, 7) != 0};
}

// Firmware before 0.5.3 sends the state in four bytes, later versions in one byte with flags behind
// it.
std::optional<Heartbeat> read_heartbeat(const hal::CanFrame& frame) {
  if (!is_reply(frame)) {
    return std::nullopt;
  }
  return Heartbeat{.error = load_little_endian<std::uint32_t>(frame.bytes(), 0),
                   .state = byte_at(frame, 4),
                   .procedure_result = byte_at(frame, 5)};
}

std::optional<Estimates> read_estimates(const hal::CanFrame& frame) {
  if (!is_reply(frame)) {
    return std::nullopt;
  }
  return Estimates{kRadPerTurn * float_at(frame, 0), kRadPerTurn * float_at(frame, 4)};
}

std::optional<Errors> read_errors(const hal::CanFrame& frame) {
  if (!is_reply(frame)) {
    return std::nullopt;
  }
  return Errors{load_little_endian<std::uint32_t>(frame.bytes(), 0),
                load_little_endian<std::uint32_t>(frame.bytes(), 4)};
}

std::optional<std::uint64_t> read_motor_error(const hal::CanFrame& frame) {
  if (!is_reply(frame)) {
    return std::nullopt;
  }
  return load_little_endian<std::uint64_t>(frame.bytes(), 0);
}

std::optional<std::uint32_t> read_part_error(const hal::CanFrame& frame) {
  if (!is_reply(frame)) {
    return std::nullopt;
  }
  return load_little_endian<std::uint32_t>(frame.bytes(), 0);
}

std::optional<Temperature> read_temperature(const hal::CanFrame& frame) {
  return read_pair<Temperature>(frame);
}

std::optional<BusPower> read_bus_power(const hal::CanFrame& frame) {
  return read_pair<BusPower>(frame);
}

std::optional<Current> read_current(const hal::CanFrame& frame) {
  return read_pair<Current>(frame);
}

std::optional<Torques> read_torques(const hal::CanFrame& frame) {
  return read_pair<Torques>(frame);
}

}  // namespace tactus::drivers::odrive
