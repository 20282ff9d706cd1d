// The part of VescCan that brings the VESC up, commands it and watches it. Its messages are taken
// in vesc_receive.cpp.
#include "drivers/vesc_can/vesc_can.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/common/seconds.h"
#include "drivers/vesc_can/vesc_faults.h"

namespace tactus::drivers {

namespace {

constexpr double kCountsPerElectricalTurn = 6.0;
constexpr double kStaleAfter_statuses = 1.5;
constexpr std::uint32_t kUnansweredPolls = 5;
// A VESC checks its timeout at this interval.
constexpr double kTimeoutLook_s = 0.01;
// So many questions may be lost or under way before the VESC reports its timeout.
constexpr double kToldWithin_polls = 4.0;
constexpr double kMilli = 1e3;
constexpr double kLargestCurrent_mA = 1e9;

double rad_per_count(const VescConfig& config) {
  return 2.0 * std::numbers::pi / (kCountsPerElectricalTurn * config.pole_pairs);
}

CountedShaftConfig vesc_shaft(const VescConfig& config) {
  return {.rad_per_count = rad_per_count(config),
          .max_speed_rad_per_s = config.max_speed_rad_per_s,
          .jump_margin_rad = config.jump_margin_rad + 2.0 * rad_per_count(config)};
}

}  // namespace

VescCan::VescCan(const VescConfig& config) : config_(config), shaft_(vesc_shaft(config)) {}

std::size_t VescCan::filters(std::span<hal::CanFilter> filters) const {
  using enum vesc::Packet;
  filters[0] = hal::CanFilter::extended(vesc::id_of(status, config_.vesc_id));
  filters[1] = hal::CanFilter::extended(vesc::id_of(status_4, config_.vesc_id));
  filters[2] = hal::CanFilter::extended(vesc::id_of(status_5, config_.vesc_id));
  filters[3] = hal::CanFilter::extended(vesc::id_of(process_short_buffer, config_.host_id));
  return 4;
}

void VescCan::start(hal::TimeNs now_ns) {
  known_ = {};
  readings_ = {};
  begin(now_ns);
}

void VescCan::clear_faults(hal::TimeNs now_ns) {
  if (faults_) {
    begin(now_ns);
  }
}

void VescCan::begin(hal::TimeNs now_ns) {
  now_ns_ = now_ns;
  faults_.clear();
  if (!known_.is_followed) {
    shaft_.forget();
    sample_ = AxisSample{};
  }
  sample_.has_torque = false;
  heard_ = {.position_ns = heard_.position_ns};
  polls_ = {};
  enter(Phase::looking);
  update_status();
}

void VescCan::enter(Phase phase) {
  stage_ = {.phase = phase, .begun_ns = now_ns_};
}

void VescCan::latch(DeviceStatus bit, const Trouble& trouble) {
  faults_.latch(bit, trouble);
  if (bit == kDeviceLost || bit == kDeviceEncoderFault) {
    may_have_restarted(trouble);
  }
  update_status();
}

// A restarted VESC has another zero of its tachometer, and maybe another timeout.
void VescCan::may_have_restarted(const Trouble& trouble) {
  if (known_.is_followed) {
    faults_.latch(kDeviceReferenceLost, trouble);
  }
  known_ = {};
}

void VescCan::update_status() {
  sample_.status = faults_.status() | (heard_.is_stale ? kDeviceStale : kDeviceOk) |
                   (stage_.phase == Phase::ready || faults_ ? kDeviceOk : kDeviceNotReady);
}

bool VescCan::has_passed_since(hal::TimeNs since_ns, double time_s) const {
  return has_passed(time_s, since_ns, now_ns_);
}

void VescCan::request(hal::TimeNs now_ns, CanOutbox& /*outbox*/) {
  now_ns_ = now_ns;
}

void VescCan::command(hal::TimeNs now_ns, const AxisCommand& command, CanOutbox& outbox) {
  now_ns_ = now_ns;
  if (stage_.phase == Phase::off) {
    return;
  }
  look();
  watch();
  if (stage_.phase == Phase::proving && !faults_) {
    watch_proof();
    poll(outbox);
    return;
  }
  const bool has_power = stage_.phase == Phase::ready && !faults_ && command.enable;
  outbox.add(has_power ? vesc::held_current_frame(
                             config_.vesc_id, current_mA(command.torque_Nm),
                             static_cast<std::int16_t>(std::lround(kMilli * config_.off_delay_s)))
                       : vesc::release_frame(config_.vesc_id));
  poll(outbox);
}

void VescCan::look() {
  if (stage_.phase != Phase::looking || faults_) {
    return;
  }
  const bool is_well = heard_.fault == 0 && heard_.flags == 0 && heard_.has_status &&
                       (heard_.has_position || !config_.offers_position);
  if (is_well && !known_.is_proven && !config_.unproven_watchdog) {
    enter(Phase::proving);
  } else if (is_well) {
    enter(Phase::ready);
    known_.is_followed = config_.offers_position;
    update_status();
  } else if (has_passed_since(stage_.begun_ns, config_.bring_up_s)) {
    const bool is_heard = heard_.has_status || heard_.has_position || heard_.fault.has_value();
    const bool is_killed = (heard_.flags & vesc::kKillSwitch) != 0;
    latch(is_killed ? kDeviceEmergencyStop : (is_heard ? kDeviceDriveFault : kDeviceLost),
          missing());
  }
}

Trouble VescCan::missing() const {
  if (!heard_.has_status && !heard_.fault.has_value()) {
    return {"VESC does not answer", "check its power, id, bit rate, CAN mode and cable, then reset",
            config_.vesc_id};
  }
  if (!heard_.fault.has_value()) {
    return {"VESC does not answer the question for its faults",
            "check that host_id is no VESC's, and the VESC's firmware", config_.host_id};
  }
  if (const Trouble trouble = vesc::fault_trouble(*heard_.fault)) {
    return trouble;
  }
  if (!heard_.has_status) {
    return {"VESC sends no status message 1", "switch it on in VESC Tool, then reset", 1};
  }
  if (config_.offers_position && !heard_.has_position) {
    return {"VESC sends no status message 5, which has the position",
            "switch it on in VESC Tool, or offers_position off, then reset", 5};
  }
  if ((heard_.flags & vesc::kKillSwitch) != 0) {
    return {"VESC's kill switch is open", "make sure that all is well, close it, then reset", 0};
  }
  return {"VESC does not take commands: its timeout has expired",
          "look for another host that commands it, then reset", heard_.flags};
}

// A VESC that goes on without commands is refused: it would keep its torque when the host dies.
void VescCan::watch_proof() {
  const double limit_s =
      config_.watchdog_s + kTimeoutLook_s + kToldWithin_polls * config_.poll_period_s;
  if (has_passed_since(stage_.begun_ns, limit_s)) {
    latch(kDeviceDriveFault,
          {"VESC's timeout does not stop the motor when commands stop coming",
           "set it to watchdog_s in VESC Tool, let no other program command the VESC, then reset; "
           "unproven_watchdog = true does without",
           0});
  }
}

// Watches the position, also after a fault: a VESC that falls silent may lose it unnoticed.
void VescCan::watch_position() {
  if (known_.is_followed && has_passed_since(heard_.position_ns, config_.lost_after_s)) {
    latch(kDeviceLost, {"VESC sends no position any more",
                        "check its power, the cable and its status rates, then reset", 0});
  }
}

void VescCan::watch() {
  watch_position();
  if ((stage_.phase != Phase::ready && stage_.phase != Phase::proving) || faults_) {
    return;
  }
  const hal::TimeNs heard_ns =
      config_.offers_position ? std::min(heard_.status_ns, heard_.position_ns) : heard_.status_ns;
  heard_.is_stale = has_passed_since(heard_ns, kStaleAfter_statuses * config_.status_period_s);
  update_status();
  if (has_passed_since(heard_ns, config_.lost_after_s)) {
    latch(kDeviceLost, {"VESC sends no status any more",
                        "check its power, the cable and its status rates, then reset", 0});
  } else if (polls_.unanswered >= kUnansweredPolls && is_poll_due()) {
    latch(kDeviceLost, {"VESC does not answer the question for its faults any more",
                        "check its power and the cable, then reset", 0});
  }
}

bool VescCan::is_poll_due() const {
  return polls_.timer.is_due(config_.poll_period_s, now_ns_);
}

// Asks for the two fields in turn: only for the fault until that is known, and only for the flags
// during the proof of the timeout.
void VescCan::poll(CanOutbox& outbox) {
  if (!is_poll_due() ||
      !outbox.add(vesc::query_frame(config_.vesc_id, config_.host_id, polls_.next_query))) {
    return;
  }
  polls_.timer.sent(now_ns_);
  ++polls_.unanswered;
  const bool asks_for_flags = stage_.phase == Phase::proving ||
                              (heard_.fault.has_value() && polls_.next_query == vesc::Query::fault);
  polls_.next_query = asks_for_flags ? vesc::Query::flags : vesc::Query::fault;
}

// Returns the current of a torque; zero for NaN. The limit is rounded down, so that rounding cannot
// exceed it.
std::int32_t VescCan::current_mA(double torque_Nm) const {
  const double wanted_mA = kMilli * torque_Nm / config_.torque_constant_Nm_per_A;
  if (!std::isfinite(wanted_mA)) {
    return 0;
  }
  const double limit_mA =
      std::min(std::floor(kMilli * config_.max_torque_Nm / config_.torque_constant_Nm_per_A + 1e-6),
               kLargestCurrent_mA);
  return static_cast<std::int32_t>(std::lround(std::clamp(wanted_mA, -limit_mA, limit_mA)));
}

void VescCan::shutdown(CanOutbox& outbox) {
  if (stage_.phase == Phase::off) {
    return;
  }
  outbox.add(vesc::release_frame(config_.vesc_id));
  enter(Phase::off);
  update_status();
}

}  // namespace tactus::drivers
