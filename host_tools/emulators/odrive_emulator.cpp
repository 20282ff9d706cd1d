// Encoded by hand from the facts about CANSimple, and never through the driver's code, so that an
// error in either shows.

#include "host_tools/emulators/odrive_emulator.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {

namespace {

constexpr double kODriveTurnsPerRad = 0.5 / std::numbers::pi;
constexpr hal::TimeNs kODriveNsPerMs = 1'000'000;

// The axis states that are faked.
constexpr std::uint32_t kODriveIdle = 1;
constexpr std::uint32_t kODriveClosedLoop = 8;

// Error bits of firmware 0.5.
constexpr std::uint32_t kODriveInvalidState = 0x1;
constexpr std::uint32_t kODriveMotorFailed = 0x40;
constexpr std::uint32_t kODriveControllerFailed = 0x200;
constexpr std::uint32_t kODriveWatchdogExpired_0_5 = 0x800;
constexpr std::uint32_t kODriveEstop_0_5 = 0x4000;
constexpr std::uint64_t kODriveMotorDriverFault = 0x8;
constexpr std::uint32_t kODriveControllerOverspeed = 0x1;
// Error bits of firmware 0.6.
constexpr std::uint32_t kODriveDriverFault_0_6 = 0x20;
constexpr std::uint32_t kODriveVelocityLimit_0_6 = 0x8000;
constexpr std::uint32_t kODriveWatchdogExpired_0_6 = 0x0100'0000;
constexpr std::uint32_t kODriveEstop_0_6 = 0x0200'0000;
// The procedure results of firmware 0.6.
constexpr std::uint8_t kODriveSuccess = 0;
constexpr std::uint8_t kODriveCancelled = 2;
constexpr std::uint8_t kODriveInvalidStateResult = 13;
constexpr std::uint8_t kODriveNotCalibratedResult = 14;

template <std::size_t kSize>
std::uint32_t odrive_u32(const std::array<std::uint8_t, kSize>& bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} | (std::uint32_t{bytes[at + 1]} << 8U) |
         (std::uint32_t{bytes[at + 2]} << 16U) | (std::uint32_t{bytes[at + 3]} << 24U);
}

template <std::size_t kSize>
void put_odrive_u32(std::array<std::uint8_t, kSize>& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (8U * i));
  }
}

// Returns the 32-bit float that begins at byte `at`.
double odrive_f32(const std::array<std::uint8_t, 8>& bytes, std::size_t at) {
  return static_cast<double>(std::bit_cast<float>(odrive_u32(bytes, at)));
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

ODriveFirmware odrive_firmware(std::string_view version) {
  constexpr std::array<std::pair<std::string_view, ODriveFirmware>, 4> kVersions = {{
      {"0.5.2", ODriveFirmware::v0_5_2},
      {"0.5.4", ODriveFirmware::v0_5_4},
      {"0.5.6", ODriveFirmware::v0_5_6},
      {"0.6", ODriveFirmware::v0_6},
  }};
  for (const auto& [name, firmware] : kVersions) {
    if (name == version) {
      return firmware;
    }
  }
  throw InputError("no ODrive firmware '" + std::string(version) +
                   "'; there are: 0.5.2, 0.5.4, 0.5.6, 0.6");
}

ODriveEmulator::ODriveEmulator(hal::CanBus& bus, std::uint32_t seed,
                               const ODriveEmulatorConfig& config)
    : CanEmulator(bus, seed),
      config_(config),
      saved_speed_limit_turn_per_s_(config.speed_limit_turn_per_s) {}

void ODriveEmulator::take(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  if (frame.extended || frame.fd || (frame.id >> 5U) != config_.node_id) {
    return;
  }
  const unsigned command = frame.id & 0x1FU;
  Payload payload{};
  for (std::size_t i = 0; i < frame.bytes().size(); ++i) {
    payload[i] = std::to_integer<std::uint8_t>(frame.data[i]);
  }
  // Firmware 0.5 feeds its watchdog with any frame of the host, 0.6 with setpoints only.
  const bool is_setpoint = command >= 0x0C && command <= 0x0E;
  if (!is_0_6() || is_setpoint) {
    fed_ns_ = now_ns;
  }
  // Newer firmware takes an empty frame for a request, except for commands that have no data
  // anyway.
  const bool understands_empty =
      config_.firmware == ODriveFirmware::v0_5_6 || config_.firmware == ODriveFirmware::v0_6;
  if (frame.remote || (frame.length == 0 && understands_empty && command != 0x02 &&
                       command != 0x10 && command != 0x16 && command != 0x18)) {
    answer(now_ns, command);
  } else {
    obey(now_ns, command, payload);
  }
}

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
        send_payload(now_ns, command, odrive_words(error_, disarm_reason_));
      } else {
        send_payload(now_ns, command,
                     odrive_words(static_cast<std::uint32_t>(motor_error_),
                                  static_cast<std::uint32_t>(motor_error_ >> 32U)));
      }
      return;
    case 0x04:
      if (!is_0_6()) {
        send_payload(now_ns, command, odrive_words(encoder_error_, 0));
      }
      return;
    case 0x09:
      send_estimates(now_ns);
      return;
    // The currents that are wanted and that flow, A.
    case 0x14:
      send_payload(now_ns, command,
                   odrive_floats(input_torque_Nm_ / config_.torque_constant_Nm_per_A,
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
        send_payload(now_ns, command, odrive_floats(input_torque_Nm_, shaft().torque_Nm));
      }
      return;
    // The powers of firmware 0.6; firmware 0.5.6 has the controller's error here.
    case 0x1D:
      if (is_0_6()) {
        send_payload(now_ns, command, odrive_floats(0.0, 0.0));
      } else if (is_0_5_6) {
        send_payload(now_ns, command, odrive_words(controller_error_, 0));
      }
      return;
    default:
      return;
  }
}

// Commands: 0x02 estop, 0x07 axis state, 0x0B controller modes, 0x0E torque, 0x0F limits, 0x18
// clear errors.
void ODriveEmulator::obey(hal::TimeNs now_ns, unsigned command, const Payload& payload) {
  switch (command) {
    case 0x02:
      raise(is_0_6() ? kODriveEstop_0_6 : kODriveEstop_0_5);
      return;
    case 0x07:
      request_state(now_ns, odrive_u32(payload, 0));
      return;
    case 0x0B:
      control_mode_ = odrive_u32(payload, 0);
      input_mode_ = odrive_u32(payload, 4);
      return;
    case 0x0E:
      input_torque_Nm_ = odrive_f32(payload, 0);
      return;
    case 0x0F:
      config_.speed_limit_turn_per_s = odrive_f32(payload, 0);
      return;
    case 0x18:
      clear_errors();
      return;
    default:
      return;
  }
}

void ODriveEmulator::request_state(hal::TimeNs now_ns, std::uint32_t state) {
  if (state != kODriveClosedLoop) {
    procedure_result_ = state_ == kODriveClosedLoop ? kODriveCancelled : kODriveSuccess;
    state_ = kODriveIdle;
    return;
  }
  if (error_ == 0 && config_.calibrated) {
    state_ = kODriveClosedLoop;
    fed_ns_ = now_ns;
    procedure_result_ = kODriveSuccess;
  } else if (is_0_6()) {
    state_ = kODriveIdle;
    procedure_result_ = config_.calibrated ? kODriveInvalidStateResult : kODriveNotCalibratedResult;
  } else {
    raise(kODriveInvalidState);
  }
}

void ODriveEmulator::clear_errors() {
  error_ = 0;
  disarm_reason_ = 0;
  procedure_result_ = kODriveSuccess;
  motor_error_ = 0;
  encoder_error_ = 0;
  controller_error_ = 0;
}

void ODriveEmulator::raise(std::uint32_t axis_error) {
  error_ |= axis_error;
  if (state_ == kODriveClosedLoop) {
    disarm_reason_ |= axis_error;
  }
  state_ = kODriveIdle;
}

void ODriveEmulator::raise_motor_error(std::uint64_t error) {
  motor_error_ |= error;
  raise(kODriveMotorFailed);
}

void ODriveEmulator::drop_to_idle() {
  state_ = kODriveIdle;
}

void ODriveEmulator::send_wrong_length(hal::TimeNs now_ns) {
  send_payload(now_ns, 0x09, {0, 0, 0, 0}, 4);
}

void ODriveEmulator::send_not_a_number(hal::TimeNs now_ns) {
  send_payload(now_ns, 0x09, odrive_floats(std::numeric_limits<double>::quiet_NaN(), 0.0));
}

void ODriveEmulator::advance(hal::TimeNs now_ns, bool erroring) {
  if (!running_) {
    running_ = true;
    start_counting(now_ns);
  } else if (now_ns - ran_ns_ >= kPowerLoss_ns) {
    boot(now_ns);
  }
  ran_ns_ = now_ns;
  if (erroring && !was_erroring_) {
    if (is_0_6()) {
      raise(kODriveDriverFault_0_6);
    } else {
      raise_motor_error(kODriveMotorDriverFault);
    }
  }
  was_erroring_ = erroring;
  watch(now_ns);
  set_torque();
  if (config_.heartbeat_ms > 0 && now_ns >= next_heartbeat_ns_) {
    next_heartbeat_ns_ = next_due_ns(next_heartbeat_ns_, config_.heartbeat_ms, now_ns);
    send_heartbeat(now_ns);
  }
  if (config_.encoder_ms > 0 && now_ns >= next_estimates_ns_) {
    next_estimates_ns_ = next_due_ns(next_estimates_ns_, config_.encoder_ms, now_ns);
    send_estimates(now_ns);
  }
}

void ODriveEmulator::boot(hal::TimeNs now_ns) {
  state_ = kODriveIdle;
  control_mode_ = 3;
  input_mode_ = 1;
  input_torque_Nm_ = 0.0;
  config_.speed_limit_turn_per_s = saved_speed_limit_turn_per_s_;
  clear_errors();
  start_counting(now_ns);
}

void ODriveEmulator::start_counting(hal::TimeNs now_ns) {
  fed_ns_ = now_ns;
  next_heartbeat_ns_ = now_ns;
  next_estimates_ns_ = now_ns;
  zero_turns_ = turns_forgotten(config_.encoder, kODriveTurnsPerRad * shaft().position_rad);
}

double ODriveEmulator::position_turns() const {
  return kODriveTurnsPerRad * shaft().position_rad - zero_turns_;
}

void ODriveEmulator::watch(hal::TimeNs now_ns) {
  const double silent_s = 1e-9 * static_cast<double>(now_ns - fed_ns_);
  if (config_.watchdog_s > 0.0 && silent_s > config_.watchdog_s) {
    raise(is_0_6() ? kODriveWatchdogExpired_0_6 : kODriveWatchdogExpired_0_5);
  }
  // The firmware tolerates 20 % above the limit before it raises an error.
  constexpr double kOverspeedRatio = 1.2;
  const double speed = std::abs(kODriveTurnsPerRad * shaft().velocity_rad_per_s);
  if (config_.enable_overspeed_error && state_ == kODriveClosedLoop &&
      speed > kOverspeedRatio * config_.speed_limit_turn_per_s) {
    if (is_0_6()) {
      raise(kODriveVelocityLimit_0_6);
    } else {
      controller_error_ |= kODriveControllerOverspeed;
      raise(kODriveControllerFailed);
    }
  }
}

// There is torque in closed loop only, with torque control and the input passed through. The speed
// limit of torque mode acts as a steep damper beyond the limit.
void ODriveEmulator::set_torque() {
  constexpr std::uint32_t kTorqueControl = 1;
  constexpr std::uint32_t kPassthrough = 1;
  if (state_ != kODriveClosedLoop || control_mode_ != kTorqueControl ||
      input_mode_ != kPassthrough) {
    shaft().torque_Nm = 0.0;
    return;
  }
  double torque_Nm = std::clamp(input_torque_Nm_, -config_.max_torque_Nm, config_.max_torque_Nm);
  if (config_.enable_torque_mode_speed_limit) {
    const double speed = kODriveTurnsPerRad * shaft().velocity_rad_per_s;
    const double gain = config_.speed_gain_Nm_s_per_turn;
    const double lowest = (-config_.speed_limit_turn_per_s - speed) * gain;
    const double highest = (config_.speed_limit_turn_per_s - speed) * gain;
    torque_Nm = std::max(std::min(torque_Nm, highest), lowest);
  }
  shaft().torque_Nm = torque_Nm;
}

void ODriveEmulator::send_heartbeat(hal::TimeNs now_ns) {
  Payload payload = odrive_words(error_, state_);
  if (config_.firmware == ODriveFirmware::v0_5_6) {
    payload[5] = motor_error_ != 0 ? 1 : 0;
    payload[6] = encoder_error_ != 0 ? 1 : 0;
    payload[7] = controller_error_ != 0 ? 1 : 0;
  } else if (is_0_6()) {
    payload[5] = procedure_result_;
  }
  if (config_.firmware == ODriveFirmware::v0_5_4 || config_.firmware == ODriveFirmware::v0_5_6) {
    payload[7] |= 0x80;  // trajectory done
  }
  send_payload(now_ns, 0x01, payload);
}

void ODriveEmulator::send_estimates(hal::TimeNs now_ns) {
  send_payload(now_ns, 0x09,
               odrive_floats(position_turns(), kODriveTurnsPerRad * shaft().velocity_rad_per_s));
}

void ODriveEmulator::send_payload(hal::TimeNs now_ns, unsigned command, const Payload& payload,
                                  std::uint8_t length) {
  hal::CanFrame frame{.id = (std::uint32_t{config_.node_id} << 5U) | command, .length = length};
  std::ranges::transform(payload, frame.data.begin(),
                         [](std::uint8_t byte) { return std::byte{byte}; });
  send(now_ns, frame);
}

}  // namespace tactus::host
