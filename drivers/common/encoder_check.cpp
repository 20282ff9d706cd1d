#include "drivers/common/encoder_check.h"

#include <algorithm>
#include <cmath>

namespace tactus::drivers {

namespace {

constexpr double kSecondsPerNs = 1e-9;

}  // namespace

EncoderVerdict EncoderCheck::check(double position_rad, double velocity_rad_per_s,
                                   hal::TimeNs time_ns) {
  if (!std::isfinite(position_rad) || !std::isfinite(velocity_rad_per_s)) {
    return EncoderVerdict::not_a_number;
  }
  if (std::abs(velocity_rad_per_s) > config_.max_speed_rad_per_s) {
    return EncoderVerdict::too_fast;
  }
  if (good_ > 0) {
    const double passed_s =
        kSecondsPerNs * (static_cast<double>(time_ns) - static_cast<double>(time_ns_));
    const double reach_rad =
        config_.max_speed_rad_per_s * std::max(passed_s, 0.0) + config_.margin_rad;
    if (std::abs(position_rad - position_rad_) > reach_rad) {
      return EncoderVerdict::jumped;
    }
  }
  position_rad_ = position_rad;
  time_ns_ = good_ > 0 ? std::max(time_ns_, time_ns) : time_ns;
  good_ = std::min(good_ + 1, kTrusted);
  return EncoderVerdict::good;
}

Trouble trouble_of(EncoderVerdict verdict) {
  constexpr std::string_view kRemedy =
      "check the encoder, its magnet and cable, and the cable of the bus; then reset";
  switch (verdict) {
    case EncoderVerdict::not_a_number:
      return {"the drive reports a position that is not a number", kRemedy};
    case EncoderVerdict::jumped:
      return {"the position jumped farther than the shaft can turn", kRemedy};
    case EncoderVerdict::too_fast:
      return {"the drive reports a speed beyond the shaft's", kRemedy};
    case EncoderVerdict::good:
      break;
  }
  return {};
}

}  // namespace tactus::drivers
