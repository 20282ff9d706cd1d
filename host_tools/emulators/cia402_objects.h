// The object dictionary of an emulated CiA 402 drive: which objects it has, their values, and which
// writes it refuses. It is written from the standards (CiA 301 and 402).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace tactus::host {

// The bit of a PDO's identifier that switches the PDO off.
inline constexpr std::uint32_t kCia402PdoOff = 0x8000'0000;

// The objects by index and subindex.
class Cia402Objects {
 public:
  struct Object {
    std::uint32_t value = 0;
    // The size of the value, bytes.
    std::uint8_t size = 0;
    bool writable = false;
  };
  // Index and subindex.
  using Key = std::pair<std::uint16_t, std::uint8_t>;

  // Gives the objects 1xxx their default values. `node` is the drive's number, `error_behaviour`
  // the fixed value of 1029:01; without it that object is 0 and can be written.
  void define_communication(std::uint8_t node, std::optional<std::uint8_t> error_behaviour);
  // Gives the objects 6xxx their default values; those of 6076 and 60B2 are given.
  void define_profile(std::uint32_t rated_torque, std::int16_t torque_offset);

  // Returns an object, null if there is none.
  [[nodiscard]] const Object* find(Key key) const;
  // Returns an object's value, 0 if there is no such object.
  [[nodiscard]] std::uint32_t value(std::uint16_t index, std::uint8_t sub) const;
  // Sets the value of an object; makes a read-only one without size if there is none.
  void set(std::uint16_t index, std::uint8_t sub, std::uint32_t value);
  void remove(std::uint16_t index, std::uint8_t sub);

  // Returns the SDO abort code of a write of `size` bytes, 0 if the write is permitted.
  [[nodiscard]] std::uint32_t why_not(Key key, std::uint32_t new_value, std::uint32_t size) const;

 private:
  std::map<Key, Object> objects_;
};

}  // namespace tactus::host
