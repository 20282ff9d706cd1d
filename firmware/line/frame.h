// Frames on a serial line that also carries lines of text: a zero, the message and its CRC-32 by
// COBS (Cheshire and Baker, "Consistent Overhead Byte Stuffing", IEEE/ACM Transactions on
// Networking 7(2), 1999), a zero. COBS leaves no zero inside, so a reader that has lost bytes finds
// the next frame. A text has no zero either, and its second character is none that begins a
// message. So a text may follow a zero without a frame.
//
// One thread; bounded work for each byte, real time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/telemetry/crc32.h"

namespace tactus::firmware {

// The byte before and after each frame.
inline constexpr std::byte kFrameEnd{0};
// The bytes of the CRC-32 behind a message, the least significant first.
inline constexpr std::size_t kCrcBytes = 4;
// The largest message. No message of message.h is larger.
inline constexpr std::size_t kMaxMessage = 1024;
// The bytes that COBS puts into one block at most, besides the byte that says how many.
inline constexpr std::size_t kCobsBlock = 254;

// Returns true for a byte that can begin a message: a control character that no line of text has.
constexpr bool begins_message(std::byte byte) {
  return byte > std::byte{0} && byte < std::byte{' '} && byte != std::byte{'\t'} &&
         byte != std::byte{'\n'} && byte != std::byte{'\r'};
}

// Returns the largest number of bytes that a frame of a message of that size takes on the line.
constexpr std::size_t most_frame_bytes(std::size_t message_bytes) {
  const std::size_t plain = message_bytes + kCrcBytes;
  return plain + plain / kCobsBlock + 1 + 2;
}
inline constexpr std::size_t kMaxFrame = most_frame_bytes(kMaxMessage);

// Calls put(byte) for each byte that COBS makes of `plain`, without a zero before or behind.
// `byte_at(i)` is byte i of `size`.
template <class ByteAt, class Put>
void put_cobs(std::size_t size, ByteAt&& byte_at, Put&& put) {
  std::size_t begin = 0;
  for (;;) {
    const std::size_t most = std::min(size - begin, kCobsBlock);
    std::size_t count = 0;
    while (count < most && byte_at(begin + count) != std::byte{0}) {
      ++count;
    }
    put(static_cast<std::byte>(count + 1));
    for (std::size_t i = 0; i < count; ++i) {
      put(byte_at(begin + i));
    }
    begin += count;
    if (begin == size) {
      return;
    }
    // A full block stands for no zero; a shorter one stands for the zero that ended it.
    if (count < kCobsBlock) {
      ++begin;
    }
  }
}

// Calls put(byte) for each byte of the message's frame, its two zeros included. The message is not
// empty, and its first byte satisfies begins_message.
template <class Put>
void put_frame(std::span<const std::byte> message, Put&& put) {
  const std::uint32_t crc = crc32(message);
  const auto byte_at = [&](std::size_t i) {
    return i < message.size() ? message[i]
                              : static_cast<std::byte>(crc >> (8U * (i - message.size())));
  };
  put(kFrameEnd);
  put_cobs(message.size() + kCrcBytes, byte_at, put);
  put(kFrameEnd);
}

// The result of a byte. Both views are valid until the next byte.
struct Heard {
  // A message whose checksum is right; empty if the byte has completed none.
  std::span<const std::byte> message;
  // Characters of text, at most two.
  std::string_view text;
};

// Takes the bytes of a line one by one, and finds frames and text. Bytes of a broken frame are
// left out and counted.
class FrameReader {
 public:
  // Takes the next byte of the line.
  Heard take(std::byte byte);

  // Returns the number of frames that were left out: their bytes were no COBS, the checksum was
  // wrong, or they were too long. Bytes that are lost or added in a frame leave out one or two.
  [[nodiscard]] std::uint32_t broken() const { return broken_; }

 private:
  // The meaning of the next byte that is not a zero. `text` needs no zero before it.
  enum class Place : std::uint8_t { text, first, second, inside, skipping };

  // Takes the zero at the end of a frame.
  Heard end();
  // Takes a byte within a frame.
  void take_inside(std::byte byte);
  void add(std::byte byte);

  // The message so far, and its checksum.
  std::array<std::byte, kMaxMessage + kCrcBytes> room_{};
  std::size_t size_ = 0;
  // The bytes of the block that are still to come, and if a zero follows them.
  std::size_t left_ = 0;
  bool zero_follows_ = false;
  Place place_ = Place::text;
  std::array<char, 2> text_{};
  std::uint32_t broken_ = 0;
};

}  // namespace tactus::firmware
