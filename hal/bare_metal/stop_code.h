// The reasons why a program on a bare board has stopped. The numbers are stable: a code never gets
// a new meaning. Constants; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::hal {

// The codes from `watchdog` to `interrupt` come from a handler that found the program broken, and
// `device_image` to `scene` from the start.
enum class StopCode : std::uint32_t {
  none = 0,
  watchdog = 1,          // no tick came to its end in time
  stack_overflow = 2,    // the stack reached the region under it
  memory_access = 3,     // the MPU refused another access
  bus = 4,               // there is no memory at an address, or it did not answer
  instruction = 5,       // the processor cannot execute an instruction
  hard_fault = 6,        // a fault within a fault
  interrupt = 7,         // an interrupt that the program never asked for
  broken_invariant = 8,  // a place in the program that cannot be reached
  scene_image = 9,       // the scene image was refused
  device_image = 10,     // the device image was refused
  configuration = 11,    // the controller refused the device's configuration
  scene = 12,            // the controller refused the scene
};

inline constexpr std::array<std::string_view, 13> kStopNames = {
    "none",         "watchdog",      "stack_overflow", "memory_access",    "bus",
    "instruction",  "hard_fault",    "interrupt",      "broken_invariant", "scene_image",
    "device_image", "configuration", "scene"};

// Returns the name of a code, or "unknown" for a number that is none.
constexpr std::string_view stop_name(StopCode code) {
  const auto number = static_cast<std::size_t>(code);
  return number < kStopNames.size() ? kStopNames[number] : "unknown";
}

// A stop that stays in memory over a restart. After power-up the memory has any content.
struct LatchedStop {
  StopCode code = StopCode::none;
  // The complement of the code, which shows that the code was written.
  std::uint32_t complement = 0;
  // The address of the instruction that was interrupted; 0 if it is not known.
  std::uint32_t address = 0;
};

// Returns the code that is latched there; `none` if there is none.
constexpr StopCode latched_code(const LatchedStop& stop) {
  return stop.complement == ~static_cast<std::uint32_t>(stop.code) ? stop.code : StopCode::none;
}

// Latches a code, unless one is there already: the first one is the cause of those that follow.
constexpr void latch(StopCode code, std::uint32_t address, LatchedStop& stop) {
  if (latched_code(stop) == StopCode::none) {
    stop = {.code = code, .complement = ~static_cast<std::uint32_t>(code), .address = address};
  }
}

}  // namespace tactus::hal
