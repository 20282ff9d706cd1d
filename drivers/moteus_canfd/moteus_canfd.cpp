// The part of MoteusCanFd that brings the servo up, commands it and watches deadlines. Its replies
// are taken in moteus_replies.cpp.
#include "drivers/moteus_canfd/moteus_canfd.h"

#include <algorithm>

#include "drivers/common/seconds.h"
#include "drivers/common/torque_clamp.h"
#include "drivers/moteus_canfd/moteus_errors.h"

namespace tactus::drivers {

namespace {

// The interval of queries to a servo that has not answered yet. More frames would fill the queue
// while nobody acknowledges them.
constexpr double kAskAgain_s = 0.02;
// The longest silence during the bring-up of a servo that has answered.
constexpr double kSilence_s = 0.1;
// A servo that has not stopped so long after its watchdog's time has no watchdog.
constexpr double kProofMargin_s = 0.05;

constexpr std::uint32_t kGone = kDeviceLost | kDeviceReferenceLost;

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

}  // namespace tactus::drivers
