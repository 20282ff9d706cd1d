// The three arms of a Falcon: encoder counts become samples, and a jump is noticed.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "drivers/common/last_readings.h"
#include "drivers/common/position_samples.h"
#include "drivers/falcon_usb/packet.h"
#include "hal/clock.h"

namespace tactus::drivers {

class FalconArms {
 public:
  using Counts = std::array<std::int16_t, kFalconArms>;

  FalconArms(double velocity_cutoff_Hz, double fastest_rad_per_s)
      : fastest_rad_per_s_(fastest_rad_per_s), samples_(velocity_cutoff_Hz, fastest_rad_per_s) {}

  // Forgets the samples.
  void forget() { samples_.forget(); }
  // Makes the velocities at the next counts zero.
  void restart_velocities();
  // Returns true if no arm turned farther than it can since the last counts.
  [[nodiscard]] bool can_reach(const Counts& counts, hal::TimeNs time_ns) const;
  // Takes counts that were true at that time.
  void take(const Counts& counts, hal::TimeNs time_ns);
  // Writes the samples of the arms, with this status.
  void report(std::uint32_t status, std::span<AxisSample> out) {
    samples_.report(status, out.first(kFalconArms));
  }

 private:
  double fastest_rad_per_s_;
  PositionSamples<kFalconArms> samples_;
  LastReadings<Counts> last_;
};

}  // namespace tactus::drivers
