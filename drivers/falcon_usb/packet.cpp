#include "drivers/falcon_usb/packet.h"

#include <algorithm>

namespace tactus::drivers {

namespace {

constexpr std::byte kFalconStart{'<'};
constexpr std::byte kFalconEnd{'>'};
constexpr unsigned kFalconLetterZero = 'A';
constexpr std::size_t kFalconFlagsAt = 13;
constexpr std::size_t kFalconUnusedAt = 14;
constexpr std::size_t kFtdiStatusBytes = 2;

// The flags in a host's packet.
constexpr unsigned kFalconHoming = 0x01;
constexpr unsigned kFalconGreen = 0x02;
constexpr unsigned kFalconBlue = 0x04;
constexpr unsigned kFalconRed = 0x08;

constexpr std::byte falcon_letter(unsigned value) {
  return static_cast<std::byte>(kFalconLetterZero + value);
}

unsigned flags_of(const FalconCommand& command) {
  return (command.homing ? kFalconHoming : 0U) | (command.lights.green ? kFalconGreen : 0U) |
         (command.lights.blue ? kFalconBlue : 0U) | (command.lights.red ? kFalconRed : 0U);
}

std::optional<std::int16_t> number_of(std::span<const std::byte, 4> letters) {
  unsigned value = 0;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const unsigned nibble = std::to_integer<unsigned>(letters[i]) - kFalconLetterZero;
    if (nibble > 0xF) {
      return std::nullopt;
    }
    value |= nibble << (4 * i);
  }
  return static_cast<std::int16_t>(value);
}

}  // namespace

FalconPacket encode(const FalconCommand& command) {
  FalconPacket packet;
  packet.front() = kFalconStart;
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    const auto motor =
        std::clamp<std::int16_t>(command.motor[arm], -kFalconMotorLimit, kFalconMotorLimit);
    const auto bits = static_cast<std::uint16_t>(motor);
    for (unsigned nibble = 0; nibble < 4; ++nibble) {
      packet[1 + 4 * arm + nibble] = falcon_letter((bits >> (4U * nibble)) & 0xFU);
    }
  }
  packet[kFalconFlagsAt] = falcon_letter(flags_of(command));
  packet[kFalconUnusedAt] = falcon_letter(0);
  packet.back() = kFalconEnd;
  return packet;
}

std::optional<FalconReply> decode_falcon_reply(
    std::span<const std::byte, kFalconPacketBytes> packet) {
  const unsigned flags = std::to_integer<unsigned>(packet[kFalconFlagsAt]) - kFalconLetterZero;
  if (packet.front() != kFalconStart || packet.back() != kFalconEnd || flags > 0x7F) {
    return std::nullopt;
  }
  FalconReply reply{.counts = {},
                    .buttons = static_cast<std::uint8_t>(flags & 0xFU),
                    .homed = static_cast<std::uint8_t>(flags >> 4U)};
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    const auto counts = number_of(packet.subspan(1 + 4 * arm).first<4>());
    if (!counts) {
      return std::nullopt;
    }
    reply.counts[arm] = *counts;
  }
  return reply;
}

std::optional<FalconReply> FalconPacketReader::take(std::byte byte) {
  if (size_ == 0 && byte != kFalconStart) {
    ++skipped_;
    return std::nullopt;
  }
  held_[size_] = byte;
  ++size_;
  if (size_ < held_.size()) {
    return std::nullopt;
  }
  const auto reply = decode_falcon_reply(held_);
  if (reply) {
    size_ = 0;
  } else {
    skip_to_next_start();
  }
  return reply;
}

void FalconPacketReader::skip_to_next_start() {
  auto* const next = std::find(held_.begin() + 1, held_.end(), kFalconStart);
  skipped_ += static_cast<std::uint32_t>(next - held_.begin());
  size_ = static_cast<std::size_t>(std::move(next, held_.end(), held_.begin()) - held_.begin());
}

std::span<const std::byte> ftdi_payload(std::span<const std::byte> packet) {
  return packet.subspan(std::min(packet.size(), kFtdiStatusBytes));
}

}  // namespace tactus::drivers
