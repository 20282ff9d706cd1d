// Encodes and decodes the Falcon's packets of 16 printable bytes, without input or output.
//
// Host to device:  '<', three motor values, flags, 'A', '>'
// Device to host:  '<', three encoder counts, flags, unknown, '>'
//
// A value is a signed 16-bit number in four letters, lowest nibble first, 'A' for 0 to 'P' for 15.
// Motors and encoders come in the order top, right, left, as the user sees the arms. There is no
// checksum: a wrong letter shows only if it is no valid letter, or gives an impossible motion.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>

#include "hal/angle.h"

namespace tactus::drivers {

inline constexpr std::size_t kFalconPacketBytes = 16;
inline constexpr std::size_t kFalconArms = 3;
// The motor value at which Novint's own software saturates.
inline constexpr std::int16_t kFalconMotorLimit = 4095;
// The encoder has 1280 counts a motor turn. The capstan of 14.25 mm runs on an arm arc of 110 mm,
// and the count is zero at 35 degrees.
inline constexpr double kFalconRadPerCount = 2.0 * std::numbers::pi / 1280.0 * (0.01425 / 0.110);
inline constexpr double kFalconZeroRad = hal::radians_of(35.0);

// The lights of the device; true is on.
struct FalconLights {
  bool red = false;
  bool green = false;
  bool blue = false;
};

// The content of a packet to the device. Motor values are in motor units, in the order top, right,
// left.
struct FalconCommand {
  std::array<std::int16_t, kFalconArms> motor{};  // clamped to kFalconMotorLimit when encoded
  FalconLights lights;
  bool homing = true;  // without it the device does not look for its reference
};

// The bits of FalconReply::buttons; the buttons are those of the ball grip.
enum FalconButton : std::uint8_t {
  kFalconButtonRight = 1U << 0,   // plus
  kFalconButtonFront = 1U << 1,   // the middle one at the front
  kFalconButtonCentre = 1U << 2,  // the logo
  kFalconButtonLeft = 1U << 3,    // minus
};

// The content of a packet from the device, in the order top, right, left.
struct FalconReply {
  std::array<std::int16_t, kFalconArms> counts{};
  std::uint8_t buttons = 0;
  std::uint8_t homed = 0;  // bit i: arm i has found its reference

  [[nodiscard]] bool all_homed() const { return homed == 0b111; }
};

using FalconPacket = std::array<std::byte, kFalconPacketBytes>;

FalconPacket encode(const FalconCommand& command);

// Returns nothing unless frame and letters are right. A host's packet decodes as a reply too, with
// its flags as buttons and homed bits.
std::optional<FalconReply> decode_falcon_reply(
    std::span<const std::byte, kFalconPacketBytes> packet);

// Finds packets in the stream of payload bytes, and skips other bytes. The work for each byte is
// bounded.
class FalconPacketReader {
 public:
  // Takes a byte. Returns the packet that it ends, if any.
  std::optional<FalconReply> take(std::byte byte);
  void restart() { size_ = 0; }

  // Returns the number of bytes since the start that belong to no packet.
  [[nodiscard]] std::uint32_t skipped() const { return skipped_; }

 private:
  void skip_to_next_start();

  FalconPacket held_{};
  std::size_t size_ = 0;
  std::uint32_t skipped_ = 0;
};

// Returns the payload of a bulk-in packet of the FTDI chip, behind its two bytes of modem status.
std::span<const std::byte> ftdi_payload(std::span<const std::byte> packet);

}  // namespace tactus::drivers
