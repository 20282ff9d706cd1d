// Encodes and decodes the subframes of the moteus register protocol, without state.
//
// A CAN FD payload is a row of subframes. Each has a header, a first register and values of one
// type. Everything is little endian. Headers, counts and registers are varuints: 7 bits a byte, the
// lowest first. The servo counts in revolutions of its output shaft; here angles are in rad.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/can_frame.h"

namespace tactus::drivers::moteus {

inline constexpr std::uint8_t kMaxServo = 126;  // 127 addresses all servos
inline constexpr std::uint8_t kMaxHost = 127;
inline constexpr std::uint16_t kMaxPrefix = 0x1FFF;

enum class Register : std::uint16_t {
  mode = 0x000,
  position = 0x001,
  velocity = 0x002,
  torque = 0x003,
  home_state = 0x00C,
  voltage = 0x00D,
  temperature = 0x00E,
  fault = 0x00F,
  command_position = 0x020,
  command_velocity = 0x021,
  feedforward_torque = 0x022,
  kp_scale = 0x023,
  kd_scale = 0x024,
  watchdog = 0x027,
  integral_scale = 0x02B,
};

enum class Mode : std::uint8_t {
  stopped = 0,
  fault = 1,
  enabling = 2,
  calibrating = 3,
  calibrated = 4,
  position = 10,
  timeout = 11,
};

enum class ValueType : std::uint8_t { int8 = 0, int16 = 1, int32 = 2, float32 = 3 };

// The unit in which the integers of a register count.
enum class Quantity : std::uint8_t {
  plain,  // a number of its own, such as a mode
  position_rev,
  velocity_rev_per_s,
  torque_Nm,
  current_A,
  voltage_V,
  temperature_C,
  time_s,
  scale,  // of a gain or of PWM
};

// The home state of a position that is referenced to the output shaft.
inline constexpr std::uint8_t kHomeOutput = 2;

// The answer of a servo to a query. Values that it did not send are empty.
struct Reply {
  std::optional<std::uint8_t> mode;
  std::optional<double> position_rad;
  std::optional<double> velocity_rad_per_s;
  std::optional<double> torque_Nm;
  std::optional<double> voltage_V;
  std::optional<double> temperature_C;
  std::optional<std::uint8_t> fault;
  std::optional<std::uint8_t> home_state;
  // The last register that the servo refused to write or read.
  std::optional<std::uint32_t> refused_register;
};

// The addresses of servo and host. Both use the same prefix.
struct Address {
  std::uint8_t servo = 1;
  std::uint8_t host = 0;
  std::uint16_t prefix = 0;
  bool bit_rate_switch = true;
};

std::uint32_t command_id(const Address& address, bool wants_reply);
std::uint32_t reply_id(const Address& address);

// Returns a frame that takes the power off and clears faults.
hal::CanFrame stop(const Address& address, bool wants_reply);
// Returns a frame for a feed-forward torque with all gains at zero. The servo times out if no other
// one follows within `watchdog_s`.
hal::CanFrame torque(const Address& address, float torque_Nm, float watchdog_s, bool wants_reply);
// Returns a frame with a query only.
hal::CanFrame query(const Address& address);

// Decodes a payload. Invalid bytes end the decoding; the values before them count. A number is NaN
// if the float is NaN, or if the integer is the one that stands for NaN.
Reply read_reply(std::span<const std::byte> payload);

// Returns an integer's value in the quantity's unit. The most negative integer gives NaN, except
// for plain ones.
double scaled(std::int32_t raw, ValueType type, Quantity quantity);

}  // namespace tactus::drivers::moteus
