#include "host_tools/emulators/cia402_emulator.h"

#include <array>
#include <numbers>

#include "host_tools/emulators/cia402_frame.h"

namespace tactus::host {

namespace {

constexpr hal::TimeNs kMs = 1'000'000;
// Error codes of CiA 301 and 402.
constexpr std::uint16_t kOverCurrent = 0x2310;
constexpr std::uint16_t kHeartbeatError = 0x8130;

}  // namespace

Cia402Emulator::Cia402Emulator(hal::CanBus& bus, std::uint32_t seed,
                               const Cia402EmulatorConfig& config)
    : CanEmulator(bus, seed), config_(config), encoder_{.first_count = config.first_count} {
  objects_.define_profile(config_.rated_torque, config_.torque_offset);
  objects_.define_communication(config_.node, config_.error_behaviour);
}

// Power-up: everything is forgotten but what the maker's tool has saved in the configuration.
void Cia402Emulator::get_power(hal::TimeNs now_ns) {
  stage_.state = Power::switch_on_disabled;
  stage_.controlword = 0;
  for (const std::uint16_t index :
       std::to_array<std::uint16_t>({0x1001, 0x603F, 0x6040, 0x6060, 0x6061, 0x6071})) {
    objects_.set(index, 0, 0);
  }
  encoder_ = {.first_count = config_.first_count,
              .forgotten_turns = turns_forgotten(config_.encoder,
                                                 shaft().position_rad / (2.0 * std::numbers::pi))};
  reset(now_ns);
}

void Cia402Emulator::reset(hal::TimeNs now_ns) {
  leave_operational();
  objects_.define_communication(config_.node, config_.error_behaviour);
  pdos_ = {};
  heard_master_ns_.reset();
  network_.state = Nmt::booting;
  network_.boots_ns = now_ns + config_.boot_time_ns;
}

void Cia402Emulator::leave_operational() {
  network_.state = Nmt::pre_operational;
  if (stage_.state != Power::fault && !config_.keeps_power_unheard) {
    stage_.state = Power::switch_on_disabled;
  }
}

void Cia402Emulator::take(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  if (frame.extended || frame.remote || frame.fd) {
    return;
  }
  if (frame.id == 0x000) {
    take_nmt(now_ns, frame);
    return;
  }
  if (network_.state == Nmt::booting) {
    return;
  }
  const std::uint32_t master = objects_.value(0x1016, 1) >> 16U & 0x7FU;
  if (master != 0 && frame.id == 0x700 + master) {
    heard_master_ns_ = now_ns;
  } else if (frame.id == 0x600U + config_.node && network_.state != Nmt::stopped &&
             frame.length == 8) {
    take_sdo(now_ns, frame);
  } else if (network_.state == Nmt::operational) {
    if (frame.id == 0x080) {
      take_sync(now_ns);
    }
    for (std::uint16_t pdo = 0; pdo < 4; ++pdo) {
      if (frame.id == objects_.value(static_cast<std::uint16_t>(0x1400 + pdo), 1)) {
        take_pdo(now_ns, pdo, frame);
      }
    }
  }
}

void Cia402Emulator::take_nmt(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  const std::uint32_t node = number_at(frame, 1, 1);
  if (frame.length != 2 || (node != 0 && node != config_.node)) {
    return;
  }
  // 1 start, 2 stop, 0x80 pre-operational, 0x81 reset node, 0x82 reset communication.
  switch (number_at(frame, 0, 1)) {
    case 0x01:
      network_.state = network_.state == Nmt::booting ? Nmt::booting : Nmt::operational;
      return;
    case 0x02:
      leave_operational();
      network_.state = Nmt::stopped;
      return;
    case 0x80:
      leave_operational();
      return;
    case 0x81:
      get_power(now_ns);
      return;
    case 0x82:
      reset(now_ns);
      return;
    default:
      return;
  }
}

void Cia402Emulator::advance(const DriveRun& run) {
  const hal::TimeNs now_ns = run.now_ns;
  if (run.is_first() || run.follows_power_loss()) {
    get_power(now_ns);
  }
  if (network_.state == Nmt::booting && now_ns >= network_.boots_ns) {
    network_.state = Nmt::pre_operational;
    network_.beat_ns = now_ns;
    hal::CanFrame boot_up{.id = 0x700U + config_.node, .length = 1};
    send(now_ns, boot_up);
  }
  stage_.fault_persists = run.erroring;
  if (run.erroring && stage_.state != Power::fault && network_.state != Nmt::booting) {
    raise_fault(now_ns, kOverCurrent);
  }
  watch_master(now_ns);
  beat(now_ns);
  refresh_measured();
  shaft().torque_Nm = 1e-3 * torque_units() * config_.rated_torque_Nm;
}

void Cia402Emulator::watch_master(hal::TimeNs now_ns) {
  const hal::TimeNs limit_ns = (objects_.value(0x1016, 1) & 0xFFFFU) * kMs;
  if (!config_.has_watchdog || !heard_master_ns_ || limit_ns == 0 ||
      now_ns - *heard_master_ns_ <= limit_ns + config_.watchdog_lag_ns) {
    return;
  }
  heard_master_ns_.reset();
  abort_connection(now_ns);
}

// Object 6007, the reaction to a lost master: 1 fault, 2 disable voltage, 3 quick stop, else
// nothing. Object 1029 then decides about the communication state.
void Cia402Emulator::abort_connection(hal::TimeNs now_ns) {
  switch (objects_.value(0x6007, 0)) {
    case 1:
      raise_fault(now_ns, kHeartbeatError);
      break;
    case 2:
      stage_.state = Power::switch_on_disabled;
      send_emergency(now_ns, kHeartbeatError);
      break;
    case 3:
      stage_.state = stage_.state == Power::operation_enabled ? Power::quick_stop : stage_.state;
      send_emergency(now_ns, kHeartbeatError);
      break;
    default:
      send_emergency(now_ns, kHeartbeatError);
      break;
  }
  const std::uint32_t behaviour = objects_.value(0x1029, 1);
  if (network_.state == Nmt::operational && behaviour != 1) {
    leave_operational();
    network_.state = behaviour == 2 ? Nmt::stopped : Nmt::pre_operational;
  }
}

void Cia402Emulator::beat(hal::TimeNs now_ns) {
  const hal::TimeNs period_ns = objects_.value(0x1017, 0) * kMs;
  if (network_.state == Nmt::booting || period_ns == 0 || now_ns - network_.beat_ns < period_ns) {
    return;
  }
  network_.beat_ns = now_ns;
  hal::CanFrame frame{.id = 0x700U + config_.node, .length = 1};
  // The state codes of CiA 301: 5 operational, 4 stopped, 0x7F pre-operational.
  const std::uint32_t state = network_.state == Nmt::operational ? 0x05U
                              : network_.state == Nmt::stopped   ? 0x04U
                                                                 : 0x7FU;
  write_number(frame, 0, 1, state);
  send(now_ns, frame);
}

void Cia402Emulator::send_emergency(hal::TimeNs now_ns, std::uint16_t code) {
  hal::CanFrame frame{.id = 0x080U + config_.node, .length = 8};
  write_number(frame, 0, 2, code);
  write_number(frame, 2, 1, objects_.value(0x1001, 0));
  send(now_ns, frame);
}

void Cia402Emulator::raise_fault(hal::TimeNs now_ns, std::uint16_t code, bool tells) {
  stage_.state = Power::fault;
  objects_.set(0x603F, 0, code);
  objects_.set(0x1001, 0, 1);
  if (tells) {
    send_emergency(now_ns, code);
  }
}

}  // namespace tactus::host
