// Computes the CRC-32 of IEEE 802.3 (reflected polynomial 0xEDB88320), which MCAP files and the
// frames of firmware/line contain.
// One thread; no heap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tactus::firmware {

// The checksum of bytes that come in parts.
class Crc32 {
 public:
  // Adds bytes: one table entry a byte (Sarwate 1988).
  void add(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) {
      state_ = (state_ >> 8U) ^ kTable[(state_ ^ std::to_integer<std::uint32_t>(byte)) & 0xFFU];
    }
  }
  // Returns the checksum of the bytes so far.
  [[nodiscard]] std::uint32_t value() const { return ~state_; }

 private:
  // Entry i is the remainder of the byte i, bit by bit.
  static constexpr std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) {
        value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xEDB8'8320U : 0U);
      }
      table[i] = value;
    }
    return table;
  }();

  std::uint32_t state_ = 0xFFFF'FFFFU;
};

// Returns the checksum of the bytes.
inline std::uint32_t crc32(std::span<const std::byte> bytes) {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace tactus::firmware
