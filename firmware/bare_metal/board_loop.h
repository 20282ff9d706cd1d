// The loop of a program on a bare board. One thread.
#pragma once

#include <cstdint>

#include "firmware/bare_metal/line_queue.h"
#include "firmware/bare_metal/loaded_controller.h"
#include "firmware/bare_metal/powered_device.h"
#include "firmware/bare_metal/session.h"
#include "firmware/bare_metal/tick_load.h"
#include "hal/bare_metal/board.h"

namespace tactus::firmware {

// A tick that has not come to its end within so many periods is hung.
inline constexpr std::uint32_t kWatchdogPeriods = 3;

// Takes the motors' power and tells which board this is. If the program has stopped before and kept
// its power since, it tells that stop and does not return.
void begin(std::string_view board);

// Opens the board's images and starts the controller from them. A refused image is a stop.
void start_or_stop(LoadedController& loaded);

// Tells one of the lines "load".
Line load_line(std::uint64_t ticks, const TickLoad& load, std::uint64_t missed);

// Ticks for ever. `device` must outlive it.
template <drivers::Device D>
[[noreturn]] void run_for_ever(LoadedController& loaded, D& device) {
  static LineQueue lines;
  static TickLoad load;
  Controller& controller = loaded.controller();
  PoweredDevice powered(device);
  Session session(controller, powered);
  const auto tell = [](const Line& line) { lines.push(line.text()); };

  const double rate_hz = loaded.device().controller.rate_hz;
  controller.set_clock(hal::now_ns);
  hal::start_ticks(static_cast<std::uint32_t>(rate_hz));
  hal::start_watchdog(static_cast<std::uint32_t>(kWatchdogPeriods * 1e6 / rate_hz));
  std::uint64_t missed = 0;
  for (std::uint64_t ticks = 1;; ++ticks) {
    const std::uint32_t missed_now = hal::wait_for_tick() - 1;
    missed += missed_now;
    const std::uint64_t began_ns = hal::now_ns();
    session.tick(missed_now, tell);
    const StageTimes& stages = controller.record().stage_ns;
    load.add(static_cast<std::uint32_t>(hal::now_ns() - began_ns) - stages.read - stages.write);
    // The tick is healthy: the controller has counted it.
    if (controller.next_tick() == ticks) {
      hal::feed_watchdog();
    }
    if (is_line_due(controller.record())) {
      tell(load_line(ticks, load, missed));
    }
    lines.pump(hal::put_char);
  }
}

}  // namespace tactus::firmware
