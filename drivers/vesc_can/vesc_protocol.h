// Encodes and decodes the CAN messages of a VESC that a torque amplifier needs, without input,
// output or state. Identifiers have 29 bits, packet << 8 | VESC; numbers are big-endian.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/can_frame.h"

namespace tactus::drivers::vesc {

inline constexpr std::uint8_t kEveryVesc = 255;

enum class Packet : std::uint8_t {
  set_current = 1,
  process_short_buffer = 8,  // a command of the serial protocol, at most 6 bytes
  status = 9,
  status_4 = 16,
  status_5 = 27,
};

std::uint32_t id_of(Packet packet, std::uint8_t vesc);

// Returns a command of the motor current, in mA. `off_delay_ms` is the time for which the VESC
// keeps regulating once the current is below the VESC's smallest one (50 mA as delivered). Without
// it the VESC releases the motor there, which makes a dead zone around zero.
hal::CanFrame held_current_frame(std::uint8_t vesc, std::int32_t current_mA,
                                 std::int16_t off_delay_ms);
// Returns a command of zero current that releases the motor.
hal::CanFrame release_frame(std::uint8_t vesc);

// Status message 1. The current is that of the motor; the duty is from -1 to 1.
struct Status {
  std::int32_t erpm = 0;  // electrical turns a minute: pole pairs times the shaft's turns
  double current_A = 0.0;
  double duty = 0.0;
};
// Status message 4: temperatures of the transistors and of the motor, the supply current, and the
// position of the shaft.
struct Status4 {
  double fet_C = 0.0;
  double motor_C = 0.0;
  double input_A = 0.0;
  double position_deg = 0.0;
};
// Status message 5: the count of the motor's turns and the supply voltage.
struct Status5 {
  std::int32_t tachometer = 0;  // six counts an electrical turn
  double input_V = 0.0;
};

// These decode a message. They return nothing if it is another message, another VESC's, or
// malformed.
std::optional<Status> status_of(const hal::CanFrame& frame, std::uint8_t vesc);
std::optional<Status4> status_4_of(const hal::CanFrame& frame, std::uint8_t vesc);
std::optional<Status5> status_5_of(const hal::CanFrame& frame, std::uint8_t vesc);

// A field of the VESC's values. Each is asked for alone, so that the answer fits into one frame.
enum class Query : std::uint32_t {
  fault = 1U << 15U,
  flags = 1U << 21U,
};
inline constexpr std::uint8_t kTimedOut = 0x01;    // in the flags: no command came in time
inline constexpr std::uint8_t kKillSwitch = 0x02;  // in the flags

hal::CanFrame query_frame(std::uint8_t vesc, std::uint8_t host, Query query);

// The answer to a query.
struct Answer {
  Query query = Query::fault;
  std::uint8_t value = 0;
};
std::optional<Answer> answer_of(const hal::CanFrame& frame, std::uint8_t vesc, std::uint8_t host);

}  // namespace tactus::drivers::vesc
