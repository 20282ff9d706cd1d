// A board in memory: the functions of hal/bare_metal/board.h that write down what is asked of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "hal/bare_metal/board.h"

namespace tactus::hal {

struct FakeBoard {
  // The calls of the board in the order of time: "off", "on", "latch N", "watchdog N us" and texts
  // between quotes, in which a line end is a slash and a zero a tilde. A latched code is seen when
  // the next thing happens.
  std::string events;
  // The characters that the UART has taken, and those that it has received.
  std::string sent;
  std::deque<char> received;
  bool has_power = false;
  // The ticks that have been fed to the watchdog.
  std::uint64_t fed = 0;
  LatchedStop latched;
  // The UART takes the last one of so many offers; none if it is 0.
  std::uint32_t offers_per_char = 1;
  std::vector<std::uint32_t> stack;
  std::vector<std::byte> device_image;
  std::vector<std::byte> scene_image;
};

// The board's period, and the characters that it says were lost.
inline constexpr std::uint64_t kFakePeriod_ns = 1'000'000;
inline constexpr std::uint32_t kFakeLostChars = 3;

// Returns the one board of this process.
FakeBoard& fake_board();

// Makes the board as after power-up.
void power_up_fake_board();

// The exit code of halt(), which prints the events on stderr and ends the process.
inline constexpr int kHalted = 42;

}  // namespace tactus::hal
