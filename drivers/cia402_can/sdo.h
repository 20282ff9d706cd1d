// Service data objects (CiA 301), expedited: one object of up to 4 bytes, one question at a time.
// Encodes and decodes frames, without input, output or state.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/can_frame.h"

namespace tactus::drivers::canopen {

// The address of an entry in the drive's object dictionary, such as 6072:00.
struct ObjectAddress {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;

  friend constexpr bool operator==(const ObjectAddress&, const ObjectAddress&) = default;
};

// A drive's answer to a read or a write.
struct SdoAnswer {
  enum class Kind : std::uint8_t {
    value,      // to a read
    written,    // to a write
    abort,      // `value` is the abort code
    segmented,  // to a read: longer than 4 bytes, which this client cannot read
    malformed,  // from this drive, but no valid answer
  };

  Kind kind = Kind::malformed;
  ObjectAddress object;
  std::uint32_t value = 0;  // missing bytes are 0
  std::uint8_t size = 0;    // bytes of `value`
};

// The abort codes that change what the driver does.
inline constexpr std::uint32_t kAbortBadCommand = 0x0504'0001;
inline constexpr std::uint32_t kAbortReadOnly = 0x0601'0002;
inline constexpr std::uint32_t kAbortUnsupported = 0x0601'0000;
inline constexpr std::uint32_t kAbortNoObject = 0x0602'0000;
inline constexpr std::uint32_t kAbortNoSubindex = 0x0609'0011;

hal::CanFrame sdo_read(std::uint8_t node, ObjectAddress object);
// Returns a write of 1, 2 or 4 bytes.
hal::CanFrame sdo_write(std::uint8_t node, ObjectAddress object, std::uint32_t value,
                        std::uint8_t size);
hal::CanFrame sdo_abort(std::uint8_t node, ObjectAddress object, std::uint32_t code);

// Returns the answer, or nothing if the frame is no answer of this node.
std::optional<SdoAnswer> sdo_answer_of(const hal::CanFrame& frame, std::uint8_t node);

// Returns the reason of a refusal and a remedy.
std::string_view sdo_abort_words(std::uint32_t code);

}  // namespace tactus::drivers::canopen
