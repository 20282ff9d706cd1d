#include "drivers/cia402_can/cia402_can.h"

#include <algorithm>
#include <array>

#include "drivers/common/seconds.h"

namespace tactus::drivers {

Cia402Can::Cia402Can(const Cia402Config& config)
    : config_(config), objects_(config), sample_(config) {}

std::size_t Cia402Can::filters(std::span<hal::CanFilter> filters) const {
  constexpr std::array kServices = {canopen::kTransmitPdo1, canopen::kTransmitPdo2,
                                    canopen::kEmergency, canopen::kSdoAnswer, canopen::kHeartbeat};
  std::ranges::transform(kServices, filters.begin(), [this](std::uint32_t service) {
    return hal::CanFilter::standard(service + config_.node);
  });
  return kServices.size();
}

void Cia402Can::start(hal::TimeNs now_ns) {
  sample_.forget();
  host_heartbeat_.restart();
  known_.is_followed = false;
  begin(now_ns);
}

// A loss of the reference stays until a read has reported it.
void Cia402Can::clear_faults(hal::TimeNs now_ns) {
  if (faults_ && !faults_.is_held()) {
    begin(now_ns);
  }
}

void Cia402Can::begin(hal::TimeNs now_ns) {
  tick_ = {.now_ns = now_ns, .sync_ns = tick_.sync_ns};
  session_ = {.begun_ns = now_ns};
  reports_ = {.heartbeat_ns = reports_.heartbeat_ns};
  faults_.clear();
  known_.is_proven = known_.is_proven && known_.is_followed;
  sample_.forget_torque();
  objects_ = cia402::DriveObjects(config_);
  enter(Phase::booting);
}

void Cia402Can::enter(Phase phase) {
  stage_ = {.phase = phase, .begun_ns = tick_.now_ns};
  known_.is_followed = known_.is_followed || phase == Phase::ready;
  update_status();
}

bool Cia402Can::has_passed_since(hal::TimeNs since_ns, double time_s) const {
  return has_passed(time_s, since_ns, tick_.now_ns);
}

void Cia402Can::latch(DeviceStatus bit, const Trouble& trouble) {
  faults_.latch(bit, trouble);
  sample_.drop_torque();
  update_status();
}

// Latches the loss only if the joint may have a reference: from the time that the drive was ready
// and as long as its position was followed.
void Cia402Can::lose_reference(DeviceStatus bit, const Trouble& trouble) {
  if (known_.is_followed) {
    known_.is_followed = false;
    faults_.hold();
    faults_.latch(kDeviceReferenceLost, trouble);
  }
  latch(bit, trouble);
}

void Cia402Can::update_status() {
  sample_.set_status(faults_.status() |
                     (stage_.phase == Phase::ready || faults_ ? kDeviceOk : kDeviceNotReady));
}

void Cia402Can::shutdown(CanOutbox& outbox) {
  if (stage_.phase == Phase::off) {
    return;
  }
  known_.is_followed = false;
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
