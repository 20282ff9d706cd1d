// The part of VescCan that takes the messages of the VESC.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/common/seconds.h"
#include "drivers/vesc_can/vesc_can.h"
#include "drivers/vesc_can/vesc_faults.h"

namespace tactus::drivers {

namespace {

constexpr double kSecondsPerMinute = 60.0;

}  // namespace

void VescCan::take(const hal::CanReceived& received) {
  if (stage_.phase == Phase::off || received.kind != hal::CanReceived::Kind::frame) {
    return;
  }
  if (const auto status = vesc::status_of(received.frame, config_.vesc_id)) {
    heard_.status_ns = std::max(now_ns_, received.time_ns);
    take_status(*status);
  } else if (const auto status_5 = vesc::status_5_of(received.frame, config_.vesc_id)) {
    take_position(*status_5, received.time_ns);
  } else if (const auto status_4 = vesc::status_4_of(received.frame, config_.vesc_id)) {
    readings_.status_4 = *status_4;
  } else if (const auto answer =
                 vesc::answer_of(received.frame, config_.vesc_id, config_.host_id)) {
    take_answer(*answer);
  }
}

void VescCan::take_status(const vesc::Status& status) {
  const double velocity_rad_per_s =
      2.0 * std::numbers::pi * status.erpm / (kSecondsPerMinute * config_.pole_pairs);
  heard_.has_status = true;
  if (std::abs(velocity_rad_per_s) > config_.max_speed_rad_per_s) {
    latch(kDeviceEncoderFault,
          {"VESC reports a speed that its shaft cannot have",
           "check the motor's sensor and settings, and max_speed_rad_per_s, then reset",
           static_cast<std::uint32_t>(status.erpm)});
    return;
  }
  sample_.velocity_rad_per_s = velocity_rad_per_s;
  // The sign of the current is that of the power: positive when it drives. The sign of the duty is
  // that of the voltage. Together they give the sign of the torque, unless the duty is too small.
  sample_.torque_Nm =
      config_.torque_constant_Nm_per_A * std::copysign(1.0, status.duty) * status.current_A;
  sample_.has_torque = status.duty != 0.0 || status.current_A == 0.0;
  sample_.torque_time_ns = heard_.status_ns;
  heard_.is_stale = false;
  update_status();
}

// A VESC sends its status at its own times, so the position is as old as its frame.
void VescCan::take_position(const vesc::Status5& status, hal::TimeNs received_ns) {
  readings_.input_V = status.input_V;
  if (!config_.offers_position) {
    return;
  }
  const hal::TimeNs taken_ns = std::clamp(received_ns, std::min(sample_.time_ns, now_ns_),
                                          now_ns_ + ns_of(config_.status_period_s));
  if (known_.is_followed && has_passed(config_.lost_after_s, heard_.position_ns, received_ns)) {
    latch(kDeviceLost, {"VESC sent no position for a while",
                        "check its power, the cable and its status rates, then reset", 0});
    return;
  }
  if (!shaft_.take(status.tachometer, taken_ns)) {
    latch(kDeviceEncoderFault,
          {"VESC reports a position that its shaft cannot have reached",
           "check the motor's sensor and settings, and max_speed_rad_per_s, then reset",
           static_cast<std::uint32_t>(status.tachometer)});
    return;
  }
  heard_.has_position = true;
  heard_.position_ns = std::max(now_ns_, received_ns);
  sample_.position_rad = shaft_.position_rad();
  sample_.time_ns = taken_ns;
}

void VescCan::take_answer(const vesc::Answer& answer) {
  polls_.unanswered = 0;
  if (answer.query == vesc::Query::fault) {
    heard_.fault = answer.value;
  } else {
    heard_.flags = answer.value;
  }
  if (stage_.phase == Phase::proving && heard_.flags == vesc::kTimedOut) {
    known_.is_proven = true;
    enter(Phase::looking);
    return;
  }
  if (stage_.phase != Phase::ready && stage_.phase != Phase::proving) {
    return;
  }
  if (const Trouble trouble = vesc::fault_trouble(heard_.fault.value_or(0))) {
    latch(kDeviceDriveFault, trouble);
    if (vesc::loses_reference(*heard_.fault)) {
      may_have_restarted(trouble);
      update_status();
    }
  } else if ((heard_.flags & vesc::kKillSwitch) != 0) {
    latch(kDeviceEmergencyStop,
          {"VESC's kill switch is open", "make sure that all is well, close it, then reset", 0});
  } else if ((heard_.flags & vesc::kTimedOut) != 0) {
    latch(kDeviceDriveFault, {"VESC stopped the motor because commands came too late",
                              "check the cable and the host's load, then reset", 0});
  }
}

}  // namespace tactus::drivers
