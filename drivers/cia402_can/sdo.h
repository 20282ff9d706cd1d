// Service data objects (CiA 301), expedited: one object of up to 4 bytes, one question at a time.
// Bytes to meanings and back; no input or output, no state.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/can_frame.h"

namespace tactus::drivers::canopen {

// An entry of the drive's object dictionary: 6072:00.
struct ObjectAddress {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;

  friend constexpr bool operator==(const ObjectAddress&, const ObjectAddress&) = default;
};

struct SdoAnswer {
  enum class Kind : std::uint8_t {
    value,      // to a read
    written,    // to a write
    abort,      // `value` is the abort code
    segmented,  // to a read: longer than 4 bytes, which this client does not read
    malformed,  // from this drive, but no answer that there is
  };

  Kind kind = Kind::malformed;
  ObjectAddress object;
  std::uint32_t value = 0;  // bytes that the answer does not have are 0
  std::uint8_t size = 0;    // bytes
};

// The abort codes that decide something here.
inline constexpr std::uint32_t kAbortBadCommand = 0x0504'0001;
inline constexpr std::uint32_t kAbortReadOnly = 0x0601'0002;
inline constexpr std::uint32_t kAbortUnsupported = 0x0601'0000;
inline constexpr std::uint32_t kAbortNoObject = 0x0602'0000;
inline constexpr std::uint32_t kAbortNoSubindex = 0x0609'0011;

hal::CanFrame sdo_read(std::uint8_t node, ObjectAddress object);
// size: 1, 2 or 4 bytes.
hal::CanFrame sdo_write(std::uint8_t node, ObjectAddress object, std::uint32_t value,
                        std::uint8_t size);
hal::CanFrame sdo_abort(std::uint8_t node, ObjectAddress object, std::uint32_t code);

// Nothing if it is no answer of this node.
std::optional<SdoAnswer> sdo_answer_of(const hal::CanFrame& frame, std::uint8_t node);

// Why a drive refused, and what to do about it.
std::string_view sdo_abort_words(std::uint32_t code);

}  // namespace tactus::drivers::canopen
