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

// Returns the 32-bit float that begins at byte `at`.
double odrive_f32(const std::array<std::uint8_t, 8>& bytes, std::size_t at) {
  return static_cast<double>(std::bit_cast<float>(odrive_u32(bytes, at)));
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
      host_{.speed_limit_turn_per_s = config.speed_limit_turn_per_s} {
  // Spares it the frames of others, which take() would leave aside: nothing is lost if it fails.
  constexpr std::uint32_t kNodeBits = 0x7E0;
  const hal::CanFilter own{.word = std::uint32_t{config.node_id} << 5U,
                           .mask = kNodeBits | hal::CanFilter::kExtended};
  (void)bus.set_filters({&own, 1});
}

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
      host_.control_mode = odrive_u32(payload, 0);
      host_.input_mode = odrive_u32(payload, 4);
      return;
    case 0x0E:
      host_.torque_Nm = odrive_f32(payload, 0);
      return;
    case 0x0F:
      host_.speed_limit_turn_per_s = odrive_f32(payload, 0);
      return;
    case 0x18:
      errors_ = {};
      return;
    default:
      return;
  }
}

void ODriveEmulator::request_state(hal::TimeNs now_ns, std::uint32_t state) {
  if (state != kClosedLoop) {
    errors_.procedure_result = state_ == kClosedLoop ? kODriveCancelled : kODriveSuccess;
    state_ = kIdle;
    return;
  }
  if (errors_.axis == 0 && config_.calibrated) {
    state_ = kClosedLoop;
    fed_ns_ = now_ns;
    errors_.procedure_result = kODriveSuccess;
  } else if (is_0_6()) {
    state_ = kIdle;
    errors_.procedure_result =
        config_.calibrated ? kODriveInvalidStateResult : kODriveNotCalibratedResult;
  } else {
    raise(kODriveInvalidState);
  }
}

void ODriveEmulator::raise(std::uint32_t axis_error) {
  errors_.axis |= axis_error;
  if (state_ == kClosedLoop) {
    errors_.disarm_reason |= axis_error;
  }
  state_ = kIdle;
}

void ODriveEmulator::raise_motor_error(std::uint64_t error) {
  errors_.motor |= error;
  raise(kODriveMotorFailed);
}

void ODriveEmulator::drop_to_idle() {
  state_ = kIdle;
}

void ODriveEmulator::advance(const DriveRun& run) {
  const hal::TimeNs now_ns = run.now_ns;
  if (run.is_first()) {
    start_counting(now_ns);
  } else if (run.follows_power_loss()) {
    boot(now_ns);
  }
  if (run.error_begins) {
    if (is_0_6()) {
      raise(kODriveDriverFault_0_6);
    } else {
      raise_motor_error(kODriveMotorDriverFault);
    }
  }
  watch(now_ns);
  set_torque();
  send_due_messages(now_ns);
}

void ODriveEmulator::boot(hal::TimeNs now_ns) {
  state_ = kIdle;
  host_ = {.speed_limit_turn_per_s = config_.speed_limit_turn_per_s};
  errors_ = {};
  start_counting(now_ns);
}

void ODriveEmulator::start_counting(hal::TimeNs now_ns) {
  fed_ns_ = now_ns;
  next_.heartbeat_ns = now_ns;
  next_.estimates_ns = now_ns;
  zero_turns_ = turns_forgotten(config_.encoder, kTurnsPerRad * shaft().position_rad);
}

double ODriveEmulator::position_turns() const {
  return kTurnsPerRad * shaft().position_rad - zero_turns_;
}

void ODriveEmulator::watch(hal::TimeNs now_ns) {
  const double silent_s = 1e-9 * static_cast<double>(now_ns - fed_ns_);
  if (config_.watchdog_s > 0.0 && silent_s > config_.watchdog_s) {
    raise(is_0_6() ? kODriveWatchdogExpired_0_6 : kODriveWatchdogExpired_0_5);
  }
  // The firmware tolerates 20 % above the limit before it raises an error.
  constexpr double kOverspeedRatio = 1.2;
  const double speed = std::abs(kTurnsPerRad * shaft().velocity_rad_per_s);
  if (config_.enable_overspeed_error && state_ == kClosedLoop &&
      speed > kOverspeedRatio * host_.speed_limit_turn_per_s) {
    if (is_0_6()) {
      raise(kODriveVelocityLimit_0_6);
    } else {
      errors_.controller |= kODriveControllerOverspeed;
      raise(kODriveControllerFailed);
    }
  }
}

// There is torque in closed loop only, with torque control and the input passed through. The speed
// limit of torque mode acts as a steep damper beyond the limit.
void ODriveEmulator::set_torque() {
  constexpr std::uint32_t kTorqueControl = 1;
  constexpr std::uint32_t kPassthrough = 1;
  if (state_ != kClosedLoop || host_.control_mode != kTorqueControl ||
      host_.input_mode != kPassthrough) {
    shaft().torque_Nm = 0.0;
    return;
  }
  double torque_Nm = std::clamp(host_.torque_Nm, -config_.max_torque_Nm, config_.max_torque_Nm);
  if (config_.enable_torque_mode_speed_limit) {
    const double speed = kTurnsPerRad * shaft().velocity_rad_per_s;
    const double gain = config_.speed_gain_Nm_s_per_turn;
    const double lowest = (-host_.speed_limit_turn_per_s - speed) * gain;
    const double highest = (host_.speed_limit_turn_per_s - speed) * gain;
    torque_Nm = std::max(std::min(torque_Nm, highest), lowest);
  }
  shaft().torque_Nm = torque_Nm;
}

}  // namespace tactus::host
