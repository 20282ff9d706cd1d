#include "host_tools/emulators/cia402_emulator.h"

#include <array>
#include <initializer_list>
#include <numbers>

namespace tactus::host {

namespace {

constexpr hal::TimeNs kMs = 1'000'000;
// Error codes of CiA 301 and 402, and the bit of a PDO's identifier that switches it off.
constexpr std::uint16_t kOverCurrent = 0x2310;
constexpr std::uint16_t kHeartbeatError = 0x8130;
constexpr std::uint16_t kPdoTooShort = 0x8210;
constexpr std::uint32_t kPdoOff = 0x8000'0000;

// Returns the unsigned number of `size` bytes from `at` on, the least significant byte first.
std::uint32_t number_at(const hal::CanFrame& frame, std::size_t at, std::size_t size) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size; ++i) {
    number |= std::to_integer<std::uint32_t>(frame.data[at + i]) << (8 * i);
  }
  return number;
}

// Writes the number's lowest `size` bytes from `at` on, the least significant byte first.
void write_number(hal::CanFrame& frame, std::size_t at, std::size_t size, std::uint32_t number) {
  for (std::size_t i = 0; i < size; ++i) {
    frame.data[at + i] = static_cast<std::byte>(number >> (8 * i) & 0xFFU);
  }
}

// The object that an entry of a PDO mapping names, and its size.
struct Mapped {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  std::size_t bytes = 0;
};

// An entry is index, subindex and length in bits: 16, 8 and 8 bits from the top.
Mapped mapped(std::uint32_t entry) {
  return {static_cast<std::uint16_t>(entry >> 16U), static_cast<std::uint8_t>(entry >> 8U & 0xFFU),
          (entry & 0xFFU) / 8U};
}

}  // namespace

Cia402Emulator::Cia402Emulator(hal::CanBus& bus, std::uint32_t seed,
                               const Cia402EmulatorConfig& config)
    : CanEmulator(bus, seed), config_(config), first_count_(config.first_count) {
  define_profile();
  define_communication();
}

// Objects 1xxx: identity, heartbeats, four PDOs each way with the default identifiers of CiA 301.
void Cia402Emulator::define_communication() {
  // 1000 is a servo drive (2) of profile 402 (0x192); 1016 the heartbeats to watch, 1017 the own
  // heartbeat's period in ms, 1018 the identity, 1029 the reaction of the communication state to
  // errors.
  const std::uint32_t node = config_.node;
  objects_[{0x1000, 0}] = {0x0002'0192, 4, false};
  objects_[{0x1001, 0}] = {0, 1, false};
  objects_[{0x1016, 0}] = {1, 1, false};
  objects_[{0x1016, 1}] = {0, 4, true};
  objects_[{0x1017, 0}] = {0, 2, true};
  objects_[{0x1018, 0}] = {4, 1, false};
  objects_[{0x1029, 0}] = {1, 1, false};
  objects_[{0x1029, 1}] = {config_.error_behaviour.value_or(0), 1, !config_.error_behaviour};
  objects_[{0x1018, 1}] = {0x0000'5441, 4, false};
  // Only the first PDO of each direction is switched on. A received PDO of type 255 takes effect on
  // receipt.
  constexpr std::array<std::uint32_t, 4> kReceiveIds = {0x200, 0x300, 0x400, 0x500};
  constexpr std::array<std::uint32_t, 4> kTransmitIds = {0x180, 0x280, 0x380, 0x480};
  for (std::uint16_t pdo = 0; pdo < 4; ++pdo) {
    const auto at = [pdo](std::uint32_t base) { return static_cast<std::uint16_t>(base + pdo); };
    objects_[{at(0x1400), 1}] = {(pdo == 0 ? 0 : kPdoOff) | (kReceiveIds[pdo] + node), 4, true};
    objects_[{at(0x1400), 2}] = {255, 1, true};
    objects_[{at(0x1800), 1}] = {(pdo == 0 ? 0 : kPdoOff) | (kTransmitIds[pdo] + node), 4, true};
    objects_[{at(0x1800), 2}] = {255, 1, true};
    for (std::uint8_t sub = 0; sub <= 8; ++sub) {
      const auto size = static_cast<std::uint8_t>(sub == 0 ? 1 : 4);
      objects_[{at(0x1600), sub}] = {0, size, true};
      objects_[{at(0x1A00), sub}] = {0, size, true};
    }
  }
  // A drive is delivered with the controlword and the statusword mapped, and nothing else.
  objects_[{0x1600, 0}].value = 1;
  objects_[{0x1600, 1}].value = 0x6040'0010;
  objects_[{0x1A00, 0}].value = 1;
  objects_[{0x1A00, 1}].value = 0x6041'0010;
}

// Objects 6xxx of the profile: those that are measured are read-only and set by refresh_measured().
//
// - 6502 lists the supported modes, among them cyclic synchronous torque (bit 9).
// - 6072, 60E0 and 60E1 limit the torque, in thousandths of the rated torque; 60B2 is added to it.
// - 60C2 is the interpolation period, 1 * 10^-3 s.
// - 6007 is the reaction to a lost master, 605E to a fault.
void Cia402Emulator::define_profile() {
  for (const auto& [index, size] : std::initializer_list<std::pair<std::uint16_t, std::uint8_t>>{
           {0x603F, 2}, {0x6041, 2}, {0x6061, 1}, {0x6064, 4}, {0x606C, 4}, {0x6077, 2}}) {
    objects_[{index, 0}] = {0, size, false};
  }
  objects_[{0x6502, 0}] = {0x2A5, 4, false};
  objects_[{0x6076, 0}] = {config_.rated_torque, 4, false};
  objects_[{0x6040, 0}] = {0, 2, true};
  objects_[{0x6060, 0}] = {0, 1, true};
  objects_[{0x6071, 0}] = {0, 2, true};
  objects_[{0x6072, 0}] = {1000, 2, true};
  objects_[{0x60E0, 0}] = {1000, 2, true};
  objects_[{0x60E1, 0}] = {1000, 2, true};
  objects_[{0x60B2, 0}] = {static_cast<std::uint16_t>(config_.torque_offset), 2, true};
  objects_[{0x60C2, 0}] = {2, 1, false};
  objects_[{0x60C2, 1}] = {1, 1, true};
  objects_[{0x60C2, 2}] = {0xFD, 1, true};
  objects_[{0x6007, 0}] = {1, 2, true};
  objects_[{0x605E, 0}] = {2, 2, true};
}

void Cia402Emulator::set_object(std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
  objects_[{index, sub}].value = value;
}

void Cia402Emulator::remove_object(std::uint16_t index, std::uint8_t sub) {
  objects_.erase({index, sub});
}

std::uint32_t Cia402Emulator::object(std::uint16_t index, std::uint8_t sub) const {
  const auto found = objects_.find({index, sub});
  return found == objects_.end() ? 0 : found->second.value;
}

// Power-up: everything is forgotten but what the maker's tool has saved in the configuration.
void Cia402Emulator::get_power(hal::TimeNs now_ns) {
  power_ = Power::switch_on_disabled;
  controlword_ = 0;
  for (const std::uint16_t index :
       std::to_array<std::uint16_t>({0x1001, 0x603F, 0x6040, 0x6060, 0x6061, 0x6071})) {
    set_object(index, 0, 0);
  }
  first_count_ = config_.first_count;
  forgotten_turns_ =
      turns_forgotten(config_.encoder, shaft().position_rad / (2.0 * std::numbers::pi));
  reset(now_ns);
}

void Cia402Emulator::reset(hal::TimeNs now_ns) {
  leave_operational();
  define_communication();
  received_ = {};
  syncs_ = {};
  heard_master_ns_.reset();
  nmt_ = Nmt::booting;
  boots_ns_ = now_ns + config_.boot_time_ns;
}

void Cia402Emulator::leave_operational() {
  nmt_ = Nmt::pre_operational;
  if (power_ != Power::fault && !config_.keeps_power_unheard) {
    power_ = Power::switch_on_disabled;
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
  if (nmt_ == Nmt::booting) {
    return;
  }
  const std::uint32_t master = object(0x1016, 1) >> 16U & 0x7FU;
  if (master != 0 && frame.id == 0x700 + master) {
    heard_master_ns_ = now_ns;
  } else if (frame.id == 0x600U + config_.node && nmt_ != Nmt::stopped && frame.length == 8) {
    take_sdo(now_ns, frame);
  } else if (nmt_ == Nmt::operational) {
    if (frame.id == 0x080) {
      take_sync(now_ns);
    }
    for (std::uint16_t pdo = 0; pdo < 4; ++pdo) {
      if (frame.id == object(static_cast<std::uint16_t>(0x1400 + pdo), 1)) {
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
      nmt_ = nmt_ == Nmt::booting ? Nmt::booting : Nmt::operational;
      return;
    case 0x02:
      leave_operational();
      nmt_ = Nmt::stopped;
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

// Applies the receive PDOs that waited for the SYNC, then samples and sends the transmit PDOs that
// are due: types 1 to 240 are sent with every n-th SYNC.
void Cia402Emulator::take_sync(hal::TimeNs now_ns) {
  for (std::size_t pdo = 0; pdo < received_.size(); ++pdo) {
    if (received_[pdo].waits) {
      received_[pdo].waits = false;
      apply_pdo(now_ns, pdo, received_[pdo].frame);
    }
  }
  refresh_measured();
  for (std::size_t pdo = 0; pdo < syncs_.size(); ++pdo) {
    const auto communication = static_cast<std::uint16_t>(0x1800 + pdo);
    const std::uint32_t every = object(communication, 2);
    if ((object(communication, 1) & kPdoOff) == 0 && every >= 1 && every <= 240 &&
        ++syncs_[pdo] >= every) {
      syncs_[pdo] = 0;
      send_pdo(now_ns, pdo);
    }
  }
}

// Types 0 to 240 wait for the SYNC; higher ones take effect on receipt.
void Cia402Emulator::take_pdo(hal::TimeNs now_ns, std::size_t pdo, const hal::CanFrame& frame) {
  if (object(static_cast<std::uint16_t>(0x1400 + pdo), 2) <= 240) {
    received_[pdo] = {frame, true};
  } else {
    apply_pdo(now_ns, pdo, frame);
  }
}

void Cia402Emulator::apply_pdo(hal::TimeNs now_ns, std::size_t pdo, const hal::CanFrame& frame) {
  const auto mapping = static_cast<std::uint16_t>(0x1600 + pdo);
  std::size_t at = 0;
  for (std::uint32_t entry = 1; entry <= object(mapping, 0); ++entry) {
    const Mapped to = mapped(object(mapping, static_cast<std::uint8_t>(entry)));
    if (at + to.bytes > frame.length) {
      send_emergency(now_ns, kPdoTooShort);
      return;
    }
    write_object({to.index, to.sub}, number_at(frame, at, to.bytes),
                 static_cast<std::uint32_t>(to.bytes));
    at += to.bytes;
  }
}

void Cia402Emulator::send_pdo(hal::TimeNs now_ns, std::size_t pdo) {
  const auto mapping = static_cast<std::uint16_t>(0x1A00 + pdo);
  hal::CanFrame frame{.id = object(static_cast<std::uint16_t>(0x1800 + pdo), 1) & 0x7FFU};
  std::size_t at = 0;
  for (std::uint32_t entry = 1; entry <= object(mapping, 0); ++entry) {
    const Mapped from = mapped(object(mapping, static_cast<std::uint8_t>(entry)));
    if (at + from.bytes > hal::kMaxCanBytes) {
      break;
    }
    write_number(frame, at, from.bytes, object(from.index, from.sub));
    at += from.bytes;
  }
  frame.length = static_cast<std::uint8_t>(at);
  send(now_ns, frame);
}

void Cia402Emulator::advance(hal::TimeNs now_ns, bool erroring) {
  if (!has_run_ || now_ns - ran_ns_ >= kPowerLoss_ns) {
    has_run_ = true;
    get_power(now_ns);
  }
  ran_ns_ = now_ns;
  if (nmt_ == Nmt::booting && now_ns >= boots_ns_) {
    nmt_ = Nmt::pre_operational;
    beat_ns_ = now_ns;
    hal::CanFrame boot_up{.id = 0x700U + config_.node, .length = 1};
    send(now_ns, boot_up);
  }
  fault_persists_ = erroring;
  if (erroring && power_ != Power::fault && nmt_ != Nmt::booting) {
    raise_fault(now_ns, kOverCurrent);
  }
  watch_master(now_ns);
  beat(now_ns);
  refresh_measured();
  shaft().torque_Nm = 1e-3 * torque_units() * config_.rated_torque_Nm;
}

void Cia402Emulator::watch_master(hal::TimeNs now_ns) {
  const hal::TimeNs limit_ns = (object(0x1016, 1) & 0xFFFFU) * kMs;
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
  switch (object(0x6007, 0)) {
    case 1:
      raise_fault(now_ns, kHeartbeatError);
      break;
    case 2:
      power_ = Power::switch_on_disabled;
      send_emergency(now_ns, kHeartbeatError);
      break;
    case 3:
      power_ = power_ == Power::operation_enabled ? Power::quick_stop : power_;
      send_emergency(now_ns, kHeartbeatError);
      break;
    default:
      send_emergency(now_ns, kHeartbeatError);
      break;
  }
  const std::uint32_t behaviour = object(0x1029, 1);
  if (nmt_ == Nmt::operational && behaviour != 1) {
    leave_operational();
    nmt_ = behaviour == 2 ? Nmt::stopped : Nmt::pre_operational;
  }
}

void Cia402Emulator::beat(hal::TimeNs now_ns) {
  const hal::TimeNs period_ns = object(0x1017, 0) * kMs;
  if (nmt_ == Nmt::booting || period_ns == 0 || now_ns - beat_ns_ < period_ns) {
    return;
  }
  beat_ns_ = now_ns;
  hal::CanFrame frame{.id = 0x700U + config_.node, .length = 1};
  // The state codes of CiA 301: 5 operational, 4 stopped, 0x7F pre-operational.
  const std::uint32_t state = nmt_ == Nmt::operational ? 0x05U
                              : nmt_ == Nmt::stopped   ? 0x04U
                                                       : 0x7FU;
  write_number(frame, 0, 1, state);
  send(now_ns, frame);
}

void Cia402Emulator::send_emergency(hal::TimeNs now_ns, std::uint16_t code) {
  hal::CanFrame frame{.id = 0x080U + config_.node, .length = 8};
  write_number(frame, 0, 2, code);
  write_number(frame, 2, 1, object(0x1001, 0));
  send(now_ns, frame);
}

void Cia402Emulator::raise_fault(hal::TimeNs now_ns, std::uint16_t code, bool tells) {
  power_ = Power::fault;
  set_object(0x603F, 0, code);
  set_object(0x1001, 0, 1);
  if (tells) {
    send_emergency(now_ns, code);
  }
}

}  // namespace tactus::host
