// Reads and writes numbers in the payload of a frame, least significant byte first.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>

namespace tactus::drivers {

static_assert(std::endian::native == std::endian::little);

// These read or write the number at byte `at`. The caller has checked that it fits.
template <class T>
T load_little_endian(std::span<const std::byte> bytes, std::size_t at) {
  std::array<std::byte, sizeof(T)> raw;
  std::ranges::copy(bytes.subspan(at, sizeof(T)), raw.begin());
  return std::bit_cast<T>(raw);
}

template <class T>
void store_little_endian(T value, std::span<std::byte> bytes, std::size_t at) {
  const auto raw = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
  std::ranges::copy(raw, bytes.subspan(at, sizeof(T)).begin());
}

}  // namespace tactus::drivers
