#include "host_tools/emulators/cia402_objects.h"

#include <array>
#include <initializer_list>

namespace tactus::host {

namespace {

// Returns true for the objects that map PDOs.
bool is_mapping(std::uint16_t index) {
  return (index >= 0x1600 && index <= 0x1603) || (index >= 0x1A00 && index <= 0x1A03);
}

}  // namespace

// Objects 1xxx: identity, heartbeats, four PDOs each way with the default identifiers of CiA 301.
void Cia402Objects::define_communication(std::uint8_t node,
                                         std::optional<std::uint8_t> error_behaviour) {
  // 1000 is a servo drive (2) of profile 402 (0x192); 1016 the heartbeats to watch, 1017 the own
  // heartbeat's period in ms, 1018 the identity, 1029 the reaction of the communication state to
  // errors.
  objects_[{0x1000, 0}] = {0x0002'0192, 4, false};
  objects_[{0x1001, 0}] = {0, 1, false};
  objects_[{0x1016, 0}] = {1, 1, false};
  objects_[{0x1016, 1}] = {0, 4, true};
  objects_[{0x1017, 0}] = {0, 2, true};
  objects_[{0x1018, 0}] = {4, 1, false};
  objects_[{0x1029, 0}] = {1, 1, false};
  objects_[{0x1029, 1}] = {error_behaviour.value_or(0), 1, !error_behaviour};
  objects_[{0x1018, 1}] = {0x0000'5441, 4, false};
  // Only the first PDO of each direction is switched on. A received PDO of type 255 takes effect on
  // receipt.
  constexpr std::array<std::uint32_t, 4> kReceiveIds = {0x200, 0x300, 0x400, 0x500};
  constexpr std::array<std::uint32_t, 4> kTransmitIds = {0x180, 0x280, 0x380, 0x480};
  for (std::uint16_t pdo = 0; pdo < 4; ++pdo) {
    const auto at = [pdo](std::uint32_t base) { return static_cast<std::uint16_t>(base + pdo); };
    objects_[{at(0x1400), 1}] = {(pdo == 0 ? 0 : kCia402PdoOff) | (kReceiveIds[pdo] + node), 4,
                                 true};
    objects_[{at(0x1400), 2}] = {255, 1, true};
    objects_[{at(0x1800), 1}] = {(pdo == 0 ? 0 : kCia402PdoOff) | (kTransmitIds[pdo] + node), 4,
                                 true};
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

// Objects 6xxx of the profile: those that are measured are read-only and set by the drive.
//
// - 6502 lists the supported modes, among them cyclic synchronous torque (bit 9).
// - 6072, 60E0 and 60E1 limit the torque, in thousandths of the rated torque; 60B2 is added to it.
// - 60C2 is the interpolation period, 1 * 10^-3 s.
// - 6007 is the reaction to a lost master, 605E to a fault.
void Cia402Objects::define_profile(std::uint32_t rated_torque, std::int16_t torque_offset) {
  for (const auto& [index, size] : std::initializer_list<std::pair<std::uint16_t, std::uint8_t>>{
           {0x603F, 2}, {0x6041, 2}, {0x6061, 1}, {0x6064, 4}, {0x606C, 4}, {0x6077, 2}}) {
    objects_[{index, 0}] = {0, size, false};
  }
  objects_[{0x6502, 0}] = {0x2A5, 4, false};
  objects_[{0x6076, 0}] = {rated_torque, 4, false};
  objects_[{0x6040, 0}] = {0, 2, true};
  objects_[{0x6060, 0}] = {0, 1, true};
  objects_[{0x6071, 0}] = {0, 2, true};
  objects_[{0x6072, 0}] = {1000, 2, true};
  objects_[{0x60E0, 0}] = {1000, 2, true};
  objects_[{0x60E1, 0}] = {1000, 2, true};
  objects_[{0x60B2, 0}] = {static_cast<std::uint16_t>(torque_offset), 2, true};
  objects_[{0x60C2, 0}] = {2, 1, false};
  objects_[{0x60C2, 1}] = {1, 1, true};
  objects_[{0x60C2, 2}] = {0xFD, 1, true};
  objects_[{0x6007, 0}] = {1, 2, true};
  objects_[{0x605E, 0}] = {2, 2, true};
}

const Cia402Objects::Object* Cia402Objects::find(Key key) const {
  const auto found = objects_.find(key);
  return found == objects_.end() ? nullptr : &found->second;
}

std::uint32_t Cia402Objects::value(std::uint16_t index, std::uint8_t sub) const {
  const Object* const object = find({index, sub});
  return object == nullptr ? 0 : object->value;
}

void Cia402Objects::set(std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
  objects_[{index, sub}].value = value;
}

void Cia402Objects::remove(std::uint16_t index, std::uint8_t sub) {
  objects_.erase({index, sub});
}

// Returns the SDO abort code (CiA 301) with which a write ends, 0 if it is permitted:
//
// - 0x06090011: no such subindex; 0x06020000: no such object.
// - 0x06010002: read only; 0x06070010: wrong length.
// - 0x06010000: a mapping may change only while its count is 0.
// - 0x06040041: the object cannot be mapped; 0x06090030: value out of range.
std::uint32_t Cia402Objects::why_not(Key key, std::uint32_t new_value, std::uint32_t size) const {
  const Object* const object = find(key);
  if (object == nullptr) {
    const auto same_index = objects_.lower_bound({key.first, 0});
    const bool known = same_index != objects_.end() && same_index->first.first == key.first;
    return known ? 0x0609'0011 : 0x0602'0000;
  }
  if (!object->writable) {
    return 0x0601'0002;
  }
  if (size != object->size) {
    return 0x0607'0010;
  }
  if (is_mapping(key.first) && key.second > 0 && value(key.first, 0) != 0) {
    return 0x0601'0000;
  }
  if (is_mapping(key.first) && key.second > 0) {
    const Key target{static_cast<std::uint16_t>(new_value >> 16U),
                     static_cast<std::uint8_t>(new_value >> 8U & 0xFFU)};
    return new_value == 0 || objects_.contains(target) ? 0 : 0x0604'0041;
  }
  if (key == Key{0x6060, 0} && new_value != 10 && new_value != 0) {
    return 0x0609'0030;
  }
  return 0;
}

}  // namespace tactus::host
