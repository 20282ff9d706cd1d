// The last believed readings of a device's shafts, from which a jump of the next one is measured.
#pragma once

#include <algorithm>

#include "hal/clock.h"

namespace tactus::drivers {

// Several readings may have the same time, as when a device answers one question twice. `Values`
// are the positions of all shafts.
template <class Values>
class LastReadings {
 public:
  // Takes a believed reading.
  void take(const Values& values, hal::TimeNs time_ns) {
    if (time_ns != newest_.time_ns) {
      earlier_ = newest_;
    }
    newest_ = {.values = values, .time_ns = time_ns};
  }

  // Returns the newest reading of another time than this.
  [[nodiscard]] const Values& before(hal::TimeNs time_ns) const { return from(time_ns).values; }
  // Returns the angle that a shaft can have turned from `before` to that time, rad. A gap counts as
  // kLongestGap_ns at most.
  [[nodiscard]] double reach_rad(double fastest_rad_per_s, hal::TimeNs time_ns) const {
    const hal::TimeNs gap_ns =
        std::clamp<hal::TimeNs>(time_ns - from(time_ns).time_ns, 0, kLongestGap_ns);
    return fastest_rad_per_s * static_cast<double>(gap_ns) * 1e-9;
  }

 private:
  static constexpr hal::TimeNs kLongestGap_ns = 10'000'000;

  struct Reading {
    Values values{};
    hal::TimeNs time_ns = 0;
  };
  [[nodiscard]] const Reading& from(hal::TimeNs time_ns) const {
    return time_ns != newest_.time_ns ? newest_ : earlier_;
  }

  Reading newest_;
  // The newest of an older time.
  Reading earlier_;
};

}  // namespace tactus::drivers
