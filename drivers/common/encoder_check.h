// Rejects encoder readings that the shaft cannot have: a position after a flipped bit, a slipped
// encoder or a restart of the drive.
#pragma once

#include <cstdint>

#include "drivers/axis.h"
#include "hal/clock.h"

namespace tactus::drivers {

// The bounds of a plausible reading.
struct EncoderCheckConfig {
  double max_speed_rad_per_s = 200.0;  // larger than any real speed of the shaft
  double margin_rad = 0.02;            // allowed for noise and jitter of the time stamps
};

enum class EncoderVerdict : std::uint8_t {
  good,
  not_a_number,
  jumped,    // farther from the last good one than the shaft can have turned
  too_fast,  // the velocity is beyond max_speed_rad_per_s
};

class EncoderCheck {
 public:
  // The position is trusted after so many good readings in a row.
  static constexpr std::uint32_t kTrusted = 3;

  explicit EncoderCheck(const EncoderCheckConfig& config) : config_(config) {}

  // Forgets the past: the next reading counts as the first.
  void reset() { good_ = 0; }

  // Judges a reading of the shaft. A reading that is not good leaves the last good one in place.
  // Times that go back count as no time.
  EncoderVerdict check(double position_rad, double velocity_rad_per_s, hal::TimeNs time_ns);

  [[nodiscard]] bool is_trusted() const { return good_ >= kTrusted; }

 private:
  EncoderCheckConfig config_;
  double position_rad_ = 0.0;
  hal::TimeNs time_ns_ = 0;
  std::uint32_t good_ = 0;
};

// Returns the verdict in words with a remedy, or an empty Trouble for `good`.
Trouble trouble_of(EncoderVerdict verdict);

}  // namespace tactus::drivers
