// A board in memory: the functions of hal/bare_metal/board.h that write down what is asked of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hal/bare_metal/board.h"

namespace tactus::hal {

struct FakeBoard {
  // The calls of the board in the order of time: "off", "on", "latch N", "watchdog N us" and texts
  // between quotes, in which a line end is a slash. A latched code is seen when the next thing
  // happens.
  std::string events;
  LatchedStop latched;
  // The UART takes the last one of so many offers; none if it is 0.
  std::uint32_t offers_per_char = 1;
  std::vector<std::uint32_t> stack;
  std::vector<std::byte> device_image;
  std::vector<std::byte> scene_image;
};

// Returns the one board of this process.
FakeBoard& fake_board();

// Makes the board as after power-up.
void power_up_fake_board();

// The exit code of halt(), which prints the events on stderr and ends the process.
inline constexpr int kHalted = 42;

}  // namespace tactus::hal
