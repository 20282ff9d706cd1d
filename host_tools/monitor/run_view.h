// The monitor's picture of a run: the newest tick, and statistics over many ticks. Session feeds it
// and draw_screen() reads it, in one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "firmware/linux/realtime/time_histogram.h"
#include "firmware/telemetry/explanation.h"
#include "firmware/telemetry/recorded_tick.h"
#include "host_tools/recording/record_decoder.h"

namespace tactus::host {

// Collects the messages of one or several runs of a controller.
class RunView {
 public:
  // Takes over the name of the device or the scene.
  void take(const RunInfo& info);
  // Takes over a tick. A number that does not rise means that another run has begun.
  void take(const firmware::RecordedTick& tick);

  // Takes over the explanation of a tick; without one, ticks are not explained any more.
  void explain(const std::optional<firmware::Explanation>& explanation) {
    explanation_ = explanation;
  }

  // Sets the line that tells what the last key did.
  void say(std::string text) { said_ = std::move(text); }
  // Marks the controller as gone until the next tick.
  void lose() { lost_ = true; }

  // Returns the newest tick; empty before the first.
  [[nodiscard]] const std::optional<firmware::RecordedTick>& newest() const { return newest_; }
  // Returns the newest explanation; empty unless ticks are being explained.
  [[nodiscard]] const std::optional<firmware::Explanation>& explanation() const {
    return explanation_;
  }
  // Returns the name of the device or scene; empty before it is known.
  [[nodiscard]] const std::string& name() const { return name_; }
  // Returns the line that say() has set.
  [[nodiscard]] const std::string& said() const { return said_; }
  // Returns true while the controller is gone.
  [[nodiscard]] bool lost() const { return lost_; }

  // Returns the rate of the ticks that were received in about the last second, Hz; 0 before there
  // are two.
  [[nodiscard]] double rate_hz() const;
  // Returns how late the loop woke since the monitor began, ns; empty for a simulation that does
  // not sleep.
  [[nodiscard]] const firmware::TimeHistogram& wake_up() const { return wake_up_; }
  // Returns how long the ticks took, ns.
  [[nodiscard]] const firmware::TimeHistogram& tick_time() const { return tick_time_; }
  // Returns how many ticks began late: as many as the controller has counted, or as the monitor has
  // seen begin more than half a period after their time. The controller of a simulation counts
  // none, since being late there is no fault.
  [[nodiscard]] std::uint64_t late_ticks() const;
  // Returns how many ticks the controller published and the monitor did not receive.
  [[nodiscard]] std::uint64_t missing() const { return missing_; }
  // Returns the end of the force bar: 1, 2 or 5 times a power of ten, above every force so far.
  [[nodiscard]] double force_scale_N() const { return force_scale_N_; }

 private:
  // A tick and when it was due, for the rate.
  struct Instant {
    std::uint64_t tick = 0;
    std::int64_t scheduled_ns = 0;
  };

  std::string name_;
  std::string said_;
  bool lost_ = false;
  std::optional<firmware::RecordedTick> newest_;
  std::optional<firmware::Explanation> explanation_;
  std::deque<Instant> instants_;
  firmware::TimeHistogram wake_up_;
  firmware::TimeHistogram tick_time_;
  std::uint64_t missing_ = 0;
  std::uint64_t seen_late_ = 0;
  double force_scale_N_ = 1.0;
};

}  // namespace tactus::host
