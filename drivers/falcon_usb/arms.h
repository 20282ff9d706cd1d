// The three arms of a Falcon: encoder counts become samples, a jump is noticed, and the device's
// own search for its reference is followed.
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

  // Forgets the samples and the reference.
  void forget();
  // Notes that the arms had a reference before `forget`.
  void lose_reference() { homing_.is_reference_lost = true; }
  // Returns true if no arm turned farther than it can since the last counts.
  [[nodiscard]] bool can_reach(const Counts& counts, hal::TimeNs time_ns) const;
  // Takes the counts of an answer that was true at that time.
  void take(const Counts& counts, hal::TimeNs time_ns);
  // Takes an answer before the arms are homed. `all_homed`: it has the homing bits of all arms.
  void take_in_homing(bool all_homed, const Counts& counts, hal::TimeNs time_ns);
  // Writes the samples of the arms, with this status.
  void report(std::uint32_t status, std::span<AxisSample> out) {
    samples_.report(status, out.first(kFalconArms));
  }

  [[nodiscard]] bool is_homed() const { return homing_.is_done; }
  // Returns true if the arms had a reference, and have not found it again.
  [[nodiscard]] bool is_reference_lost() const { return homing_.is_reference_lost; }

 private:
  // The device's own search for its reference.
  struct Homing {
    bool is_done = false;
    bool is_reference_lost = false;
    // The number of answers in a row that have all homing bits.
    std::uint32_t in_a_row = 0;
  };

  double fastest_rad_per_s_;
  PositionSamples<kFalconArms> samples_;
  LastReadings<Counts> last_;
  Homing homing_;
};

}  // namespace tactus::drivers
