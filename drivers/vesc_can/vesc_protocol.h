// The CAN messages of a VESC that a torque amplifier needs: bytes to meanings and back. No input or
// output, no state. 29-bit identifiers, packet << 8 | VESC; numbers are big-endian.
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

// The motor current, in mA, and how long the VESC keeps regulating it once it is below the VESC's
// smallest current (50 mA as delivered), in ms. Without that delay it lets go of the motor there: a
// dead zone around zero.
hal::CanFrame held_current_frame(std::uint8_t vesc, std::int32_t current_mA,
                                 std::int16_t off_delay_ms);
// No current, and the motor let go.
hal::CanFrame release_frame(std::uint8_t vesc);

struct Status {
  std::int32_t erpm = 0;  // turns a minute of the electrical field: pole pairs times the shaft's
  double current_A = 0.0;
  double duty = 0.0;
};
struct Status4 {
  double fet_C = 0.0;
  double motor_C = 0.0;
  double input_A = 0.0;
  double position_deg = 0.0;
};
struct Status5 {
  std::int32_t tachometer = 0;  // six counts an electrical turn
  double input_V = 0.0;
};

// Nothing if it is another message, another VESC's, or malformed.
std::optional<Status> status_of(const hal::CanFrame& frame, std::uint8_t vesc);
std::optional<Status4> status_4_of(const hal::CanFrame& frame, std::uint8_t vesc);
std::optional<Status5> status_5_of(const hal::CanFrame& frame, std::uint8_t vesc);

// One field of the VESC's values, asked for alone so that the answer fits into one frame.
enum class Query : std::uint32_t {
  fault = 1U << 15U,
  flags = 1U << 21U,
};
inline constexpr std::uint8_t kTimedOut = 0x01;    // of the flags: no command came in time
inline constexpr std::uint8_t kKillSwitch = 0x02;  // of the flags

hal::CanFrame query_frame(std::uint8_t vesc, std::uint8_t host, Query query);

struct Answer {
  Query query = Query::fault;
  std::uint8_t value = 0;
};
std::optional<Answer> answer_of(const hal::CanFrame& frame, std::uint8_t vesc, std::uint8_t host);

}  // namespace tactus::drivers::vesc
