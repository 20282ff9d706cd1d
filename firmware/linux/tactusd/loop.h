// The device loop of tactusd: wake to the phase -> take the requests -> read, controller, write ->
// publish, for all devices of a controller in one tick.
//
// The loop does not allocate, lock or print. It waits only for its phase and for the boards'
// bounded transfers. The program gives it requests and gets its records through LoopHooks.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "drivers/device.h"
#include "firmware/control/run_tick.h"
#include "firmware/linux/realtime/loop_timing.h"
#include "firmware/linux/realtime/watchdog_output.h"
#include "hal/clock.h"
#include "rendering/limits.h"

namespace tactus::firmware {

// The functions through which the program talks to the loop. The loop's thread calls them in every
// tick, in the order has_crashed, stopping, take_requests, publish. Each must be bounded and take
// no lock.
//   has_crashed   returns true if a thread beside the loop has crashed; the tick is then a fault,
//                 and the loop ends after it
//   stopping      returns true if the program is to end; the loop then disables and ends
//   take_requests sets the request of each device for this tick; it may set the controller's
//                 parameters, and this tick then uses them
//   publish       gets the finished tick: controller.record(device) says what it did
template <typename T>
concept LoopHooks =
    requires(T& hooks, Controller& controller, std::span<Request> requests, const LoopTick& tick) {
      { hooks.stopping() } -> std::same_as<bool>;
      { hooks.has_crashed() } -> std::same_as<bool>;
      hooks.take_requests(controller, requests);
      hooks.publish(controller, tick);
    };

// The phase and the end of a loop.
struct LoopConfig {
  // The period and offset of the ticks.
  hal::Phase phase;
  // The number of ticks after which the loop ends at the latest.
  std::uint64_t ticks = std::numeric_limits<std::uint64_t>::max();
};

// The end of a loop: as asked, or with a device in mode `fault`.
enum class LoopEnd : std::uint8_t { ended, faulted };

// Decides after each tick whether the loop goes on.
class LoopCourse {
 public:
  explicit LoopCourse(const LoopConfig& config) : left_(config.ticks) {}

  // Takes whether a device is in mode `active` after a tick. Returns false if the loop is to end.
  bool goes_on(bool is_active, bool stopping);

 private:
  std::uint64_t left_;
};

// Returns true if a device of the controller is in that mode.
bool has_device_in(const Controller& controller, Mode mode);

// Returns true if the tick shall toggle the line of a device's watchdog.
inline bool is_healthy(Mode mode, const LoopTick& tick) {
  return mode != Mode::fault && !tick.late;
}

// Returns the loop's report to the controller before a tick. `watchdog_driven` says whether the
// previous tick could set the watchdogs' lines, `has_crashed` whether a thread beside the loop has
// crashed.
LoopReport loop_report(const LoopTick& tick, bool watchdog_driven, bool has_crashed);

// Returns the phase with the period of `rate_hz` and no offset.
hal::Phase loop_phase(double rate_hz);

// The objects that the loop uses beside the devices and the hooks. They must outlive it.
struct LoopParts {
  Controller& controller;
  hal::Clock& clock;
  LoopTiming& timing;
  // The watchdog of each device.
  std::span<WatchdogOutput* const> watchdogs;
};

// Runs ticks until the hooks or the configuration end it; `devices` and the watchdogs have an entry
// for each device of the controller. A fault does not end it: the boards switch the motors' power
// off, and an operator may reset the fault. Returns `faulted` if it ended with a device in mode
// `fault`. The caller must stop the motors afterwards.
template <drivers::Device D, std::size_t kCount, LoopHooks Hooks>
LoopEnd run_loop(const LoopConfig& config, const LoopParts& parts,
                 std::span<D* const, kCount> devices, Hooks& hooks) {
  const auto& [controller, clock, timing, watchdogs] = parts;
  LoopCourse course(config);
  bool stopping = false;
  bool watchdog_driven = true;
  hal::Wake wake = clock.sleep_until(hal::next_instant_ns(config.phase, clock.now_ns()));
  for (;;) {
    LoopTick tick = timing.woke(wake);
    const bool has_crashed = hooks.has_crashed();
    stopping = stopping || has_crashed || hooks.stopping();
    controller.note_loop(loop_report(tick, watchdog_driven, has_crashed));
    std::array<Request, rendering::kMaxTools> wanted{};
    const auto requests = std::span(wanted).first(controller.device_count());
    hooks.take_requests(controller, requests);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const bool disable = stopping && controller.mode(i) == Mode::active;
      requests[i] = disable ? Request::disable : requests[i];
    }
    run_tick(controller, devices, requests);
    watchdog_driven = true;
    for (std::size_t i = 0; i < watchdogs.size(); ++i) {
      watchdog_driven = watchdogs[i]->tick(is_healthy(controller.mode(i), tick)) && watchdog_driven;
    }
    timing.done(tick, controller.record().stage_ns, clock.now_ns());
    hooks.publish(controller, tick);
    if (!course.goes_on(has_device_in(controller, Mode::active), stopping)) {
      return has_device_in(controller, Mode::fault) ? LoopEnd::faulted : LoopEnd::ended;
    }
    wake = clock.sleep_to_phase(config.phase, wake);
  }
}

}  // namespace tactus::firmware
