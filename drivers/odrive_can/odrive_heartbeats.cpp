// The part of ODriveCan that takes the drive's heartbeats, which lead it through the bring-up.
#include <utility>

#include "drivers/common/seconds.h"
#include "drivers/odrive_can/odrive_can.h"
#include "drivers/odrive_can/odrive_errors.h"

namespace tactus::drivers {

namespace {

// The drive may reach closed loop for a moment and leave it again. Two heartbeats must show it, so
// far apart and with no other state between them.
constexpr double kClosedHold_s = 0.15;
// The first heartbeat after a request may still report an earlier procedure.
constexpr std::uint32_t kClosedLoopRefusals = 2;

// The most attempts to prove the watchdog. The other axis of a 0.5 board may clear the error before
// a heartbeat reports it.
constexpr std::uint32_t kMostProofs = 3;

bool is_watchdog(odrive::Generation generation, std::uint32_t error) {
  return generation == odrive::Generation::v0_6 ? odrive::is_watchdog_0_6(error)
                                                : odrive::is_watchdog_0_5(error);
}

bool is_state(const odrive::Heartbeat& heartbeat, odrive::AxisState state) {
  return heartbeat.state == static_cast<std::uint8_t>(state);
}

}  // namespace

void ODriveCan::take_heartbeat(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns) {
  if (known_.is_followed && has_passed(config_.heartbeat_lost_s, heard_.heartbeat_ns, time_ns)) {
    fail(kDeviceLost, {"the drive's heartbeat stopped for a while",
                       "check its power and the bus's cable, then reset"});
  }
  heard_.heartbeat_ns = time_ns;
  const std::uint32_t error_before = std::exchange(session_.last_error, heartbeat.error);
  switch (stage_.phase) {
    case Phase::listening:
      enter(Phase::probing, time_ns);
      return;
    case Phase::settling:
      if (was_sent_before(time_ns) && heartbeat.error == 0 &&
          is_state(heartbeat, odrive::AxisState::idle)) {
        enter(Phase::arming, time_ns);
      }
      return;
    case Phase::arming:
      if (was_sent_before(time_ns)) {
        take_while_arming(heartbeat, time_ns);
      }
      return;
    case Phase::up:
      if (heartbeat.error != 0) {
        fail_by_error(heartbeat.error);
      } else if (!is_state(heartbeat, odrive::AxisState::closed_loop)) {
        session_.wants_explanation = true;
        fail(kDeviceDriveFault | kDeviceReferenceLost,
             {"the drive left closed loop by itself",
              "check its supply, see dump_errors in odrivetool, then reset", heartbeat.state});
      }
      return;
    case Phase::proving:
      take_while_proving(heartbeat, time_ns);
      return;
    case Phase::resting:
      take_while_resting(heartbeat, time_ns);
      return;
    case Phase::failed:
      take_while_failed(heartbeat, error_before);
      return;
    default:
      return;
  }
}

// Takes a heartbeat in the proof: the watchdog has stopped the motor, or something else has.
void ODriveCan::take_while_proving(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns) {
  if (is_state(heartbeat, odrive::AxisState::closed_loop)) {
    return;
  }
  if (is_watchdog(session_.generation, heartbeat.error)) {
    known_.is_proven = true;
    enter(Phase::settling, time_ns);
  } else if (heartbeat.error != 0) {
    fail_by_error(heartbeat.error);
  } else if (session_.proofs < kMostProofs) {
    enter(Phase::settling, time_ns);
  } else {
    fail(kDeviceDriveFault,
         {"the drive left closed loop while its watchdog was to be proven, and does not say why",
          "see dump_errors in odrivetool, then reset"});
  }
}

void ODriveCan::take_while_resting(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns) {
  if (heartbeat.error != 0) {
    fail_by_error(heartbeat.error);
  } else if (!is_state(heartbeat, odrive::AxisState::idle) && was_sent_before(time_ns) &&
             has_passed(config_.heartbeat_lost_s, stage_.begun_ns, time_ns)) {
    fail(kDeviceDriveFault, {"the drive does not go idle", "switch its supply off, then reset"});
  }
}

// Nobody clears the error of a failed drive before clear_faults, so an error that went away is a
// restart.
void ODriveCan::take_while_failed(const odrive::Heartbeat& heartbeat, std::uint32_t error_before) {
  if (heartbeat.error == 0) {
    if (error_before != 0) {
      fail(kDeviceReferenceLost, {});
    }
  } else if (heartbeat.error != error_before) {
    fail_by_error(heartbeat.error);
  }
}

void ODriveCan::take_while_arming(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns) {
  if (heartbeat.error != 0) {
    fail_by_error(heartbeat.error);
    return;
  }
  if (is_state(heartbeat, odrive::AxisState::closed_loop)) {
    if (!known_.is_proven && !config_.unproven_watchdog) {
      enter(Phase::proving, time_ns);
      ++session_.proofs;
      return;
    }
    if (!stage_.is_closed) {
      stage_.is_closed = true;
      stage_.closed_since_ns = time_ns;
    }
    if (has_passed(kClosedHold_s, stage_.closed_since_ns, time_ns) && encoder_.is_trusted() &&
        !has_passed(config_.estimate_stale_s, heard_.estimate_ns, time_ns)) {
      enter(Phase::up, time_ns);
    }
    return;
  }
  stage_.is_closed = false;
  const Trouble refusal = session_.generation == odrive::Generation::v0_6
                              ? odrive::procedure_trouble(heartbeat.procedure_result)
                              : Trouble{};
  stage_.refused_in_a_row = refusal ? stage_.refused_in_a_row + 1 : 0;
  if (stage_.refused_in_a_row >= kClosedLoopRefusals) {
    session_.wants_explanation = true;
    fail(kDeviceDriveFault, refusal);
  }
}

}  // namespace tactus::drivers
