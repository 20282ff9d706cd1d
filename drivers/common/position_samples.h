// The samples of a board whose device reports positions only.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "drivers/axis.h"
#include "drivers/common/rate_filter.h"
#include "hal/clock.h"

namespace tactus::drivers {

template <std::size_t kAxes>
class PositionSamples {
 public:
  // Velocities are filtered at the cutoff and clamped to `fastest_rad_per_s`.
  PositionSamples(double velocity_cutoff_Hz, double fastest_rad_per_s)
      : fastest_rad_per_s_(fastest_rad_per_s),
        rates_(filters(velocity_cutoff_Hz, std::make_index_sequence<kAxes>{})) {}

  // Forgets the samples, but not the velocities' past.
  void forget() { samples_ = {}; }
  // Makes the velocity at the next position zero.
  void restart_velocity(std::size_t axis) { rates_[axis].restart(); }
  void take(std::size_t axis, double position_rad, hal::TimeNs time_ns) {
    AxisSample& sample = samples_[axis];
    sample.position_rad = position_rad;
    sample.velocity_rad_per_s = std::clamp(rates_[axis].update(position_rad, time_ns),
                                           -fastest_rad_per_s_, fastest_rad_per_s_);
    sample.time_ns = time_ns;
  }
  // Writes the sample of each axis of `out`, with this status.
  void report(std::uint32_t status, std::span<AxisSample> out) {
    for (std::size_t axis = 0; axis < out.size(); ++axis) {
      samples_[axis].status = status;
      out[axis] = samples_[axis];
    }
  }

 private:
  template <std::size_t... kAxis>
  static std::array<RateFilter, kAxes> filters(double cutoff_Hz,
                                               std::index_sequence<kAxis...> /*axes*/) {
    return {((void)kAxis, RateFilter(cutoff_Hz))...};
  }

  double fastest_rad_per_s_;
  std::array<AxisSample, kAxes> samples_{};
  std::array<RateFilter, kAxes> rates_;
};

}  // namespace tactus::drivers
