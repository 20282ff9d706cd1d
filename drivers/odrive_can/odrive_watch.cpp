// What an ODrive no longer does, or never did: the deadlines of ODriveCan and its faults.

#include <algorithm>

#include "drivers/odrive_can/odrive_can.h"
#include "drivers/seconds.h"

namespace tactus::drivers {

namespace {

// After these the drive may have restarted, with another zero and another watchdog.
constexpr std::uint32_t kMayHaveRestarted =
    kDeviceLost | kDeviceEncoderFault | kDeviceReferenceLost;
// The drive tells that its watchdog has tripped with its next heartbeat. heartbeat_lost_s is three
// and a half of their periods.
constexpr double kToldWithin_heartbeats_lost = 0.4;
// A torque is a report of now for so many of its periods, and for so long at least.
constexpr double kTorqueHolds_periods = 5.0;
constexpr double kTorqueHolds_s = 0.05;

}  // namespace

// A failed axis keeps the words of its first trouble; the status bits of all of them add up.
void ODriveCan::fail(std::uint32_t status, const Trouble& trouble) {
  if ((status & kMayHaveRestarted) != 0) {
    status &= ~static_cast<std::uint32_t>(kDeviceReferenceLost);
    status |= is_followed_ ? kDeviceReferenceLost : kDeviceOk;
    is_followed_ = false;
    is_proven_ = false;
  }
  if (phase_ == Phase::failed) {
    sample_.status |= status | heat_status(trouble);
    return;
  }
  phase_ = Phase::failed;
  has_sent_ = false;
  next_poll_ = 0;
  sample_.status = status | heat_status(trouble);
  sample_.has_torque = false;
  trouble_ = trouble;
}

void ODriveCan::watch_deadlines(hal::TimeNs now_ns) {
  if (phase_ == Phase::off) {
    return;
  }
  // No frame was received in the future, whatever its stamp says.
  phase_since_ns_ = std::min(phase_since_ns_, now_ns);
  heartbeat_ns_ = std::min(heartbeat_ns_, now_ns);
  estimate_ns_ = std::min(estimate_ns_, now_ns);
  watch_silence(now_ns);
  if (phase_ == Phase::up || phase_ == Phase::resting) {
    watch_samples(now_ns);
  } else if (phase_ == Phase::proving) {
    watch_proof(now_ns);
  } else if (phase_ != Phase::failed && has_passed(config_.bring_up_s, phase_since_ns_, now_ns)) {
    watch_bring_up(now_ns);
  }
}

// Also of an axis that has failed: what falls silent may lose its position unseen.
void ODriveCan::watch_silence(hal::TimeNs now_ns) {
  if (phase_ != Phase::listening && has_passed(config_.heartbeat_lost_s, heartbeat_ns_, now_ns)) {
    fail(kDeviceLost,
         {"the drive's heartbeat stopped", "check its power and the bus's cable, then reset"});
  } else if (is_followed_ && has_passed(config_.estimate_lost_s, estimate_ns_, now_ns)) {
    fail(kDeviceLost, {"the drive's position estimates stopped",
                       "check its power and the bus's cable and load, then reset"});
  }
}

void ODriveCan::watch_samples(hal::TimeNs now_ns) {
  if (is_followed_ && has_passed(config_.estimate_stale_s, estimate_ns_, now_ns)) {
    sample_.status |= kDeviceStale;
  }
  const double torque_holds_s =
      std::max(kTorqueHolds_s, kTorqueHolds_periods * config_.torque_period_s);
  if (has_passed(torque_holds_s, torque_ns_, now_ns)) {
    sample_.has_torque = false;
  }
}

// Which step took too long.
void ODriveCan::watch_bring_up(hal::TimeNs now_ns) {
  if (phase_ == Phase::listening) {
    fail(kDeviceLost, {"no heartbeat comes from the drive",
                       "check its power, the bus's cable, bit rate and node id, then reset"});
  } else if (last_error_ != 0) {
    fail_by_error(last_error_);
  } else if (phase_ == Phase::settling) {
    fail(kDeviceDriveFault,
         {"the drive does not go idle", "stop its start-up sequence, then reset"});
  } else if (!encoder_.is_trusted() || has_passed(config_.estimate_lost_s, estimate_ns_, now_ns)) {
    fail(kDeviceLost, {"no usable position estimates come from the drive",
                       "set its encoder message rate to 1 ms, or ask for estimates"});
  } else {
    fail(kDeviceDriveFault, {"the drive does not go into closed loop",
                             "calibrate it with odrivetool, save, then reset"});
  }
}

// A drive that goes on without commands would keep its torque when the host dies.
void ODriveCan::watch_proof(hal::TimeNs now_ns) {
  const double limit_s =
      config_.watchdog_s + kToldWithin_heartbeats_lost * config_.heartbeat_lost_s;
  if (has_passed(limit_s, phase_since_ns_, now_ns)) {
    fail(kDeviceDriveFault,
         {"its watchdog does not stop the motor when commands stop coming",
          "set enable_watchdog and watchdog_timeout with odrivetool, let no other program send to "
          "the drive, then reset; unproven_watchdog = true does without"});
  }
}

}  // namespace tactus::drivers
