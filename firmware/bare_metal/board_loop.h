// The loop of a program on a bare board. One thread.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/bare_metal/host_line.h"
#include "firmware/bare_metal/line_queue.h"
#include "firmware/bare_metal/loaded_controller.h"
#include "firmware/bare_metal/powered_device.h"
#include "firmware/bare_metal/session.h"
#include "firmware/bare_metal/tick_load.h"
#include "hal/bare_metal/board.h"

namespace tactus::firmware {

// A tick that has not come to its end within so many periods is hung.
inline constexpr std::uint32_t kWatchdogPeriods = 3;

// The characters of the host that are taken before a tick at most; more wait for the next one.
inline constexpr int kMostHeardCharacters = 256;

// The loop waits so long with its first tick for a host that asks for ticks, s: a recording that
// begins with the first one can be replayed.
inline constexpr double kHostWait_s = 0.25;

// Takes the motors' power and tells which board this is. If the program has stopped before and kept
// its power since, it tells that stop and does not return.
void begin(std::string_view board);

// Opens the board's images and starts the controller from them. A refused image is a stop.
void start_or_stop(LoadedController& loaded);

// Tells one of the lines "load".
Line load_line(std::uint64_t ticks, const TickLoad& load, std::uint64_t missed);

// The loop of a controller, its device and the line to a host. All of them outlive it.
template <drivers::Device D>
class BoardLoop {
 public:
  BoardLoop(Controller& controller, D& device, const BoardFacts& facts)
      : controller_(controller),
        powered_(device),
        session_(controller, powered_),
        host_(facts),
        rate_hz_(facts.rate_hz) {}

  // Starts the timer, waits for a host for kHostWait_s at most, and starts the watchdog. Call it
  // once.
  void start() {
    controller_.set_clock(hal::now_ns);
    hal::start_ticks(static_cast<std::uint32_t>(rate_hz_));
    wait_for_host();
    hal::start_watchdog(static_cast<std::uint32_t>(kWatchdogPeriods * 1e6 / rate_hz_));
  }

  // Waits for the end of a period, gives characters to the UART until then, and runs a tick.
  void turn() {
    std::uint32_t ended = hal::wait_for_tick();
    while (ended == 0) {
      lines_.pump(hal::put_char);
      ended = hal::wait_for_tick();
    }
    periods_ += ended;
    missed_ += ended - 1;
    hear();
    run(ended - 1);
    if (is_line_due(controller_.record())) {
      tell(load_line(ticks_, load_, missed_));
    }
    host_.after_tick(controller_, times_, hal::lost_chars(), lines_);
    lines_.pump(hal::put_char);
  }

 private:
  void wait_for_host() {
    const auto most = static_cast<std::uint64_t>(kHostWait_s * rate_hz_);
    while (periods_ < most && !host_.wants_ticks()) {
      hear();
      lines_.pump(hal::put_char);
      periods_ += hal::wait_for_tick();
    }
  }

  void tell(const Line& line) { lines_.push(line.text()); }

  void hear() {
    char character = 0;
    for (int i = 0; i < kMostHeardCharacters && hal::get_char(character); ++i) {
      host_.hear(character, lines_);
    }
  }

  // Runs a tick and feeds the watchdog after it.
  void run(std::uint32_t missed) {
    ++ticks_;
    const std::uint64_t began_ns = hal::now_ns();
    const Request request = host_.before_tick(controller_);
    session_.tick({.status = host_.line_status(), .missed_ticks = missed}, request,
                  [this](const Line& line) { tell(line); });
    const std::uint64_t done_ns = hal::now_ns();
    const StageTimes& stages = controller_.record().stage_ns;
    load_.add(static_cast<std::uint32_t>(done_ns - began_ns) - stages.read - stages.write);
    // The tick is healthy: the controller has counted it.
    if (controller_.next_tick() == ticks_) {
      hal::feed_watchdog();
    }
    const auto period_ns = static_cast<std::uint64_t>(1e9 / rate_hz_);
    times_ = {.scheduled_ns = static_cast<std::int64_t>(periods_ * period_ns),
              .woke_ns = static_cast<std::int64_t>(began_ns),
              .done_ns = static_cast<std::int64_t>(done_ns),
              .sample_ns = static_cast<std::int64_t>(began_ns)};
  }

  Controller& controller_;
  PoweredDevice<D> powered_;
  Session<PoweredDevice<D>> session_;
  LineQueue lines_;
  HostLine host_;
  TickLoad load_;
  double rate_hz_;
  LoopTimes times_;
  // The ticks that were begun, and the periods that have ended and that were missed.
  std::uint64_t ticks_ = 0;
  std::uint64_t periods_ = 0;
  std::uint64_t missed_ = 0;
};

// Ticks for ever. `device` must outlive it. Call it once.
template <drivers::Device D>
[[noreturn]] void run_for_ever(std::string_view board, LoadedController& loaded, D& device) {
  const hal::BoardImages images = hal::images();
  static BoardLoop<D> loop(loaded.controller(), device,
                           {.board = board,
                            .device_image = images.device,
                            .scene_image = images.scene,
                            .rate_hz = loaded.device().controller.rate_hz,
                            .joints = device.joint_count()});
  loop.start();
  for (;;) {
    loop.turn();
  }
}

}  // namespace tactus::firmware
