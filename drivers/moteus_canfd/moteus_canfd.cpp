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
  is_followed_ = false;
  is_proven_ = false;
  begin(now_ns);
}

// A loss of the reference stays until a read has reported it.
void MoteusCanFd::clear_faults(hal::TimeNs now_ns) {
  if (phase_ == Phase::failed && is_shown_) {
    begin(now_ns);
  }
}

// A position that is followed stays so, if there is no gap in the replies.
void MoteusCanFd::begin(hal::TimeNs now_ns) {
  if (!is_followed_) {
    sample_ = {};
    has_asked_ = false;
    has_replied_ = false;
    encoder_.reset();
  }
  sample_.status = kDeviceNotReady;
  sample_.has_torque = false;
  faults_.clear();
  readings_ = {};
  last_fault_ = 0;
  is_shown_ = true;
  enter(Phase::stopping, now_ns);
}

void MoteusCanFd::enter(Phase phase, hal::TimeNs now_ns) {
  phase_ = phase;
  phase_since_ns_ = now_ns;
  if (phase == Phase::up) {
    sample_.status = kDeviceOk;
    is_followed_ = true;
  }
}

void MoteusCanFd::fail(std::uint32_t status, const Trouble& trouble) {
  phase_ = Phase::failed;
  faults_.latch(status, trouble);
  sample_.status = faults_.status();
  if ((status & kDeviceReferenceLost) != 0 && is_followed_) {
    is_followed_ = false;
    is_proven_ = false;
    is_shown_ = false;
  }
}

void MoteusCanFd::request(hal::TimeNs now_ns, CanOutbox& outbox) {
  watch_deadlines(now_ns);
  is_shown_ = true;  // the sample of this read has the whole status
  const bool is_under_torque = phase_ == Phase::starting || phase_ == Phase::up;
  if (is_under_torque && config_.query == MoteusQuery::before_command) {
    outbox.add(moteus::query(address_));
  }
}

void MoteusCanFd::command(hal::TimeNs now_ns, const AxisCommand& command, CanOutbox& outbox) {
  watch_deadlines(now_ns);
  const bool asks_here = config_.query == MoteusQuery::with_command;
  switch_power(command.power_off, now_ns);
  switch (phase_) {
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
          phase_ == Phase::up ? clamped_torque_Nm(command, config_.max_torque_Nm) : 0.0F;
      outbox.add(
          moteus::torque(address_, torque_Nm, static_cast<float>(config_.watchdog_s), asks_here));
      fed_ns_ = now_ns;
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
  const bool has_power =
      phase_ == Phase::starting || phase_ == Phase::proving || phase_ == Phase::up;
  if (power_off && has_power) {
    enter(Phase::resting, now_ns);
  } else if (!power_off && phase_ == Phase::resting) {
    sample_.status = kDeviceNotReady;
    enter(Phase::stopping, now_ns);
  }
}

void MoteusCanFd::shutdown(CanOutbox& outbox) {
  outbox.add(moteus::torque(address_, 0.0F, static_cast<float>(config_.watchdog_s), false));
  outbox.add(moteus::stop(address_, false));
  phase_ = Phase::off;
  sample_.status |= kDeviceNotReady;
}

bool MoteusCanFd::is_time_to_ask(hal::TimeNs now_ns) {
  if (has_asked_ && !has_replied_ && !has_passed(kAskAgain_s, asked_ns_, now_ns)) {
    return false;
  }
  has_asked_ = true;
  asked_ns_ = now_ns;
  return true;
}

void MoteusCanFd::watch_deadlines(hal::TimeNs now_ns) {
  if (phase_ == Phase::off) {
    return;
  }
  // Times of received frames may be stamped in the future; they count as now.
  phase_since_ns_ = std::min(phase_since_ns_, now_ns);
  reply_ns_ = std::min(reply_ns_, now_ns);
  heard_ns_ = std::min(heard_ns_, now_ns);
  // A servo that restarts is silent for this time.
  if (is_followed_ && has_passed(config_.reply_lost_s, heard_ns_, now_ns)) {
    fail(kGone, {"the servo's replies stopped",
                 "check its power and the bus's cable, then reset and home"});
  } else if (phase_ == Phase::up || (phase_ == Phase::resting && is_followed_)) {
    watch_samples(now_ns);
  } else if (phase_ == Phase::proving) {
    watch_proof(now_ns);
  } else if (phase_ != Phase::failed && phase_ != Phase::resting) {
    watch_bring_up(now_ns);
  }
}

void MoteusCanFd::watch_samples(hal::TimeNs now_ns) {
  if (has_passed(config_.reply_lost_s, reply_ns_, now_ns)) {
    fail(kGone, {"the servo's positions stopped",
                 "check its power, its encoder and the bus's cable, then reset and home"});
  } else if (has_passed(config_.reply_stale_s, reply_ns_, now_ns)) {
    sample_.status |= kDeviceStale;
  }
}

void MoteusCanFd::watch_proof(hal::TimeNs now_ns) {
  if (has_passed(kSilence_s, heard_ns_, now_ns)) {
    fail(kGone, {"no reply comes from the servo while its watchdog is proven",
                 "check its power and the bus's cable, then reset"});
  } else if (has_passed(config_.watchdog_s + kProofMargin_s, fed_ns_, now_ns)) {
    fail(kDeviceDriveFault,
         {"the servo's watchdog does not stop it when commands stop",
          "see that nobody else commands it and update its firmware, or set unproven_watchdog; "
          "then reset"});
  }
}

// Latches the bring-up step that took too long.
void MoteusCanFd::watch_bring_up(hal::TimeNs now_ns) {
  if (!has_passed(config_.bring_up_s, phase_since_ns_, now_ns)) {
    return;
  }
  if (!has_replied_ || has_passed(kSilence_s, heard_ns_, now_ns)) {
    fail(kDeviceLost,
         {"no reply comes from the servo",
          "check its power, the bus's cable, both bit rates, servo id and prefix, then reset"});
  } else if (last_fault_ != 0) {
    fail(kDeviceDriveFault, moteus::fault_trouble(last_fault_));
  } else if (phase_ == Phase::stopping) {
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
      frame.id == moteus::reply_id(address_) && phase_ != Phase::off) {
    take_reply(moteus::read_reply(frame.bytes()), received.time_ns);
  }
}

void MoteusCanFd::take_reply(const moteus::Reply& reply, hal::TimeNs time_ns) {
  has_replied_ = true;
  heard_ns_ = time_ns;
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
  if (is_followed_ && *home_state < readings_.home_state) {
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
  last_fault_ = fault;
  const auto told = static_cast<moteus::Mode>(mode);
  if (is_followed_ && fault != 0 && status_of_fault(fault) == kRestarted) {
    fail(kRestarted, moteus::fault_trouble(fault));
  }
  switch (phase_) {
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
  } else if (phase_ == Phase::up && mode != moteus::Mode::position) {
    fail(mode == moteus::Mode::stopped ? kRestarted : std::uint32_t{kDeviceDriveFault},
         {"the servo left torque control by itself, as one that restarts does",
          "check its supply and who else commands it, then reset and home",
          static_cast<std::uint32_t>(mode)});
  } else if (phase_ == Phase::starting && mode == moteus::Mode::position && encoder_.is_trusted() &&
             !has_passed(config_.reply_stale_s, reply_ns_, time_ns)) {
    enter(is_proven_ || config_.unproven_watchdog ? Phase::up : Phase::proving, time_ns);
  }
}

// Takes a reply during the proof. The silence counts from the last torque frame.
void MoteusCanFd::take_proof(moteus::Mode mode, std::uint8_t fault, hal::TimeNs time_ns) {
  if (mode == moteus::Mode::fault || fault != 0) {
    fail(status_of_fault(fault), moteus::fault_trouble(fault));
  } else if (mode == moteus::Mode::timeout) {
    is_proven_ = true;
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
    if (is_followed_) {
      fail(kMoved, trouble_of(verdict));
    }
    encoder_.reset();
    return;
  }
  reply_ns_ = time_ns;
  if (phase_ == Phase::failed) {
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
