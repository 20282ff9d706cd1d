// Tells a reading that a shaft can have from one that it cannot: what a flipped bit, a slipped
// encoder or a restarted drive makes of a position.
#pragma once

#include <cstdint>

#include "drivers/axis.h"
#include "hal/clock.h"

namespace tactus::drivers {

struct EncoderCheckConfig {
  double max_speed_rad_per_s = 200.0;  // faster than the shaft ever turns
  double margin_rad = 0.02;            // for noise and for jitter of the time stamps
};

enum class EncoderVerdict : std::uint8_t {
  good,
  not_a_number,
  jumped,    // farther from the last good one than the shaft can have turned since
  too_fast,  // the velocity is beyond max_speed_rad_per_s
};

class EncoderCheck {
 public:
  // Good ones in a row until the position is trusted.
  static constexpr std::uint32_t kTrusted = 3;

  explicit EncoderCheck(const EncoderCheckConfig& config) : config_(config) {}

  // The next reading is the first.
  void reset() { good_ = 0; }

  // A reading that is not good leaves the last good one in place. Times that go back count as no
  // time.
  EncoderVerdict check(double position_rad, double velocity_rad_per_s, hal::TimeNs time_ns);

  [[nodiscard]] bool is_trusted() const { return good_ >= kTrusted; }

 private:
  EncoderCheckConfig config_;
  double position_rad_ = 0.0;
  hal::TimeNs time_ns_ = 0;
  std::uint32_t good_ = 0;
};

// In words; nothing for `good`.
Trouble trouble_of(EncoderVerdict verdict);

}  // namespace tactus::drivers
