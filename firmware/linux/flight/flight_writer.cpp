#include "firmware/linux/flight/flight_writer.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>

namespace tactus::firmware {

int FlightWriter::start(const FlightPlan& plan) {
  file_.plan(plan);
  tzset();  // or gmtime_r asks for memory when it is first called
  return thread_.start("flight", [](void* self) { static_cast<FlightWriter*>(self)->run(); }, this);
}

void FlightWriter::accompany(FlightCompanion& companion, const FlightPlan& plan) {
  companion.file.plan(plan);
  companions_[companion_count_] = &companion;
  ++companion_count_;
}

void FlightWriter::leave_scene() {
  recorder_.forget();
  for (FlightCompanion* const companion : companions()) {
    companion->ticks.forget();
  }
  has_scene_.store(false, std::memory_order_release);
}

void FlightWriter::use_scene(std::span<const std::byte> image) {
  const std::scoped_lock lock(file_mutex_);
  file_.use_scene(image);
  for (FlightCompanion* const companion : companions()) {
    companion->file.use_scene(image);
  }
  has_scene_.store(true, std::memory_order_release);
}

void FlightWriter::add(const RecordedTick& tick, Controller& controller) {
  recorder_.add(tick, controller);
  const auto delay_ticks = static_cast<std::uint64_t>(kAfterFault_s * file_.rate_hz());
  for (std::size_t i = 0; i < controller.device_count(); ++i) {
    if (faults_[i].note(controller.mode(i), delay_ticks)) {
      ask();
    }
  }
}

bool FlightWriter::is_fault_waiting() const {
  return std::ranges::any_of(faults_, [](const FaultWatch& watch) { return watch.is_waiting(); });
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
    const bool fault = stopping && is_fault_waiting();
    const bool ready = has_scene_.load(std::memory_order_acquire);
    if (ready && (wanted_.exchange(0, std::memory_order_acq_rel) != 0 || fault)) {
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
    const auto ticks = write_files(*window);
    if (!ticks) {
      break;
    }
    if (*ticks > 0) {
      files_.fetch_add(1, std::memory_order_release);
      std::fprintf(
          stderr, "tactusd: %s has the last %.1f s; tactus replay shows %s\n", file_.path(),
          static_cast<double>(*ticks) / file_.rate_hz(),
          companion_count_ == 0 ? "them" : "it together with the other devices' files beside it");
      break;
    }
  }
  recorder_.release();
}

std::optional<std::uint64_t> FlightWriter::write_files(const FlightWindow& window) {
  const std::time_t now = std::time(nullptr);
  std::uint64_t fewest = window.end_tick;
  const auto write = [&](FlightFile& file, const FlightWindow& part, const FlightTicks& ticks) {
    const WrittenFlight written = file.write(part, ticks, now);
    if (written.failed != 0) {
      std::fprintf(stderr, "tactusd: %s: cannot write: %s\n", file.path(),
                   std::strerror(written.failed));
    }
    fewest = std::min(fewest, written.ticks);
    return written.failed == 0;
  };
  bool is_written = write(file_, window, recorder_.ticks());
  // The first device's file has the state of all.
  const FlightWindow ticks_only{
      .first_tick = window.first_tick, .end_tick = window.end_tick, .state = {}};
  for (FlightCompanion* const companion : companions()) {
    is_written = is_written && write(companion->file, ticks_only, companion->ticks);
  }
  return is_written ? std::optional(fewest) : std::nullopt;
}

}  // namespace tactus::firmware
