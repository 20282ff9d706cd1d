// The object dictionary of an emulated CiA 402 drive: its SDO server (CiA 301), and what reading
// and writing its objects does (CiA 402). It is written from the standards and uses none of the
// driver's code.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "host_tools/emulators/cia402_emulator.h"

namespace tactus::host {

namespace {

// Returns the unsigned number of `size` bytes from `at` on, the least significant byte first.
std::uint32_t bytes_at(const hal::CanFrame& frame, std::size_t at, std::size_t size) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size; ++i) {
    number += std::to_integer<std::uint32_t>(frame.data[at + i]) << (8 * i);
  }
  return number;
}

// Returns the server's reply with up to four bytes of data.
hal::CanFrame sdo_frame(std::uint8_t node, std::uint8_t command, std::uint16_t index,
                        std::uint8_t sub, std::uint32_t data) {
  hal::CanFrame frame{.id = 0x580U + node, .length = 8};
  frame.data[0] = static_cast<std::byte>(command);
  frame.data[1] = static_cast<std::byte>(index & 0xFFU);
  frame.data[2] = static_cast<std::byte>(index >> 8U);
  frame.data[3] = static_cast<std::byte>(sub);
  for (std::size_t i = 0; i < 4; ++i) {
    frame.data[4 + i] = static_cast<std::byte>(data >> (8 * i) & 0xFFU);
  }
  return frame;
}

// Returns true for the objects that map PDOs.
bool is_mapping(std::uint16_t index) {
  return (index >= 0x1600 && index <= 0x1603) || (index >= 0x1A00 && index <= 0x1A03);
}

}  // namespace

// Command 0x40 reads, 0x2x writes up to four bytes, 0x80 ends a transfer. 0x05040001: "command
// specifier not valid".
void Cia402Emulator::take_sdo(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  const auto key = Key{static_cast<std::uint16_t>(bytes_at(frame, 1, 2)),
                       static_cast<std::uint8_t>(bytes_at(frame, 3, 1))};
  const std::uint32_t command = bytes_at(frame, 0, 1);
  if (command == 0x40) {
    answer_read(now_ns, key);
  } else if ((command & 0xE2U) == 0x22) {
    answer_write(now_ns, frame, key);
  } else if (command != 0x80) {
    abort_sdo(now_ns, key, 0x0504'0001);
  }
}

void Cia402Emulator::answer_read(hal::TimeNs now_ns, Key key) {
  const auto found = objects_.find(key);
  if (found == objects_.end()) {
    abort_sdo(now_ns, key, why_not(key, 0, 0));
    return;
  }
  // The reply to a read tells the size in its command byte.
  constexpr std::array<std::uint8_t, 5> kAnswerOfSize = {0, 0x4F, 0x4B, 0x47, 0x43};
  send(now_ns, sdo_frame(config_.node, kAnswerOfSize.at(found->second.size), key.first, key.second,
                         found->second.value));
}

void Cia402Emulator::answer_write(hal::TimeNs now_ns, const hal::CanFrame& frame, Key key) {
  const std::uint32_t command = bytes_at(frame, 0, 1);
  // Bit 0 says that the size is given; bits 2 and 3 then are the number of unused bytes of the
  // four.
  const std::uint32_t size = (command & 0x01U) != 0 ? 4U - (command >> 2U & 3U) : 4U;
  const std::uint32_t refused = write_object(key, bytes_at(frame, 4, size), size);
  if (refused != 0) {
    abort_sdo(now_ns, key, refused);
  } else {
    send(now_ns, sdo_frame(config_.node, 0x60, key.first, key.second, 0));
  }
}

void Cia402Emulator::abort_sdo(hal::TimeNs now_ns, Key key, std::uint32_t code) {
  send(now_ns, sdo_frame(config_.node, 0x80, key.first, key.second, code));
}

// Returns the SDO abort code (CiA 301) with which a write ends, 0 if it is permitted:
//
// - 0x06090011: no such subindex; 0x06020000: no such object.
// - 0x06010002: read only; 0x06070010: wrong length.
// - 0x06010000: a mapping may change only while its count is 0.
// - 0x06040041: the object cannot be mapped; 0x06090030: value out of range.
std::uint32_t Cia402Emulator::why_not(Key key, std::uint32_t value, std::uint32_t size) const {
  const auto found = objects_.find(key);
  if (found == objects_.end()) {
    const auto same_index = objects_.lower_bound({key.first, 0});
    const bool known = same_index != objects_.end() && same_index->first.first == key.first;
    return known ? 0x0609'0011 : 0x0602'0000;
  }
  if (!found->second.writable) {
    return 0x0601'0002;
  }
  if (size != found->second.size) {
    return 0x0607'0010;
  }
  if (is_mapping(key.first) && key.second > 0 && object(key.first, 0) != 0) {
    return 0x0601'0000;
  }
  if (is_mapping(key.first) && key.second > 0) {
    const Key target{static_cast<std::uint16_t>(value >> 16U),
                     static_cast<std::uint8_t>(value >> 8U & 0xFFU)};
    return value == 0 || objects_.contains(target) ? 0 : 0x0604'0041;
  }
  if (key == Key{0x6060, 0} && value != 10 && value != 0) {
    return 0x0609'0030;
  }
  return 0;
}

std::uint32_t Cia402Emulator::write_object(Key key, std::uint32_t value, std::uint32_t size) {
  const std::uint32_t refused = why_not(key, value, size);
  if (refused != 0) {
    return refused;
  }
  objects_[key].value = value;
  if (key == Key{0x6040, 0}) {
    step_power(static_cast<std::uint16_t>(value));
  } else if (key == Key{0x6060, 0}) {
    set_object(0x6061, 0, value);
  } else if (key == Key{0x1016, 1}) {
    // The drive watches the master from its next heartbeat on.
    heard_master_ns_.reset();
  }
  return 0;
}

// The state machine of CiA 402. Bits of the controlword: 0 switch on, 1 enable voltage, 2 no quick
// stop, 3 enable operation, 7 fault reset (on its rising edge). A transition that the profile does
// not have leaves the state unchanged.
void Cia402Emulator::step_power(std::uint16_t controlword) {
  const bool reset_edge = (controlword & 0x80U) != 0 && (controlword_ & 0x80U) == 0;
  controlword_ = controlword;
  if (power_ == Power::fault) {
    if (reset_edge && !fault_persists_) {
      power_ = Power::switch_on_disabled;
      set_object(0x603F, 0, 0);
      set_object(0x1001, 0, 0);
    }
    return;
  }
  const std::uint32_t low = controlword & 0x0FU;
  if ((low & 0x02U) == 0 || lacks_supply()) {
    power_ = Power::switch_on_disabled;
  } else if ((low & 0x04U) == 0) {
    power_ = power_ == Power::operation_enabled ? Power::quick_stop : Power::switch_on_disabled;
  } else if (power_ == Power::quick_stop) {
    return;
  } else if ((low & 0x01U) == 0) {
    power_ = Power::ready_to_switch_on;
  } else if (power_ == Power::ready_to_switch_on) {
    power_ = Power::switched_on;
  } else if (power_ == Power::switched_on || power_ == Power::operation_enabled) {
    power_ = (low & 0x08U) != 0 ? Power::operation_enabled : Power::switched_on;
  }
}

// The state's bits, and: 4 voltage enabled, 9 remote, 11 internal limit active, 12 follows the
// command.
std::uint16_t Cia402Emulator::statusword() const {
  constexpr std::array<std::uint16_t, 6> kOfPower = {0x40, 0x21, 0x23, 0x27, 0x07, 0x08};
  std::uint32_t word = kOfPower.at(static_cast<std::size_t>(power_)) | 0x0200U;
  word |= motor_power_ ? 0x0010U : 0U;
  word |= is_limited() ? 0x0800U : 0U;
  word |= power_ == Power::operation_enabled && nmt_ == Nmt::operational ? 0x1000U : 0U;
  return static_cast<std::uint16_t>(word);
}

bool Cia402Emulator::lacks_supply() const {
  return !motor_power_ && !config_.stays_enabled_unsupplied;
}

void Cia402Emulator::refresh_measured() {
  if (lacks_supply() && power_ != Power::fault) {
    power_ = Power::switch_on_disabled;
  }
  const double counts_per_rad = config_.counts_per_turn / (2.0 * std::numbers::pi);
  // Both terms are rounded by themselves, so that forgotten turns are whole counts.
  const auto count = first_count_ + std::llround(counts_per_rad * shaft().position_rad) -
                     std::llround(config_.counts_per_turn * forgotten_turns_);
  const auto speed = std::llround(counts_per_rad * shaft().velocity_rad_per_s);
  set_object(0x6064, 0, static_cast<std::uint32_t>(count));
  set_object(0x606C, 0, static_cast<std::uint32_t>(speed));
  set_object(0x6077, 0, static_cast<std::uint32_t>(std::lround(torque_units())) & 0xFFFFU);
  set_object(0x6041, 0, statusword());
}

// Returns the torque in thousandths of the rated torque, as 6077 reports it: target plus offset,
// within the limits of 6072, 60E0 and 60E1.
double Cia402Emulator::torque_units() const {
  const bool is_heard = nmt_ == Nmt::operational || config_.keeps_power_unheard;
  if (!is_heard || !motor_power_ || power_ != Power::operation_enabled || object(0x6061, 0) != 10) {
    return 0.0;
  }
  const double wanted = static_cast<double>(static_cast<std::int16_t>(object(0x6071, 0))) +
                        static_cast<double>(static_cast<std::int16_t>(object(0x60B2, 0)));
  const double most = object(0x6072, 0);
  return std::clamp(wanted, -std::min<double>(most, object(0x60E1, 0)),
                    std::min<double>(most, object(0x60E0, 0)));
}

bool Cia402Emulator::is_limited() const {
  const double wanted = static_cast<std::int16_t>(object(0x6071, 0));
  return wanted > std::min(object(0x6072, 0), object(0x60E0, 0)) ||
         -wanted > std::min(object(0x6072, 0), object(0x60E1, 0));
}

}  // namespace tactus::host
