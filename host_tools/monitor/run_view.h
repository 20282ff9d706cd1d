// The monitor's view of a run: the newest tick, and statistics over many ticks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "firmware/linux/realtime/time_histogram.h"
#include "firmware/telemetry/recorded_tick.h"
#include "host_tools/recording/record_decoder.h"

namespace tactus::host {

class RunView {
 public:
  void take(const RunInfo& info);
  void take(const firmware::RecordedTick& tick);

  // Sets the line that says what the last key did or what happened.
  void say(std::string text) { said_ = std::move(text); }
  // Marks the controller as gone until the next tick.
  void lose() { lost_ = true; }

  [[nodiscard]] const std::optional<firmware::RecordedTick>& newest() const { return newest_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& said() const { return said_; }
  [[nodiscard]] bool lost() const { return lost_; }

  // Returns the rate of the ticks received in about the last second; 0 before there are two.
  [[nodiscard]] double rate_hz() const;
  // The histogram since the monitor began; empty in a simulation, which has no wake-ups.
  [[nodiscard]] const firmware::TimeHistogram& wake_up() const { return wake_up_; }
  [[nodiscard]] const firmware::TimeHistogram& tick_time() const { return tick_time_; }
  // Ticks that the controller published and the monitor did not get.
  [[nodiscard]] std::uint64_t missing() const { return missing_; }
  // The end of the force bar: 1, 2 or 5 times a power of ten, above all that was seen.
  [[nodiscard]] double force_scale_N() const { return force_scale_N_; }

 private:
  struct Instant {
    std::uint64_t tick = 0;
    std::int64_t scheduled_ns = 0;
  };

  std::string name_;
  std::string said_;
  bool lost_ = false;
  std::optional<firmware::RecordedTick> newest_;
  std::deque<Instant> instants_;
  firmware::TimeHistogram wake_up_;
  firmware::TimeHistogram tick_time_;
  std::uint64_t missing_ = 0;
  double force_scale_N_ = 1.0;
};

}  // namespace tactus::host
