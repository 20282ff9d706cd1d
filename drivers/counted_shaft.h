// The angle of a shaft whose sensor counts in 32 bits, and whether a new count can be true.
#pragma once

#include <cstdint>

#include "hal/clock.h"

namespace tactus::drivers {

struct CountedShaftConfig {
  double rad_per_count = 0.0;        // not 0
  double max_speed_rad_per_s = 0.0;  // no count that takes a faster shaft is believed
  double jump_margin_rad = 0.0;      // more than that: noise and the jitter of the times
  double velocity_filter_s = 0.0;    // time constant of velocity_rad_per_s; 0: none
};

// The counter may wrap: only differences count, so the angle runs on over any number of turns.
class CountedShaft {
 public:
  explicit CountedShaft(const CountedShaftConfig& config) : config_(config) {}

  // The next count is believed whatever it is, and gives the angle.
  void forget();
  // The next count is believed as long as it differs by less than half the counter's range, and the
  // angle runs on: for a device that was out of reach while its shaft was moved. A device that may
  // have restarted meanwhile counts from another zero: its reference is lost, whatever the angle.
  void resume() { is_near_ = false; }

  // False, and nothing changes, if the shaft cannot have got there since the last count. Times that
  // go back count as no time at all, and however many counts come at one time, together they move
  // the shaft by no more than the margin.
  bool take(std::int32_t count, hal::TimeNs time_ns);

  [[nodiscard]] double position_rad() const {
    return static_cast<double>(counts_) * config_.rad_per_count;
  }
  // From differences of the position, smoothed; within the greatest speed.
  [[nodiscard]] double velocity_rad_per_s() const { return velocity_rad_per_s_; }

 private:
  void smooth(double step_rad, double passed_s);

  CountedShaftConfig config_;
  std::int64_t counts_ = 0;
  std::int32_t last_count_ = 0;
  std::int32_t anchor_count_ = 0;  // the first at last_ns_
  hal::TimeNs last_ns_ = 0;
  double velocity_rad_per_s_ = 0.0;
  bool is_known_ = false;  // there is a last count
  bool is_near_ = false;   // and the next one must be near it
};

}  // namespace tactus::drivers
