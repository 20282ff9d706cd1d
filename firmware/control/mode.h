// The controller's modes and the table of transitions between them. Constants and pure functions;
// any thread.
//
// Only `active` puts effort on the motors; every other mode commands zero effort and motor power
// off. In `homing` the device finds its own reference, or the user moves it there, while the
// controller waits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::firmware {

// The modes: before homing, while the device finds its reference, without force, with force, and
// stopped. Recordings hold these numbers.
enum class Mode : std::uint8_t { init, homing, ready, active, fault };
// The number of modes, and their names in the order of Mode.
inline constexpr std::size_t kModeCount = 5;
inline constexpr std::array<std::string_view, kModeCount> kModeNames = {"init", "homing", "ready",
                                                                        "active", "fault"};

// The requests of an operator or a program; at most one per tick.
enum class Request : std::uint8_t { none, home, enable, disable, reset, estop };
inline constexpr std::array<std::string_view, 6> kRequestNames = {"none",    "home",  "enable",
                                                                  "disable", "reset", "estop"};

// The events that change the mode. `reset` occurs only if this tick's inputs are healthy; any fault
// causes `fault`, and so does an estop.
enum class Event : std::uint8_t {
  device_ready,
  device_not_ready,
  home,
  enable,
  disable,
  reset,
  fault
};
inline constexpr std::size_t kEventCount = 7;
inline constexpr std::array<std::string_view, kEventCount> kEventNames = {
    "device_ready", "device_not_ready", "home", "enable", "disable", "reset", "fault"};

// The next mode, by present mode (row) and event (column, in the order of Event).
inline constexpr std::array<std::array<Mode, kEventCount>, kModeCount> kTransitions = [] {
  using enum Mode;
  return std::array<std::array<Mode, kEventCount>, kModeCount>{{
      // device_ready, device_not_ready, home, enable, disable, reset, fault
      {init, init, homing, init, init, init, fault},
      {ready, homing, homing, homing, init, homing, fault},
      {ready, init, homing, active, ready, ready, fault},
      {active, fault, active, active, ready, active, fault},
      {fault, fault, fault, fault, fault, init, fault},
  }};
}();

// Returns the mode after the event.
constexpr Mode next_mode(Mode mode, Event event) {
  return kTransitions[static_cast<std::size_t>(mode)][static_cast<std::size_t>(event)];
}

// Returns true in the modes in which the joints' positions have a meaning: from `ready` on.
constexpr bool has_positions(Mode mode) {
  return mode == Mode::ready || mode == Mode::active || mode == Mode::fault;
}

// Returns the request that brings a controller one mode closer to `active`; none from `homing`,
// `active` and `fault`.
constexpr Request request_toward_active(Mode mode) {
  switch (mode) {
    case Mode::init:
      return Request::home;
    case Mode::ready:
      return Request::enable;
    default:
      return Request::none;
  }
}

// Returns the name of a mode for messages, "ready".
constexpr std::string_view mode_name(Mode mode) {
  return kModeNames[static_cast<std::size_t>(mode)];
}

}  // namespace tactus::firmware
