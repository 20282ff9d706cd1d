// Encoded by hand from the facts about the register protocol, and never through the driver's code,
// so that an error in either shows.

#include "host_tools/emulators/moteus_emulator.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tactus::host {

namespace {

// The modes of register 0x000. From `enabling` to `calibrated` the servo starts; above it runs.
constexpr int kMoteusStopped = 0;
constexpr int kMoteusFault = 1;
constexpr int kMoteusEnabling = 2;
constexpr int kMoteusCalibrated = 4;
constexpr int kMoteusPosition = 10;
constexpr int kMoteusTimeout = 11;
constexpr int kMoteusZeroVelocity = 12;
// The fault code of register 0x00F for an error of the motor driver.
constexpr int kMotorDriverFaultCode = 33;
// A servo that has not been run for this time was without power.
constexpr hal::TimeNs kMoteusPowerLoss_ns = 200'000'000;

}  // namespace

MoteusEmulator::MoteusEmulator(hal::CanBus& bus, std::uint32_t seed,
                               const MoteusEmulatorConfig& config)
    : CanEmulator(bus, seed), config_(config) {}

void MoteusEmulator::take(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  const bool is_mine = (frame.id & 0x7FU) == config_.servo_id && (frame.id & 0x80U) == 0 &&
                       (frame.id >> 16U) == config_.prefix && !frame.remote;
  if (!is_mine) {
    return;
  }
  query_ = {.written = command_};
  read_subframes({frame.data.data(), frame.length});
  if ((frame.id & 0x8000U) != 0) {
    reply(now_ns, frame);
  }
  if (query_.has_mode) {
    obey(now_ns);
  }
}

// Carries out a frame that writes the mode. The reply to it was made before and shows the earlier
// state, as that of a servo does.
void MoteusEmulator::obey(hal::TimeNs now_ns) {
  if (query_.written.mode == kMoteusStopped) {
    command_ = query_.written;
    mode_ = kMoteusStopped;
    fault_ = 0;
    return;
  }
  if (mode_ == kMoteusFault || mode_ == kMoteusTimeout) {
    return;
  }
  if (mode_ == kMoteusStopped) {
    mode_ = kMoteusEnabling;
    started_ns_ = now_ns;
    held_rev_ = kRevPerRad * shaft().position_rad;
  }
  if (mode_ > kMoteusCalibrated) {
    mode_ = query_.written.mode;
  }
  command_ = query_.written;
  commanded_ns_ = now_ns;
}

void MoteusEmulator::raise_fault(int code) {
  fault_ = code;
  mode_ = kMoteusFault;
}

void MoteusEmulator::limit(int code) {
  limit_ = code;
}

void MoteusEmulator::lose_position(bool is_lost) {
  sensor_.is_lost = is_lost;
}

// After power-up the rotor's encoder tells the angle within a turn of the rotor, and the output's
// encoder within a turn of the output; whole turns are lost.
void MoteusEmulator::boot() {
  mode_ = kMoteusStopped;
  fault_ = 0;
  command_ = {};
  const double turn_rad = (config_.output_encoder ? 1.0 : 1.0 / config_.gear) / kRevPerRad;
  sensor_.zero_rad = turn_rad * std::round(shaft().position_rad / turn_rad);
}

void MoteusEmulator::advance(const DriveRun& run) {
  if (run.follows_power_loss(kMoteusPowerLoss_ns)) {
    boot();
  }
  if (run.error_begins) {
    raise_fault(kMotorDriverFaultCode);
  }
  proceed(run.now_ns);
  set_torque();
}

void MoteusEmulator::proceed(hal::TimeNs now_ns) {
  const double since_s = 1e-9 * static_cast<double>(now_ns - started_ns_);
  if (mode_ >= kMoteusEnabling && mode_ <= kMoteusCalibrated) {
    constexpr int kSteps = kMoteusCalibrated - kMoteusEnabling + 1;
    const int step = static_cast<int>(kSteps * since_s / config_.start_s);
    mode_ = step < kSteps ? kMoteusEnabling + step : command_.mode;
  }
  const double silent_s = 1e-9 * static_cast<double>(now_ns - commanded_ns_);
  const double timeout_s =
      command_.timeout_s == 0.0 ? config_.default_timeout_s : command_.timeout_s;
  // A time-out of NaN never expires.
  if (config_.has_watchdog && mode_ == kMoteusPosition && silent_s > timeout_s) {
    mode_ = kMoteusTimeout;
  }
}

// The control law of moteus, of position p, velocity v and scales s, with the torque limited:
//
//   tau = s_p k_p (p_goal - p) + s_d k_d (v_goal - v) + feedforward
void MoteusEmulator::set_torque() {
  const double position_rev = kRevPerRad * shaft().position_rad;
  const double velocity_rev_per_s = kRevPerRad * shaft().velocity_rad_per_s;
  const bool damps = mode_ == kMoteusZeroVelocity ||
                     (mode_ == kMoteusTimeout && config_.timeout_mode == kMoteusZeroVelocity);
  if (damps) {
    shaft().torque_Nm = std::clamp(-config_.kd_Nm_s_per_rev * velocity_rev_per_s,
                                   -config_.timeout_max_torque_Nm, config_.timeout_max_torque_Nm);
    return;
  }
  if (mode_ != kMoteusPosition) {
    shaft().torque_Nm = 0.0;
    return;
  }
  const double goal_rev = std::isnan(command_.position_rev) ? held_rev_ : command_.position_rev;
  const double wanted_Nm = command_.kp_scale * config_.kp_Nm_per_rev * (goal_rev - position_rev) +
                           command_.kd_scale * config_.kd_Nm_s_per_rev *
                               (command_.velocity_rev_per_s - velocity_rev_per_s) +
                           command_.feedforward_Nm;
  const double most_Nm = std::isnan(command_.max_torque_Nm)
                             ? config_.max_torque_Nm
                             : std::min(command_.max_torque_Nm, config_.max_torque_Nm);
  shaft().torque_Nm = std::clamp(wanted_Nm, -most_Nm, most_Nm);
}

void MoteusEmulator::reply(hal::TimeNs now_ns, const hal::CanFrame& asking) {
  // The payload lengths that CAN FD has; the rest of a frame is padding.
  constexpr std::array<std::size_t, 16> kLengths{0, 1,  2,  3,  4,  5,  6,  7,
                                                 8, 12, 16, 20, 24, 32, 48, 64};
  const std::uint32_t host = (asking.id >> 8U) & 0x7FU;
  const std::uint32_t id =
      (std::uint32_t{config_.prefix} << 16U) | (std::uint32_t{config_.servo_id} << 8U) | host;
  query_.answer.resize(std::min(query_.answer.size(), kLengths.back()));
  query_.answer.resize(*std::ranges::lower_bound(kLengths, query_.answer.size()), 0x50);
  hal::CanFrame frame{.id = id, .extended = id >= 0x7FFU};
  frame.fd = asking.fd || query_.answer.size() > hal::kMaxCanBytes;
  frame.bit_rate_switch = asking.bit_rate_switch;
  frame.length = static_cast<std::uint8_t>(query_.answer.size());
  std::ranges::transform(query_.answer, frame.data.begin(),
                         [](std::uint8_t byte) { return std::byte{byte}; });
  send(now_ns, frame);
}

}  // namespace tactus::host
