// The device loop: wake to the phase -> take the request -> read, controller, write -> publish.
//
// Nothing in it allocates, locks or prints, and it waits for nothing but its phase and the boards'
// bounded transfers. What goes in and out of it passes its hooks.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>

#include "drivers/device.h"
#include "firmware/control/run_tick.h"
#include "firmware/realtime/loop_timing.h"
#include "firmware/realtime/watchdog_output.h"
#include "hal/clock.h"

namespace tactus::firmware {

// The way in and out of the loop, called from its thread once a tick in this order; each bounded,
// without locks:
//   stopping      the program is to end: the loop disables, then leaves
//   has_crashed   something beside the loop has: a fault, after which the loop leaves
//   take_request  what somebody wants of this tick; may set the controller's parameters, which is
//                 then part of this tick
//   publish       the tick is over: controller.record() says what it did
template <typename T>
concept LoopHooks = requires(T& hooks, Controller& controller, const LoopTick& tick) {
  { hooks.stopping() } -> std::same_as<bool>;
  { hooks.has_crashed() } -> std::same_as<bool>;
  { hooks.take_request(controller) } -> std::same_as<Request>;
  hooks.publish(controller, tick);
};

struct LoopConfig {
  hal::Phase phase;
  std::uint64_t ticks =
      std::numeric_limits<std::uint64_t>::max();  // ends after so many, if not before
  // In fault the loop goes on for so many: the boards take the power away and hear what follows.
  std::uint64_t ticks_after_fault = 0;
};

enum class LoopEnd : std::uint8_t { ended, faulted };

// Decides after each tick whether there is a next one.
class LoopCourse {
 public:
  explicit LoopCourse(const LoopConfig& config)
      : left_(config.ticks), ticks_after_fault_(config.ticks_after_fault) {}

  bool goes_on(Mode mode, bool stopping);

 private:
  std::uint64_t left_;
  std::uint64_t ticks_after_fault_;
  std::uint64_t in_fault_ = 0;
};

// Whether a tick deserves the watchdog's edge.
inline bool is_healthy(Mode mode, const LoopTick& tick) {
  return mode != Mode::fault && !tick.late;
}

// What the controller's guards are told of the loop before a tick: of the tick itself, whether the
// tick before could drive the watchdog, and whether something beside the loop has crashed.
LoopReport loop_report(const LoopTick& tick, bool watchdog_driven, bool has_crashed);

// The phase's period for so many ticks a second.
hal::Phase loop_phase(double rate_hz);

// What the loop works with beside the device and its hooks; all outlive it.
struct LoopParts {
  Controller& controller;
  hal::Clock& clock;
  LoopTiming& timing;
  WatchdogOutput& watchdog;
};

// Ends when the hooks or the configuration say so, or after a fault. The motors are the caller's to
// stop.
template <drivers::Device D, LoopHooks Hooks>
LoopEnd run_loop(const LoopConfig& config, const LoopParts& parts, D& device, Hooks& hooks) {
  auto& [controller, clock, timing, watchdog] = parts;
  LoopCourse course(config);
  bool stopping = false;
  bool watchdog_driven = true;
  hal::Wake wake = clock.sleep_until(hal::next_instant_ns(config.phase, clock.now_ns()));
  for (;;) {
    LoopTick tick = timing.woke(wake);
    const bool has_crashed = hooks.has_crashed();
    stopping = stopping || has_crashed || hooks.stopping();
    controller.note_loop(loop_report(tick, watchdog_driven, has_crashed));
    const Request wanted = hooks.take_request(controller);
    const bool disable = stopping && controller.mode() == Mode::active;
    run_tick(controller, device, disable ? Request::disable : wanted);
    watchdog_driven = watchdog.tick(is_healthy(controller.mode(), tick));
    timing.done(tick, controller.record().stage_ns, clock.now_ns());
    hooks.publish(controller, tick);
    if (!course.goes_on(controller.mode(), stopping)) {
      return controller.mode() == Mode::fault ? LoopEnd::faulted : LoopEnd::ended;
    }
    wake = clock.sleep_to_phase(config.phase, wake);
  }
}

}  // namespace tactus::firmware
