// The angle of a shaft whose sensor counts in 32 bits, with a check that each new count is
// possible.
#pragma once

#include <cstdint>

#include "hal/clock.h"

namespace tactus::drivers {

// The scale of the counts and the bounds of a possible one.
struct CountedShaftConfig {
  double rad_per_count = 0.0;        // not 0
  double max_speed_rad_per_s = 0.0;  // a count that implies a faster shaft is rejected
  double jump_margin_rad = 0.0;      // allowed on top of it, for noise and jitter of the times
  double velocity_filter_s = 0.0;    // time constant of velocity_rad_per_s; 0: none
};

// Follows the counter. It may wrap: only differences count, so the angle runs on over any number of
// turns.
class CountedShaft {
 public:
  explicit CountedShaft(const CountedShaftConfig& config) : config_(config) {}

  // Accepts the next count whatever it is; the angle is then that count.
  void forget();
  // Accepts the next count if it differs by less than half the counter's range, and the angle runs
  // on. Use it for a device that could not be reached while its shaft was moved. A device that may
  // have restarted in the meantime counts from another zero; its reference is lost whatever the
  // angle is.
  void resume() { is_near_ = false; }

  // Takes the next count. Returns false, and changes nothing, if the shaft cannot have turned so
  // far since the last count. Times that go back count as no time. Several counts at one time may
  // together move the shaft by the margin at most.
  bool take(std::int32_t count, hal::TimeNs time_ns);

  [[nodiscard]] double position_rad() const {
    return static_cast<double>(counts_) * config_.rad_per_count;
  }
  // Returns the smoothed velocity from differences of the position, at most max_speed_rad_per_s.
  [[nodiscard]] double velocity_rad_per_s() const { return velocity_rad_per_s_; }

 private:
  void smooth(double step_rad, double passed_s);

  CountedShaftConfig config_;
  std::int64_t counts_ = 0;
  std::int32_t last_count_ = 0;
  std::int32_t anchor_count_ = 0;  // the first count at last_ns_
  hal::TimeNs last_ns_ = 0;
  double velocity_rad_per_s_ = 0.0;
  bool is_known_ = false;  // there is a last count
  bool is_near_ = false;   // the next count must be near the last one
};

}  // namespace tactus::drivers
