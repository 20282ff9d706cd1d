#include "firmware/linux/flight/flight_writer.h"

#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <ctime>

namespace tactus::firmware {

int FlightWriter::start(const FlightPlan& plan) {
  file_.plan(plan);
  tzset();  // or gmtime_r asks for memory when it is first called
  return thread_.start("flight", [](void* self) { static_cast<FlightWriter*>(self)->run(); }, this);
}

void FlightWriter::use_scene(std::span<const std::byte> image) {
  const std::scoped_lock lock(file_mutex_);
  file_.use_scene(image);
  has_scene_.store(true, std::memory_order_release);
}

void FlightWriter::add(const RecordedTick& tick, Controller& controller) {
  recorder_.add(tick, controller);
  const auto delay_ticks = static_cast<std::uint64_t>(kAfterFault_s * file_.rate_hz());
  if (faults_.note(tick.record.mode, delay_ticks)) {
    ask();
  }
}

void FlightWriter::stop() {
  stopping_.store(true, std::memory_order_release);
  thread_.join();
}

void FlightWriter::run() {
  // The interval at which the thread looks for a wanted file.
  constexpr useconds_t kLook_us = 20'000;
  bool stopping = false;
  while (!stopping) {
    stopping = stopping_.load(std::memory_order_acquire);
    const bool fault = stopping && faults_.is_waiting();
    const bool ready = has_scene_.load(std::memory_order_acquire);
    if (ready && (wanted_.exchange(false, std::memory_order_acq_rel) || fault)) {
      write_out();
    }
    if (!stopping) {
      usleep(kLook_us);
    }
  }
}

void FlightWriter::write_out() {
  const std::scoped_lock lock(file_mutex_);
  constexpr int kTries = 3;  // a slow disk may be overtaken by the loop
  for (int k = 0; k < kTries; ++k) {
    const auto window = recorder_.hold();
    if (!has_scene_.load(std::memory_order_acquire)) {
      ask();  // the loop has just changed the scene
      break;
    }
    if (!window || window->first_tick == window->end_tick) {
      std::fputs("tactusd: the flight recorder has nothing yet\n", stderr);
      break;
    }
    const auto [failed, ticks] = file_.write(*window, recorder_);
    if (failed != 0) {
      std::fprintf(stderr, "tactusd: %s: cannot write: %s\n", file_.path(), std::strerror(failed));
      break;
    }
    if (ticks > 0) {
      files_.fetch_add(1, std::memory_order_release);
      std::fprintf(stderr, "tactusd: %s has the last %.1f s; tactus replay shows them\n",
                   file_.path(), static_cast<double>(ticks) / file_.rate_hz());
      break;
    }
  }
  recorder_.release();
}

}  // namespace tactus::firmware
