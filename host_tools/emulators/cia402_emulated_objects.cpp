// The SDO server of an emulated CiA 402 drive (CiA 301), and what reading and writing its objects
// does (CiA 402). It is written from the standards and uses none of the driver's code.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "host_tools/emulators/cia402_emulator.h"
#include "host_tools/emulators/cia402_frame.h"

namespace tactus::host {

namespace {

// Returns the server's reply with up to four bytes of data.
hal::CanFrame sdo_frame(std::uint8_t node, std::uint8_t command, std::uint16_t index,
                        std::uint8_t sub, std::uint32_t data) {
  hal::CanFrame frame{.id = 0x580U + node, .length = 8};
  write_number(frame, 0, 1, command);
  write_number(frame, 1, 2, index);
  write_number(frame, 3, 1, sub);
  write_number(frame, 4, 4, data);
  return frame;
}

}  // namespace

// Command 0x40 reads, 0x2x writes up to four bytes, 0x80 ends a transfer. 0x05040001: "command
// specifier not valid".
void Cia402Emulator::take_sdo(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  const auto key = Key{static_cast<std::uint16_t>(number_at(frame, 1, 2)),
                       static_cast<std::uint8_t>(number_at(frame, 3, 1))};
  const std::uint32_t command = number_at(frame, 0, 1);
  if (command == 0x40) {
    answer_read(now_ns, key);
  } else if ((command & 0xE2U) == 0x22) {
    answer_write(now_ns, frame, key);
  } else if (command != 0x80) {
    abort_sdo(now_ns, key, 0x0504'0001);
  }
}

void Cia402Emulator::answer_read(hal::TimeNs now_ns, Key key) {
  const Cia402Objects::Object* const found = objects_.find(key);
  if (found == nullptr) {
    abort_sdo(now_ns, key, objects_.why_not(key, 0, 0));
    return;
  }
  // The reply to a read tells the size in its command byte.
  constexpr std::array<std::uint8_t, 5> kAnswerOfSize = {0, 0x4F, 0x4B, 0x47, 0x43};
  send(now_ns,
       sdo_frame(config_.node, kAnswerOfSize.at(found->size), key.first, key.second, found->value));
}

void Cia402Emulator::answer_write(hal::TimeNs now_ns, const hal::CanFrame& frame, Key key) {
  const std::uint32_t command = number_at(frame, 0, 1);
  // Bit 0 says that the size is given; bits 2 and 3 then are the number of unused bytes of the
  // four.
  const std::uint32_t size = (command & 0x01U) != 0 ? 4U - (command >> 2U & 3U) : 4U;
  const std::uint32_t refused = write_object(key, number_at(frame, 4, size), size);
  if (refused != 0) {
    abort_sdo(now_ns, key, refused);
  } else {
    send(now_ns, sdo_frame(config_.node, 0x60, key.first, key.second, 0));
  }
}

void Cia402Emulator::abort_sdo(hal::TimeNs now_ns, Key key, std::uint32_t code) {
  send(now_ns, sdo_frame(config_.node, 0x80, key.first, key.second, code));
}

std::uint32_t Cia402Emulator::write_object(Key key, std::uint32_t value, std::uint32_t size) {
  const std::uint32_t refused = objects_.why_not(key, value, size);
  if (refused != 0) {
    return refused;
  }
  objects_.set(key.first, key.second, value);
  if (key == Key{0x6040, 0}) {
    step_power(static_cast<std::uint16_t>(value));
  } else if (key == Key{0x6060, 0}) {
    objects_.set(0x6061, 0, value);
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
  const bool reset_edge = (controlword & 0x80U) != 0 && (stage_.controlword & 0x80U) == 0;
  stage_.controlword = controlword;
  if (stage_.state == Power::fault) {
    if (reset_edge && !stage_.fault_persists) {
      stage_.state = Power::switch_on_disabled;
      objects_.set(0x603F, 0, 0);
      objects_.set(0x1001, 0, 0);
    }
    return;
  }
  const std::uint32_t low = controlword & 0x0FU;
  if ((low & 0x02U) == 0 || lacks_supply()) {
    stage_.state = Power::switch_on_disabled;
  } else if ((low & 0x04U) == 0) {
    stage_.state =
        stage_.state == Power::operation_enabled ? Power::quick_stop : Power::switch_on_disabled;
  } else if (stage_.state == Power::quick_stop) {
    return;
  } else if ((low & 0x01U) == 0) {
    stage_.state = Power::ready_to_switch_on;
  } else if (stage_.state == Power::ready_to_switch_on) {
    stage_.state = Power::switched_on;
  } else if (stage_.state == Power::switched_on || stage_.state == Power::operation_enabled) {
    stage_.state = (low & 0x08U) != 0 ? Power::operation_enabled : Power::switched_on;
  }
}

// The state's bits, and: 4 voltage enabled, 9 remote, 11 internal limit active, 12 follows the
// command.
std::uint16_t Cia402Emulator::statusword() const {
  constexpr std::array<std::uint16_t, 6> kOfPower = {0x40, 0x21, 0x23, 0x27, 0x07, 0x08};
  std::uint32_t word = kOfPower.at(static_cast<std::size_t>(stage_.state)) | 0x0200U;
  word |= stage_.has_supply ? 0x0010U : 0U;
  word |= is_limited() ? 0x0800U : 0U;
  word |=
      stage_.state == Power::operation_enabled && network_.state == Nmt::operational ? 0x1000U : 0U;
  return static_cast<std::uint16_t>(word);
}

bool Cia402Emulator::lacks_supply() const {
  return !stage_.has_supply && !config_.stays_enabled_unsupplied;
}

void Cia402Emulator::refresh_measured() {
  if (lacks_supply() && stage_.state != Power::fault) {
    stage_.state = Power::switch_on_disabled;
  }
  const double counts_per_rad = config_.counts_per_turn / (2.0 * std::numbers::pi);
  // Both terms are rounded by themselves, so that forgotten turns are whole counts.
  const auto count = encoder_.first_count + std::llround(counts_per_rad * shaft().position_rad) -
                     std::llround(config_.counts_per_turn * encoder_.forgotten_turns);
  const auto speed = std::llround(counts_per_rad * shaft().velocity_rad_per_s);
  objects_.set(0x6064, 0, static_cast<std::uint32_t>(count));
  objects_.set(0x606C, 0, static_cast<std::uint32_t>(speed));
  objects_.set(0x6077, 0, static_cast<std::uint32_t>(std::lround(torque_units())) & 0xFFFFU);
  objects_.set(0x6041, 0, statusword());
}

// Returns the torque in thousandths of the rated torque, as 6077 reports it: target plus offset,
// within the limits of 6072, 60E0 and 60E1.
double Cia402Emulator::torque_units() const {
  const bool is_heard = network_.state == Nmt::operational || config_.keeps_power_unheard;
  if (!is_heard || !stage_.has_supply || stage_.state != Power::operation_enabled ||
      objects_.value(0x6061, 0) != 10) {
    return 0.0;
  }
  const double wanted = static_cast<double>(static_cast<std::int16_t>(objects_.value(0x6071, 0))) +
                        static_cast<double>(static_cast<std::int16_t>(objects_.value(0x60B2, 0)));
  const double most = objects_.value(0x6072, 0);
  return std::clamp(wanted, -std::min<double>(most, objects_.value(0x60E1, 0)),
                    std::min<double>(most, objects_.value(0x60E0, 0)));
}

bool Cia402Emulator::is_limited() const {
  const double wanted = static_cast<std::int16_t>(objects_.value(0x6071, 0));
  return wanted > std::min(objects_.value(0x6072, 0), objects_.value(0x60E0, 0)) ||
         -wanted > std::min(objects_.value(0x6072, 0), objects_.value(0x60E1, 0));
}

}  // namespace tactus::host
