// The numbers in the frames of CANopen (CiA 301), for the emulated CiA 402 drive.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/can_bus.h"

namespace tactus::host {

// Returns the unsigned number of `size` bytes from `at` on, the least significant byte first.
inline std::uint32_t number_at(const hal::CanFrame& frame, std::size_t at, std::size_t size) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size; ++i) {
    number |= std::to_integer<std::uint32_t>(frame.data[at + i]) << (8 * i);
  }
  return number;
}

// Writes the number's lowest `size` bytes from `at` on, the least significant byte first.
inline void write_number(hal::CanFrame& frame, std::size_t at, std::size_t size,
                         std::uint32_t number) {
  for (std::size_t i = 0; i < size; ++i) {
    frame.data[at + i] = static_cast<std::byte>(number >> (8 * i) & 0xFFU);
  }
}

}  // namespace tactus::host
