#include "drivers/vesc_can/vesc_protocol.h"

#include <cstddef>

namespace tactus::drivers::vesc {

namespace {

constexpr std::uint8_t kGetSelectedValues = 0x32;
constexpr std::uint8_t kSendAnswer = 0x00;  // tells the VESC to send the answer
constexpr double kPerTenth = 0.1;
constexpr double kDutyUnit = 1e-3;
constexpr double kPositionUnit_deg = 1.0 / 50.0;

std::uint32_t load_big(const hal::CanFrame& frame, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + size; ++i) {
    value = value << 8U | std::to_integer<std::uint32_t>(frame.data[i]);
  }
  return value;
}

std::int32_t load_i32(const hal::CanFrame& frame, std::size_t at) {
  return static_cast<std::int32_t>(load_big(frame, at, 4));
}

std::int16_t load_i16(const hal::CanFrame& frame, std::size_t at) {
  return static_cast<std::int16_t>(load_big(frame, at, 2));
}

void store_big(hal::CanFrame& frame, std::size_t at, std::size_t size, std::uint32_t value) {
  for (std::size_t i = 0; i < size; ++i) {
    frame.data[at + i] = static_cast<std::byte>(value >> (8 * (size - 1 - i)) & 0xFFU);
  }
}

hal::CanFrame vesc_frame(Packet packet, std::uint8_t vesc, std::uint8_t length) {
  return {.id = id_of(packet, vesc), .extended = true, .length = length};
}

bool is_packet(const hal::CanFrame& frame, Packet packet, std::uint8_t vesc) {
  return frame.extended && !frame.remote && !frame.fd && frame.id == id_of(packet, vesc) &&
         frame.length == hal::kMaxCanBytes;
}

}  // namespace

std::uint32_t id_of(Packet packet, std::uint8_t vesc) {
  return static_cast<std::uint32_t>(packet) << 8U | vesc;
}

hal::CanFrame held_current_frame(std::uint8_t vesc, std::int32_t current_mA,
                                 std::int16_t off_delay_ms) {
  hal::CanFrame frame = vesc_frame(Packet::set_current, vesc, 6);
  store_big(frame, 0, 4, static_cast<std::uint32_t>(current_mA));
  store_big(frame, 4, 2, static_cast<std::uint16_t>(off_delay_ms));
  return frame;
}

hal::CanFrame release_frame(std::uint8_t vesc) {
  return vesc_frame(Packet::set_current, vesc, 4);
}

std::optional<Status> status_of(const hal::CanFrame& frame, std::uint8_t vesc) {
  if (!is_packet(frame, Packet::status, vesc)) {
    return std::nullopt;
  }
  return Status{.erpm = load_i32(frame, 0),
                .current_A = kPerTenth * load_i16(frame, 4),
                .duty = kDutyUnit * load_i16(frame, 6)};
}

std::optional<Status4> status_4_of(const hal::CanFrame& frame, std::uint8_t vesc) {
  if (!is_packet(frame, Packet::status_4, vesc)) {
    return std::nullopt;
  }
  return Status4{.fet_C = kPerTenth * load_i16(frame, 0),
                 .motor_C = kPerTenth * load_i16(frame, 2),
                 .input_A = kPerTenth * load_i16(frame, 4),
                 .position_deg = kPositionUnit_deg * load_i16(frame, 6)};
}

std::optional<Status5> status_5_of(const hal::CanFrame& frame, std::uint8_t vesc) {
  if (!is_packet(frame, Packet::status_5, vesc)) {
    return std::nullopt;
  }
  return Status5{.tachometer = load_i32(frame, 0), .input_V = kPerTenth * load_i16(frame, 4)};
}

hal::CanFrame query_frame(std::uint8_t vesc, std::uint8_t host, Query query) {
  hal::CanFrame frame = vesc_frame(Packet::process_short_buffer, vesc, 7);
  store_big(frame, 0, 1, host);
  store_big(frame, 1, 1, kSendAnswer);
  store_big(frame, 2, 1, kGetSelectedValues);
  store_big(frame, 3, 4, static_cast<std::uint32_t>(query));
  return frame;
}

// All VESCs answer to the host's identifier; the first byte names the VESC.
std::optional<Answer> answer_of(const hal::CanFrame& frame, std::uint8_t vesc, std::uint8_t host) {
  if (!is_packet(frame, Packet::process_short_buffer, host) || load_big(frame, 0, 1) != vesc ||
      load_big(frame, 2, 1) != kGetSelectedValues) {
    return std::nullopt;
  }
  const auto query = static_cast<Query>(load_big(frame, 3, 4));
  if (query != Query::fault && query != Query::flags) {
    return std::nullopt;
  }
  return Answer{query, static_cast<std::uint8_t>(load_big(frame, 7, 1))};
}

}  // namespace tactus::drivers::vesc
