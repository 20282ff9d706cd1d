// The device loop of tactusd: wake to the phase -> take the request -> read, controller, write ->
// publish.
//
// The loop does not allocate, lock or print. It waits only for its phase and for the boards'
// bounded transfers. The program gives it requests and gets its records through LoopHooks.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>

#include "drivers/device.h"
#include "firmware/control/run_tick.h"
#include "firmware/linux/realtime/loop_timing.h"
#include "firmware/linux/realtime/watchdog_output.h"
#include "hal/clock.h"

namespace tactus::firmware {

// The functions through which the program talks to the loop. The loop's thread calls them in every
// tick, in the order has_crashed, stopping, take_request, publish. Each must be bounded and take no
// lock.
//   has_crashed   returns true if a thread beside the loop has crashed; the tick is then a fault,
//                 and the loop ends after it
//   stopping      returns true if the program is to end; the loop then disables and ends
//   take_request  returns the request for this tick; it may set the controller's parameters, and
//                 this tick then uses them
//   publish       gets the finished tick: controller.record() says what it did
template <typename T>
concept LoopHooks = requires(T& hooks, Controller& controller, const LoopTick& tick) {
  { hooks.stopping() } -> std::same_as<bool>;
  { hooks.has_crashed() } -> std::same_as<bool>;
  { hooks.take_request(controller) } -> std::same_as<Request>;
  hooks.publish(controller, tick);
};

// The phase and the end of a loop.
struct LoopConfig {
  // The period and offset of the ticks.
  hal::Phase phase;
  // The number of ticks after which the loop ends at the latest.
  std::uint64_t ticks = std::numeric_limits<std::uint64_t>::max();
};

// The end of a loop: as asked, or in mode `fault`.
enum class LoopEnd : std::uint8_t { ended, faulted };

// Decides after each tick whether the loop goes on.
class LoopCourse {
 public:
  explicit LoopCourse(const LoopConfig& config) : left_(config.ticks) {}

  // Takes the mode after a tick. Returns false if the loop is to end.
  bool goes_on(Mode mode, bool stopping);

 private:
  std::uint64_t left_;
};

// Returns true if the tick shall toggle the watchdog's line.
inline bool is_healthy(Mode mode, const LoopTick& tick) {
  return mode != Mode::fault && !tick.late;
}

// Returns the loop's report to the controller before a tick. `watchdog_driven` says whether the
// previous tick could set the watchdog's line, `has_crashed` whether a thread beside the loop has
// crashed.
LoopReport loop_report(const LoopTick& tick, bool watchdog_driven, bool has_crashed);

// Returns the phase with the period of `rate_hz` and no offset.
hal::Phase loop_phase(double rate_hz);

// The objects that the loop uses beside the device and the hooks. They must outlive it.
struct LoopParts {
  Controller& controller;
  hal::Clock& clock;
  LoopTiming& timing;
  WatchdogOutput& watchdog;
};

// Runs ticks until the hooks or the configuration end it. A fault does not end it: the boards
// switch the motors' power off, and an operator may reset the fault. Returns `faulted` if it ended
// in mode `fault`. The caller must stop the motors afterwards.
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
