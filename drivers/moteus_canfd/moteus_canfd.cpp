#include "drivers/moteus_canfd/moteus_canfd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "drivers/common/seconds.h"
#include "drivers/common/torque_clamp.h"
#include "drivers/moteus_canfd/moteus_errors.h"

namespace tactus::drivers {

namespace {

// Stands for a missing value. encoder_check refuses it as it refuses a NaN from the servo.
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

// The interval of queries to a servo that has not answered yet. More frames would fill the queue
// while nobody acknowledges them.
constexpr double kAskAgain_s = 0.02;
// The longest silence during the bring-up of a servo that has answered.
constexpr double kSilence_s = 0.1;
// A servo that has not stopped so long after its watchdog's time has no watchdog.
constexpr double kProofMargin_s = 0.05;

constexpr std::uint32_t kGone = kDeviceLost | kDeviceReferenceLost;
constexpr std::uint32_t kMoved = kDeviceEncoderFault | kDeviceReferenceLost;
constexpr std::uint32_t kRestarted = kDeviceDriveFault | kDeviceReferenceLost;

// Returns the status bits of a fault code. After a fault of supply or encoder the position may
// count from another zero.
std::uint32_t status_of_fault(std::uint8_t code) {
  constexpr std::array<std::uint8_t, 6> kSupplyOrEncoder = {33, 35, 40, 42, 43, 44};
  return std::ranges::find(kSupplyOrEncoder, code) != kSupplyOrEncoder.end()
             ? kRestarted
             : std::uint32_t{kDeviceDriveFault};
}

}  // namespace

MoteusCanFd::MoteusCanFd(const MoteusConfig& config)
    : config_(config),
      address_{.servo = config.servo_id,
               .host = config.host_id,
               .prefix = config.prefix,
               .bit_rate_switch = config.bit_rate_switch},
      encoder_({.max_speed_rad_per_s = config.max_speed_rad_per_s,
                .margin_rad = config.jump_margin_rad}) {}

// A servo may send a short identifier in a standard or an extended frame, so both are wanted.
std::size_t MoteusCanFd::filters(std::span<hal::CanFilter> filters) const {
  const std::uint32_t id = moteus::reply_id(address_);
  filters[0] = hal::CanFilter::extended(id);
  if (id > hal::kMaxStandardId) {
    return 1;
  }
  filters[1] = hal::CanFilter::standard(id);
  return 2;
}

void MoteusCanFd::start(hal::TimeNs now_ns) {
  known_ = {};
  begin(now_ns);
}

// A loss of the reference stays until a read has reported it.
void MoteusCanFd::clear_faults(hal::TimeNs now_ns) {
  if (stage_.phase == Phase::failed && !faults_.is_held()) {
    begin(now_ns);
  }
}

// A position that is followed stays so, if there is no gap in the replies.
void MoteusCanFd::begin(hal::TimeNs now_ns) {
  if (!known_.is_followed) {
    sample_ = {};
    sent_.questions.restart();
    heard_.has_replied = false;
    encoder_.reset();
  }
  sample_.status = kDeviceNotReady;
  sample_.has_torque = false;
  faults_.clear();
  readings_ = {};
  heard_.last_fault = 0;
  enter(Phase::stopping, now_ns);
}

void MoteusCanFd::enter(Phase phase, hal::TimeNs now_ns) {
  stage_ = {.phase = phase, .begun_ns = now_ns};
  if (phase == Phase::up) {
    sample_.status = kDeviceOk;
    known_.is_followed = true;
  }
}

void MoteusCanFd::fail(std::uint32_t status, const Trouble& trouble) {
  stage_.phase = Phase::failed;
  faults_.latch(status, trouble);
  sample_.status = faults_.status();
  if ((status & kDeviceReferenceLost) != 0 && known_.is_followed) {
    known_ = {};
    faults_.hold();
  }
}

void MoteusCanFd::request(hal::TimeNs now_ns, CanOutbox& outbox) {
  watch_deadlines(now_ns);
  faults_.show();  // the sample of this read has the whole status
  const bool is_under_torque = stage_.phase == Phase::starting || stage_.phase == Phase::up;
  if (is_under_torque && config_.query == MoteusQuery::before_command) {
    outbox.add(moteus::query(address_));
  }
}

void MoteusCanFd::command(hal::TimeNs now_ns, const AxisCommand& command, CanOutbox& outbox) {
  watch_deadlines(now_ns);
  const bool asks_here = config_.query == MoteusQuery::with_command;
  switch_power(command.power_off, now_ns);
  switch (stage_.phase) {
    case Phase::off:
      return;
    case Phase::stopping:
      if (is_time_to_ask(now_ns)) {
        outbox.add(moteus::stop(address_, true));
      }
      return;
    case Phase::starting:
    case Phase::up: {
      const float torque_Nm =
          stage_.phase == Phase::up ? clamped_torque_Nm(command, config_.max_torque_Nm) : 0.0F;
      outbox.add(
          moteus::torque(address_, torque_Nm, static_cast<float>(config_.watchdog_s), asks_here));
      sent_.torque_ns = now_ns;
      return;
    }
    case Phase::proving:
      outbox.add(moteus::query(address_));  // a query feeds no watchdog
      return;
    case Phase::resting:
    case Phase::failed:
      outbox.add(moteus::stop(address_, true));
      return;
  }
}

void MoteusCanFd::switch_power(bool power_off, hal::TimeNs now_ns) {
  const bool has_power = stage_.phase == Phase::starting || stage_.phase == Phase::proving ||
                         stage_.phase == Phase::up;
  if (power_off && has_power) {
    enter(Phase::resting, now_ns);
  } else if (!power_off && stage_.phase == Phase::resting) {
    sample_.status = kDeviceNotReady;
    enter(Phase::stopping, now_ns);
  }
}

void MoteusCanFd::shutdown(CanOutbox& outbox) {
  outbox.add(moteus::torque(address_, 0.0F, static_cast<float>(config_.watchdog_s), false));
  outbox.add(moteus::stop(address_, false));
  stage_.phase = Phase::off;
  sample_.status |= kDeviceNotReady;
}

bool MoteusCanFd::is_time_to_ask(hal::TimeNs now_ns) {
  if (!heard_.has_replied && !sent_.questions.is_due(kAskAgain_s, now_ns)) {
    return false;
  }
  sent_.questions.sent(now_ns);
  return true;
}

void MoteusCanFd::watch_deadlines(hal::TimeNs now_ns) {
  if (stage_.phase == Phase::off) {
    return;
  }
  // Times of received frames may be stamped in the future; they count as now.
  stage_.begun_ns = std::min(stage_.begun_ns, now_ns);
  heard_.position_ns = std::min(heard_.position_ns, now_ns);
  heard_.reply_ns = std::min(heard_.reply_ns, now_ns);
  // A servo that restarts is silent for this time.
  if (known_.is_followed && has_passed(config_.reply_lost_s, heard_.reply_ns, now_ns)) {
    fail(kGone, {"the servo's replies stopped",
                 "check its power and the bus's cable, then reset and home"});
  } else if (stage_.phase == Phase::up || (stage_.phase == Phase::resting && known_.is_followed)) {
    watch_samples(now_ns);
  } else if (stage_.phase == Phase::proving) {
    watch_proof(now_ns);
  } else if (stage_.phase != Phase::failed && stage_.phase != Phase::resting) {
    watch_bring_up(now_ns);
  }
}

void MoteusCanFd::watch_samples(hal::TimeNs now_ns) {
  if (has_passed(config_.reply_lost_s, heard_.position_ns, now_ns)) {
    fail(kGone, {"the servo's positions stopped",
                 "check its power, its encoder and the bus's cable, then reset and home"});
  } else if (has_passed(config_.reply_stale_s, heard_.position_ns, now_ns)) {
    sample_.status |= kDeviceStale;
  }
}

void MoteusCanFd::watch_proof(hal::TimeNs now_ns) {
  if (has_passed(kSilence_s, heard_.reply_ns, now_ns)) {
    fail(kGone, {"no reply comes from the servo while its watchdog is proven",
                 "check its power and the bus's cable, then reset"});
  } else if (has_passed(config_.watchdog_s + kProofMargin_s, sent_.torque_ns, now_ns)) {
    fail(kDeviceDriveFault,
         {"the servo's watchdog does not stop it when commands stop",
          "see that nobody else commands it and update its firmware, or set unproven_watchdog; "
          "then reset"});
  }
}

// Latches the bring-up step that took too long.
void MoteusCanFd::watch_bring_up(hal::TimeNs now_ns) {
  if (!has_passed(config_.bring_up_s, stage_.begun_ns, now_ns)) {
    return;
  }
  if (!heard_.has_replied || has_passed(kSilence_s, heard_.reply_ns, now_ns)) {
    fail(kDeviceLost,
         {"no reply comes from the servo",
          "check its power, the bus's cable, both bit rates, servo id and prefix, then reset"});
  } else if (heard_.last_fault != 0) {
    fail(kDeviceDriveFault, moteus::fault_trouble(heard_.last_fault));
  } else if (stage_.phase == Phase::stopping) {
    fail(kDeviceDriveFault, {"the servo does not stop", "power-cycle it, then reset"});
  } else if (!encoder_.is_trusted()) {
    fail(kDeviceEncoderFault, {"the servo reports no usable position",
                               "check its encoder and magnet in tview, then reset"});
  } else {
    fail(kDeviceDriveFault,
         {"the servo does not go into position mode", "run moteus_tool --calibrate, then reset"});
  }
}

void MoteusCanFd::take(const hal::CanReceived& received) {
  const hal::CanFrame& frame = received.frame;
  if (received.kind == hal::CanReceived::Kind::frame && !frame.remote &&
      frame.id == moteus::reply_id(address_) && stage_.phase != Phase::off) {
    take_reply(moteus::read_reply(frame.bytes()), received.time_ns);
  }
}

void MoteusCanFd::take_reply(const moteus::Reply& reply, hal::TimeNs time_ns) {
  heard_.has_replied = true;
  heard_.reply_ns = time_ns;
  if (reply.refused_register) {
    fail(kDeviceDriveFault, {"the servo refuses a register that this driver uses",
                             "update the servo's firmware, then reset", *reply.refused_register});
    return;
  }
  if (!reply.mode || !reply.position_rad || !reply.velocity_rad_per_s) {
    ++readings_.malformed;
    return;
  }
  const std::uint8_t told = reply.fault.value_or(0);
  readings_.limit = moteus::is_limit(told) ? told : std::uint8_t{0};
  readings_.voltage_V = reply.voltage_V.value_or(readings_.voltage_V);
  readings_.temperature_C = reply.temperature_C.value_or(readings_.temperature_C);
  take_home_state(reply.home_state);
  take_mode(*reply.mode, moteus::is_limit(told) ? std::uint8_t{0} : told, time_ns);
  take_position(reply, time_ns);
}

// A servo whose home state falls has restarted.
void MoteusCanFd::take_home_state(std::optional<std::uint8_t> home_state) {
  if (!home_state) {
    return;
  }
  if (known_.is_followed && *home_state < readings_.home_state) {
    fail(kRestarted, {"the servo restarted by itself: it knows less of its position than before",
                      "check its supply, then reset and home", *home_state});
  }
  readings_.home_state = *home_state;
  if (config_.absolute_output && *home_state != moteus::kHomeOutput) {
    fail(kRestarted,
         {"the servo knows no absolute position of its output, only its rotor's at most",
          "home the joint instead of reference absolute, or fit an output encoder and set "
          "motor_position.sources and output in tview; then reset",
          *home_state});
  }
}

void MoteusCanFd::take_mode(std::uint8_t mode, std::uint8_t fault, hal::TimeNs time_ns) {
  heard_.last_fault = fault;
  const auto told = static_cast<moteus::Mode>(mode);
  if (known_.is_followed && fault != 0 && status_of_fault(fault) == kRestarted) {
    fail(kRestarted, moteus::fault_trouble(fault));
  }
  switch (stage_.phase) {
    case Phase::stopping:
      if (told == moteus::Mode::stopped && fault == 0) {
        enter(Phase::starting, time_ns);
      }
      return;
    case Phase::starting:
    case Phase::up:
      take_mode_under_torque(told, fault, time_ns);
      return;
    case Phase::proving:
      take_proof(told, fault, time_ns);
      return;
    default:
      return;
  }
}

void MoteusCanFd::take_mode_under_torque(moteus::Mode mode, std::uint8_t fault,
                                         hal::TimeNs time_ns) {
  if (mode == moteus::Mode::fault || fault != 0) {
    fail(status_of_fault(fault), moteus::fault_trouble(fault));
  } else if (mode == moteus::Mode::timeout) {
    fail(kDeviceDriveFault, {"the servo's watchdog expired: commands came too late",
                             "check the bus's cable and the host's load, then reset",
                             static_cast<std::uint32_t>(mode)});
  } else if (stage_.phase == Phase::up && mode != moteus::Mode::position) {
    fail(mode == moteus::Mode::stopped ? kRestarted : std::uint32_t{kDeviceDriveFault},
         {"the servo left torque control by itself, as one that restarts does",
          "check its supply and who else commands it, then reset and home",
          static_cast<std::uint32_t>(mode)});
  } else if (stage_.phase == Phase::starting && mode == moteus::Mode::position &&
             encoder_.is_trusted() &&
             !has_passed(config_.reply_stale_s, heard_.position_ns, time_ns)) {
    enter(known_.is_proven || config_.unproven_watchdog ? Phase::up : Phase::proving, time_ns);
  }
}

// Takes a reply during the proof. The silence counts from the last torque frame.
void MoteusCanFd::take_proof(moteus::Mode mode, std::uint8_t fault, hal::TimeNs time_ns) {
  if (mode == moteus::Mode::fault || fault != 0) {
    fail(status_of_fault(fault), moteus::fault_trouble(fault));
  } else if (mode == moteus::Mode::timeout) {
    known_.is_proven = true;
    enter(Phase::stopping, time_ns);
  } else if (mode != moteus::Mode::position) {
    fail(kDeviceDriveFault,
         {"the servo left torque control while its watchdog was proven",
          "find out who else commands it, then reset", static_cast<std::uint32_t>(mode)});
  }
}

// The position is watched in every phase. A jump while it is followed loses the reference.
void MoteusCanFd::take_position(const moteus::Reply& reply, hal::TimeNs time_ns) {
  const double position_rad = reply.position_rad.value_or(kNotANumber);
  const double velocity_rad_per_s = reply.velocity_rad_per_s.value_or(kNotANumber);
  const EncoderVerdict verdict = encoder_.check(position_rad, velocity_rad_per_s, time_ns);
  if (verdict != EncoderVerdict::good) {
    if (known_.is_followed) {
      fail(kMoved, trouble_of(verdict));
    }
    encoder_.reset();
    return;
  }
  heard_.position_ns = time_ns;
  if (stage_.phase == Phase::failed) {
    return;
  }
  sample_.position_rad = position_rad;
  sample_.velocity_rad_per_s = velocity_rad_per_s;
  if (reply.torque_Nm && std::isfinite(*reply.torque_Nm)) {
    sample_.torque_Nm = *reply.torque_Nm;
    sample_.has_torque = true;
  }
  sample_.time_ns = time_ns;
  sample_.status &= ~std::uint32_t{kDeviceStale};
}

}  // namespace tactus::drivers
