#include "host_tools/emulators/vesc_emulator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus::host {

namespace {

// The fault code of VESC for an absolute overcurrent.
constexpr std::uint8_t kAbsoluteOverCurrent = 4;
// The receiver that addresses every VESC on the bus.
constexpr std::uint32_t kEverybody = 255;
constexpr double kSupply_V = 48.0;
constexpr double kTurn = 2.0 * std::numbers::pi;

// Returns a signed number; VESC sends the most significant byte first.
std::int64_t signed_at(const hal::CanFrame& frame, std::size_t at, std::size_t size) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    bits = bits * 256U + std::to_integer<std::uint64_t>(frame.data[at + i]);
  }
  const std::uint64_t sign = std::uint64_t{1} << (8 * size - 1);
  return static_cast<std::int64_t>(bits) - static_cast<std::int64_t>((bits & sign) * 2U);
}

// Appends the lowest `size` bytes of a number, the most significant first.
void append(hal::CanFrame& frame, std::size_t size, std::int64_t value) {
  for (std::size_t i = size; i > 0; --i) {
    frame.data[frame.length] = static_cast<std::byte>(value >> (8 * (i - 1)) & 0xFF);
    ++frame.length;
  }
}

// Returns an empty frame: the identifier holds the packet's kind and the VESC's number.
hal::CanFrame message(std::uint32_t packet, std::uint32_t to_or_from) {
  return {.id = packet * 256U + to_or_from, .extended = true};
}

}  // namespace

VescEmulator::VescEmulator(hal::CanBus& bus, std::uint32_t seed, const VescEmulatorConfig& config)
    : CanEmulator(bus, seed), config_(config) {}

void VescEmulator::set_temperatures(double fet_C, double motor_C) {
  temperatures_ = {.fet_C = fet_C, .motor_C = motor_C};
}

void VescEmulator::take(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  const std::uint32_t to = frame.id & 0xFFU;
  if (!frame.extended || frame.remote || frame.fd || (to != config_.vesc_id && to != kEverybody)) {
    return;
  }
  // 1 is the current command; the other commands of a motor take the torque away here. 8 is a
  // question, 17 a PING.
  switch (frame.id >> 8U) {
    case 1:
      take_current(now_ns, frame);
      return;
    case 0:
    case 2:
    case 3:
    case 4:
    case 10:
    case 11:
    case 12:
    case 13:
      command_.current_A = 0.0;
      return;
    case 8:
      answer(now_ns, frame);
      return;
    case 17: {
      hal::CanFrame pong = message(18, std::to_integer<std::uint32_t>(frame.data[0]));
      append(pong, 1, config_.vesc_id);
      append(pong, 1, 0);
      send(now_ns, pong);
      return;
    }
    default:
      return;
  }
}

void VescEmulator::take_current(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  if (frame.length < 4) {
    return;
  }
  command_.time_ns = now_ns;
  command_.current_A = std::clamp(static_cast<double>(signed_at(frame, 0, 4)) / 1000.0,
                                  -config_.max_current_A, config_.max_current_A);
  command_.holds_until_ns = frame.length >= 6 ? now_ns + signed_at(frame, 4, 2) * 1'000'000 : 0;
}

// A question has: the host's number, 0, "get selected values" (0x32), and a mask of the values. Bit
// 15 is the fault code, bit 21 the flags.
void VescEmulator::answer(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  if (frame.length != 7 || frame.data[2] != std::byte{0x32}) {
    return;
  }
  const std::int64_t mask = signed_at(frame, 3, 4);
  std::int64_t value = 0;
  if (mask == 0x0000'8000) {
    value = fault_.code;
  } else if (mask == 0x0020'0000) {
    value = (has_timed_out(now_ns) ? 1 : 0) + (kill_switch_open_ ? 2 : 0);
  } else {
    return;
  }
  hal::CanFrame reply = message(8, std::to_integer<std::uint32_t>(frame.data[0]));
  append(reply, 1, config_.vesc_id);
  append(reply, 1, 1);
  append(reply, 1, 0x32);
  append(reply, 4, mask);
  append(reply, 1, value);
  send(now_ns, reply);
}

void VescEmulator::advance(const DriveRun& run) {
  const hal::TimeNs now_ns = run.now_ns;
  if (run.follows_power_loss()) {
    offset_counts_ = 0;
    offset_counts_ = -shaft_counts();
    command_.current_A = 0.0;
    fault_.code = 0;
  }
  if (run.is_first()) {
    command_.time_ns = now_ns;
  }
  if (run.erroring) {
    fault_.code = kAbsoluteOverCurrent;
    fault_.stops_until_ns = now_ns + config_.fault_stop_ns;
  } else if (now_ns >= fault_.stops_until_ns) {
    fault_.code = 0;
  }
  if (fault_.lasting_code != 0) {
    fault_.code = fault_.lasting_code;
  }
  flowing_A_ = current_A(now_ns);
  shaft().torque_Nm = flowing_A_ * config_.torque_constant_Nm_per_A;
  send_due_status(now_ns);
}

bool VescEmulator::has_timed_out(hal::TimeNs now_ns) const {
  return config_.timeout_ns > 0 && now_ns - command_.time_ns > config_.timeout_ns;
}

double VescEmulator::current_A(hal::TimeNs now_ns) const {
  const bool is_dead =
      std::abs(command_.current_A) < config_.min_current_A && now_ns >= command_.holds_until_ns;
  const bool obeys = fault_.code == 0 && !kill_switch_open_ && !has_timed_out(now_ns);
  return obeys && !is_dead ? command_.current_A : 0.0;
}

void VescEmulator::send_due_status(hal::TimeNs now_ns) {
  if (config_.status_period_ns > 0 && now_ns - sent_.status_ns >= config_.status_period_ns) {
    sent_.status_ns = now_ns;
    send_status(now_ns);
    if (config_.sends_status_5) {
      send_status_5(now_ns);
    }
  }
  if (config_.status_4_period_ns > 0 && now_ns - sent_.status_4_ns >= config_.status_4_period_ns) {
    sent_.status_4_ns = now_ns;
    send_status_4(now_ns);
  }
}

void VescEmulator::send_status(hal::TimeNs now_ns) {
  hal::CanFrame frame = message(9, config_.vesc_id);
  append(frame, 4, std::llround(shaft().velocity_rad_per_s / kTurn * 60.0 * config_.pole_pairs));
  // A VESC reports a current that is positive where it drives and negative where it brakes. The
  // duty has the sign of the voltage, which resistance and turning motor take up.
  const double voltage_V = flowing_A_ * config_.phase_resistance_ohm +
                           shaft().velocity_rad_per_s * config_.torque_constant_Nm_per_A;
  const double driving_A = std::copysign(flowing_A_, flowing_A_ * voltage_V);
  append(frame, 2, std::llround(driving_A * 10.0));
  append(frame, 2, std::llround(std::clamp(voltage_V / kSupply_V, -1.0, 1.0) * 1000.0));
  send(now_ns, frame);
}

void VescEmulator::send_status_4(hal::TimeNs now_ns) {
  hal::CanFrame frame = message(16, config_.vesc_id);
  append(frame, 2, std::llround(temperatures_.fet_C * 10.0));
  append(frame, 2, std::llround(temperatures_.motor_C * 10.0));
  append(frame, 2, std::llround(std::abs(flowing_A_) * 10.0));
  const double turns = shaft().position_rad / kTurn;
  append(frame, 2, std::llround((turns - std::floor(turns)) * 360.0 * 50.0));
  send(now_ns, frame);
}

void VescEmulator::send_status_5(hal::TimeNs now_ns) {
  hal::CanFrame frame = message(27, config_.vesc_id);
  append(frame, 4, shaft_counts());
  append(frame, 2, 480);
  append(frame, 2, 0);
  send(now_ns, frame);
}

std::int32_t VescEmulator::shaft_counts() const {
  // The tachometer counts six commutation steps for each electrical turn.
  const auto counts = std::llround(shaft().position_rad / kTurn * 6.0 * config_.pole_pairs);
  return static_cast<std::int32_t>(counts + offset_counts_);
}

}  // namespace tactus::host
