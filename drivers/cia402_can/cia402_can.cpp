#include "drivers/cia402_can/cia402_can.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "drivers/common/seconds.h"

namespace tactus::drivers {

namespace {

CountedShaftConfig cia402_shaft(const Cia402Config& config) {
  return {.rad_per_count = 2.0 * std::numbers::pi / config.counts_per_turn,
          .max_speed_rad_per_s = config.max_speed_rad_per_s,
          .jump_margin_rad = config.jump_margin_rad,
          .velocity_filter_s = config.velocity_filter_s};
}

}  // namespace

Cia402Can::Cia402Can(const Cia402Config& config)
    : config_(config),
      sdo_(config.node, ns_of(config.sdo_timeout_s)),
      shaft_(cia402_shaft(config)) {}

std::size_t Cia402Can::filters(std::span<hal::CanFilter> filters) const {
  constexpr std::array kServices = {canopen::kTransmitPdo1, canopen::kTransmitPdo2,
                                    canopen::kEmergency, canopen::kSdoAnswer, canopen::kHeartbeat};
  std::ranges::transform(kServices, filters.begin(), [this](std::uint32_t service) {
    return hal::CanFilter::standard(service + config_.node);
  });
  return kServices.size();
}

void Cia402Can::start(hal::TimeNs now_ns) {
  shaft_.forget();
  sample_ = AxisSample{};
  has_sent_heartbeat_ = false;
  is_followed_ = false;
  begin(now_ns);
}

// A loss of the reference stays until a read has reported it.
void Cia402Can::clear_faults(hal::TimeNs now_ns) {
  if (faults_ && is_shown_) {
    begin(now_ns);
  }
}

void Cia402Can::begin(hal::TimeNs now_ns) {
  now_ns_ = now_ns;
  begun_ns_ = now_ns;
  faults_.clear();
  is_proven_ = is_proven_ && is_followed_;
  is_shown_ = true;
  is_pre_operational_ = false;
  sample_.has_torque = false;
  facts_ = {};
  state_ = {};
  emergency_code_ = 0;
  unanswered_syncs_ = 0;
  is_late_ = false;
  is_cut_off_ = false;
  forget_drive();
  tick_is_over_ = false;
  reads_error_code_ = false;
  enter(Phase::booting);
}

// Forgets what the drive has reported of itself since it was started.
void Cia402Can::forget_drive() {
  sdo_.reset();
  is_operational_ = false;
  has_state_ = false;
  mode_is_set_ = false;
  in_torque_mode_ = false;
  wants_power_ = false;
  had_power_ = false;
}

void Cia402Can::enter(Phase phase) {
  phase_ = phase;
  phase_ns_ = now_ns_;
  has_sent_nmt_ = false;
  has_let_go_ = false;
  was_told_why_ = false;
  step_ = 0;
  is_followed_ = is_followed_ || phase == Phase::ready;
  update_status();
}

bool Cia402Can::has_passed(hal::TimeNs since_ns, double time_s) const {
  return now_ns_ - since_ns >= ns_of(time_s);
}

void Cia402Can::latch(DeviceStatus bit, const Trouble& trouble) {
  faults_.latch(bit, trouble);
  sample_.torque_Nm = 0.0;
  update_status();
}

// Latches the loss only if the joint may have a reference: from the time that the drive was ready
// and as long as its position was followed.
void Cia402Can::lose_reference(DeviceStatus bit, const Trouble& trouble) {
  if (is_followed_) {
    is_followed_ = false;
    is_shown_ = false;
    faults_.latch(kDeviceReferenceLost, trouble);
  }
  latch(bit, trouble);
}

void Cia402Can::update_status() {
  sample_.status =
      faults_.status() | (phase_ == Phase::ready || faults_ ? kDeviceOk : kDeviceNotReady);
}

void Cia402Can::shutdown(CanOutbox& outbox) {
  if (phase_ == Phase::off) {
    return;
  }
  is_followed_ = false;
  // The PDO acts at a SYNC, and no more may come; the SDO acts at once. A drive that is not
  // operational ignores all torques.
  outbox.add(cia402::command_frame(config_.node, {}));
  outbox.add(cia402::disable_voltage_frame(config_.node));
  outbox.add(canopen::nmt_frame(canopen::NmtCommand::enter_pre_operational, config_.node));
  if (config_.leads_bus) {
    outbox.add(canopen::sync_frame());
  }
  enter(Phase::off);
}

}  // namespace tactus::drivers
