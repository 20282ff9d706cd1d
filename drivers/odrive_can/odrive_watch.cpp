// The part of ODriveCan that watches deadlines and latches faults.

#include <algorithm>

#include "drivers/common/seconds.h"
#include "drivers/odrive_can/odrive_can.h"

namespace tactus::drivers {

namespace {

// After these faults the drive may have restarted, so its zero and its watchdog may differ.
constexpr std::uint32_t kMayHaveRestarted =
    kDeviceLost | kDeviceEncoderFault | kDeviceReferenceLost;
// The drive reports in its next heartbeat that its watchdog has tripped. heartbeat_lost_s is three
// and a half heartbeat periods.
constexpr double kToldWithin_heartbeats_lost = 0.4;
// A reported torque is valid for so many of its periods, and at least for this time.
constexpr double kTorqueHolds_periods = 5.0;
constexpr double kTorqueHolds_s = 0.05;

}  // namespace

void ODriveCan::fail(std::uint32_t status, const Trouble& trouble) {
  if ((status & kMayHaveRestarted) != 0) {
    status &= ~static_cast<std::uint32_t>(kDeviceReferenceLost);
    status |= known_.is_followed ? kDeviceReferenceLost : kDeviceOk;
    known_ = {};
  }
  faults_.latch(status, trouble);
  sample_.status = faults_.status();
  if (stage_.phase != Phase::failed) {
    stage_ = {.phase = Phase::failed, .begun_ns = stage_.begun_ns};
    polls_.next = 0;
    sample_.has_torque = false;
  }
}

void ODriveCan::watch_deadlines(hal::TimeNs now_ns) {
  if (stage_.phase == Phase::off) {
    return;
  }
  // Times of received frames may be stamped in the future; they count as now.
  stage_.begun_ns = std::min(stage_.begun_ns, now_ns);
  heard_.heartbeat_ns = std::min(heard_.heartbeat_ns, now_ns);
  heard_.estimate_ns = std::min(heard_.estimate_ns, now_ns);
  watch_silence(now_ns);
  if (stage_.phase == Phase::up || stage_.phase == Phase::resting) {
    watch_samples(now_ns);
  } else if (stage_.phase == Phase::proving) {
    watch_proof(now_ns);
  } else if (stage_.phase != Phase::failed &&
             has_passed(config_.bring_up_s, stage_.begun_ns, now_ns)) {
    watch_bring_up(now_ns);
  }
}

// Watches for silence, also after a fault: a drive that falls silent may lose its position
// unnoticed.
void ODriveCan::watch_silence(hal::TimeNs now_ns) {
  const bool is_silent = has_passed(config_.heartbeat_lost_s, heard_.heartbeat_ns, now_ns);
  if (stage_.phase != Phase::listening && is_silent) {
    fail(kDeviceLost,
         {"the drive's heartbeat stopped", "check its power and the bus's cable, then reset"});
  } else if (known_.is_followed &&
             has_passed(config_.estimate_lost_s, heard_.estimate_ns, now_ns)) {
    fail(kDeviceLost, {"the drive's position estimates stopped",
                       "check its power and the bus's cable and load, then reset"});
  }
}

void ODriveCan::watch_samples(hal::TimeNs now_ns) {
  if (known_.is_followed && has_passed(config_.estimate_stale_s, heard_.estimate_ns, now_ns)) {
    sample_.status |= kDeviceStale;
  }
  const double torque_holds_s =
      std::max(kTorqueHolds_s, kTorqueHolds_periods * config_.torque_period_s);
  if (has_passed(torque_holds_s, sample_.torque_time_ns, now_ns)) {
    sample_.has_torque = false;
  }
}

// Latches the bring-up step that took too long.
void ODriveCan::watch_bring_up(hal::TimeNs now_ns) {
  if (stage_.phase == Phase::listening) {
    fail(kDeviceLost, {"no heartbeat comes from the drive",
                       "check its power, the bus's cable, bit rate and node id, then reset"});
  } else if (session_.last_error != 0) {
    fail_by_error(session_.last_error);
  } else if (stage_.phase == Phase::settling) {
    fail(kDeviceDriveFault,
         {"the drive does not go idle", "stop its start-up sequence, then reset"});
  } else if (!encoder_.is_trusted() ||
             has_passed(config_.estimate_lost_s, heard_.estimate_ns, now_ns)) {
    fail(kDeviceLost, {"no usable position estimates come from the drive",
                       "set its encoder message rate to 1 ms, or ask for estimates"});
  } else {
    fail(kDeviceDriveFault, {"the drive does not go into closed loop",
                             "calibrate it with odrivetool, save, then reset"});
  }
}

// A drive that goes on without commands is refused: it would keep its torque when the host dies.
void ODriveCan::watch_proof(hal::TimeNs now_ns) {
  const double limit_s =
      config_.watchdog_s + kToldWithin_heartbeats_lost * config_.heartbeat_lost_s;
  if (has_passed(limit_s, stage_.begun_ns, now_ns)) {
    fail(kDeviceDriveFault,
         {"its watchdog does not stop the motor when commands stop coming",
          "set enable_watchdog and watchdog_timeout with odrivetool, let no other program send to "
          "the drive, then reset; unproven_watchdog = true does without"});
  }
}

}  // namespace tactus::drivers
