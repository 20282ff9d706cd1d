#include "drivers/pivot_can/pivot_can.h"

#include <numbers>

#include "drivers/common/seconds.h"
#include "drivers/common/torque_clamp.h"
#include "drivers/pivot_can/pivot_protocol.h"

namespace tactus::drivers {

PivotCan::PivotCan(const PivotConfig& config)
    : config_(config),
      shaft_({.rad_per_count = 2.0 * std::numbers::pi / config.counts_per_turn,
              .max_speed_rad_per_s = config.max_speed_rad_per_s,
              .jump_margin_rad = 0.05,
              .velocity_filter_s = 0.002}) {}

std::size_t PivotCan::filters(std::span<hal::CanFilter> filters) const {
  filters[0] = hal::CanFilter::standard(pivot::answer_id(config_.node));
  return 1;
}

void PivotCan::start(hal::TimeNs now_ns) {
  is_started_ = true;
  heard_ns_ = now_ns;
  faults_.clear();
  shaft_.forget();
  sample_ = {};
}

void PivotCan::take(const hal::CanReceived& received) {
  const auto counts = pivot::counts_of(received.frame, config_.node);
  if (!is_started_ || received.kind != hal::CanReceived::Kind::frame || !counts) {
    return;
  }
  heard_ns_ = received.time_ns;
  if (!shaft_.take(*counts, received.time_ns)) {
    lose_position(kDeviceEncoderFault,
                  {"the encoder jumped", "check its cable and max_speed_rad_per_s, then reset"});
  }
  if (faults_) {
    return;
  }
  sample_.position_rad = shaft_.position_rad();
  sample_.velocity_rad_per_s = shaft_.velocity_rad_per_s();
  sample_.time_ns = received.time_ns;
  sample_.status = kDeviceOk;
}

void PivotCan::request(hal::TimeNs now_ns, CanOutbox& /*outbox*/) {
  if (is_started_ && has_passed(config_.lost_after_s, heard_ns_, now_ns)) {
    lose_position(kDeviceLost, {"no answer comes from the drive",
                                "check its power, its node and the bus's cable, then reset"});
  }
}

void PivotCan::command(hal::TimeNs /*now_ns*/, const AxisCommand& command,
                       CanOutbox& outbox) const {
  if (is_started_) {
    const bool may_push = sample_.status == kDeviceOk;
    const auto torque_Nm = clamped_torque_Nm(command, config_.max_torque_Nm);
    outbox.add(pivot::command(config_.node, may_push ? static_cast<double>(torque_Nm) : 0.0));
  }
}

void PivotCan::clear_faults(hal::TimeNs now_ns) {
  if (faults_) {
    start(now_ns);
  }
}

void PivotCan::shutdown(CanOutbox& outbox) {
  outbox.add(pivot::command(config_.node, 0.0));
  is_started_ = false;
  sample_.status |= kDeviceNotReady;
}

void PivotCan::lose_position(DeviceStatus bit, const Trouble& trouble) {
  faults_.latch(bit, trouble);
  faults_.latch(kDeviceReferenceLost, trouble);
  sample_.status = faults_.status();
}

}  // namespace tactus::drivers
