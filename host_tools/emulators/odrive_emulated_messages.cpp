// The messages that an emulated ODrive axis sends, encoded by hand from the facts about CANSimple.
#include <algorithm>
#include <bit>
#include <limits>

#include "host_tools/emulators/odrive_emulator.h"

namespace tactus::host {

namespace {

constexpr hal::TimeNs kODriveNsPerMs = 1'000'000;

template <std::size_t kSize>
void put_odrive_u32(std::array<std::uint8_t, kSize>& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (8U * i));
  }
}

// Returns a payload of two 32-bit floats.
std::array<std::uint8_t, 8> odrive_floats(double first, double second) {
  std::array<std::uint8_t, 8> bytes{};
  put_odrive_u32(bytes, 0, std::bit_cast<std::uint32_t>(static_cast<float>(first)));
  put_odrive_u32(bytes, 4, std::bit_cast<std::uint32_t>(static_cast<float>(second)));
  return bytes;
}

// Returns a payload of two 32-bit integers.
std::array<std::uint8_t, 8> odrive_words(std::uint32_t first, std::uint32_t second) {
  std::array<std::uint8_t, 8> bytes{};
  put_odrive_u32(bytes, 0, first);
  put_odrive_u32(bytes, 4, second);
  return bytes;
}

// Returns when the next message is due. Messages that fell due while the drive was not run, for
// example without power, are not sent later.
hal::TimeNs next_due_ns(hal::TimeNs due_ns, std::uint32_t period_ms, hal::TimeNs now_ns) {
  const hal::TimeNs period_ns = period_ms * kODriveNsPerMs;
  return due_ns + ((now_ns - due_ns) / period_ns + 1) * period_ns;
}

}  // namespace

// Answers a request; a firmware that does not know the message stays silent.
void ODriveEmulator::answer(hal::TimeNs now_ns, unsigned command) {
  const bool is_0_5_6 = config_.firmware == ODriveFirmware::v0_5_6;
  switch (command) {
    case 0x00:
      if (is_0_6()) {  // an ODrive S1 (product line 5) with firmware 0.6.9
        send_payload(now_ns, command, {2, 5, 2, 0, 0, 6, 9, 0});
      }
      return;
    case 0x01:
      send_heartbeat(now_ns);
      return;
    // Firmware 0.6 sends its errors and what disarmed it, firmware 0.5 the motor's error.
    case 0x03:
      if (is_0_6()) {
        send_payload(now_ns, command, odrive_words(errors_.axis, errors_.disarm_reason));
      } else {
        send_payload(now_ns, command,
                     odrive_words(static_cast<std::uint32_t>(errors_.motor),
                                  static_cast<std::uint32_t>(errors_.motor >> 32U)));
      }
      return;
    case 0x04:
      if (!is_0_6()) {
        send_payload(now_ns, command, odrive_words(errors_.encoder, 0));
      }
      return;
    case 0x09:
      send_estimates(now_ns);
      return;
    // The currents that are wanted and that flow, A.
    case 0x14:
      send_payload(now_ns, command,
                   odrive_floats(host_.torque_Nm / config_.torque_constant_Nm_per_A,
                                 shaft().torque_Nm / config_.torque_constant_Nm_per_A));
      return;
    // Firmware 0.6 sends the temperatures of transistors and motor, degrees C. Firmware 0.5 has the
    // sensorless estimates here.
    case 0x15:
      send_payload(now_ns, command,
                   is_0_6() ? odrive_floats(41.5, 36.25) : odrive_floats(0.0, 0.0));
      return;
    // Voltage and current of the supply, V and A.
    case 0x17:
      send_payload(now_ns, command, odrive_floats(24.0, is_0_6() || is_0_5_6 ? 0.75 : 0.0));
      return;
    // The torques that are wanted and that act, N m.
    case 0x1C:
      if (is_0_6()) {
        send_payload(now_ns, command, odrive_floats(host_.torque_Nm, shaft().torque_Nm));
      }
      return;
    // The powers of firmware 0.6; firmware 0.5.6 has the controller's error here.
    case 0x1D:
      if (is_0_6()) {
        send_payload(now_ns, command, odrive_floats(0.0, 0.0));
      } else if (is_0_5_6) {
        send_payload(now_ns, command, odrive_words(errors_.controller, 0));
      }
      return;
    default:
      return;
  }
}

void ODriveEmulator::send_due_messages(hal::TimeNs now_ns) {
  if (config_.heartbeat_ms > 0 && now_ns >= next_.heartbeat_ns) {
    next_.heartbeat_ns = next_due_ns(next_.heartbeat_ns, config_.heartbeat_ms, now_ns);
    send_heartbeat(now_ns);
  }
  if (config_.encoder_ms > 0 && now_ns >= next_.estimates_ns) {
    next_.estimates_ns = next_due_ns(next_.estimates_ns, config_.encoder_ms, now_ns);
    send_estimates(now_ns);
  }
}

void ODriveEmulator::send_heartbeat(hal::TimeNs now_ns) {
  Payload payload = odrive_words(errors_.axis, state_);
  if (config_.firmware == ODriveFirmware::v0_5_6) {
    payload[5] = errors_.motor != 0 ? 1 : 0;
    payload[6] = errors_.encoder != 0 ? 1 : 0;
    payload[7] = errors_.controller != 0 ? 1 : 0;
  } else if (is_0_6()) {
    payload[5] = errors_.procedure_result;
  }
  if (config_.firmware == ODriveFirmware::v0_5_4 || config_.firmware == ODriveFirmware::v0_5_6) {
    payload[7] |= 0x80;  // trajectory done
  }
  send_payload(now_ns, 0x01, payload);
}

void ODriveEmulator::send_estimates(hal::TimeNs now_ns) {
  send_payload(now_ns, 0x09,
               odrive_floats(position_turns(), kTurnsPerRad * shaft().velocity_rad_per_s));
}

void ODriveEmulator::send_payload(hal::TimeNs now_ns, unsigned command, const Payload& payload,
                                  std::uint8_t length) {
  hal::CanFrame frame{.id = (std::uint32_t{config_.node_id} << 5U) | command, .length = length};
  std::ranges::transform(payload, frame.data.begin(),
                         [](std::uint8_t byte) { return std::byte{byte}; });
  send(now_ns, frame);
}

void ODriveEmulator::send_wrong_length(hal::TimeNs now_ns) {
  send_payload(now_ns, 0x09, {0, 0, 0, 0}, 4);
}

void ODriveEmulator::send_not_a_number(hal::TimeNs now_ns) {
  send_payload(now_ns, 0x09, odrive_floats(std::numeric_limits<double>::quiet_NaN(), 0.0));
}

}  // namespace tactus::host
