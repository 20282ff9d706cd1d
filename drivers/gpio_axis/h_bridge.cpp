#include "drivers/gpio_axis/h_bridge.h"

#include <algorithm>
#include <cmath>

namespace tactus::drivers {

double duty_of(TorqueLaw law, double torque_part) {
  return law == TorqueLaw::square_root ? std::sqrt(torque_part) : torque_part;
}

HBridge::HBridge(const BridgeConfig& config) : config_(config) {}

BridgeOutput HBridge::drive(double torque_Nm, hal::TimeNs now_ns) {
  const double wanted_Nm = std::isfinite(torque_Nm) ? torque_Nm : 0.0;
  const double size_Nm = std::min(std::abs(wanted_Nm), config_.max_torque_Nm);
  const double duty =
      std::min(duty_of(config_.law, size_Nm / config_.full_duty_torque_Nm), config_.max_duty);
  const bool negative = (wanted_Nm < 0.0) != config_.reversed;
  return config_.mode == BridgeMode::sign_magnitude ? sign_magnitude(duty, negative, now_ns)
                                                    : locked_antiphase(duty, negative);
}

BridgeOutput HBridge::sign_magnitude(double part, bool negative, hal::TimeNs now_ns) {
  const auto duty_ns = static_cast<hal::TimeNs>(part * static_cast<double>(config_.pwm_period_ns));
  const bool turns_about = duty_ns > 0 && negative != reverse_;
  if (driving_ && (duty_ns == 0 || turns_about)) {
    driving_ = false;
    idle_since_ns_ = now_ns;
  }
  if (duty_ns == 0) {
    return {.duty_ns = 0, .reverse = reverse_};
  }
  if (turns_about) {
    if (now_ns - idle_since_ns_ < hal::TimeNs{config_.direction_dead_us} * 1000) {
      return {.duty_ns = 0, .reverse = reverse_};
    }
    reverse_ = negative;
  }
  driving_ = true;
  return {.duty_ns = duty_ns, .reverse = reverse_};
}

BridgeOutput HBridge::locked_antiphase(double part, bool negative) const {
  const auto half_ns = config_.pwm_period_ns / 2;
  const auto away_ns = static_cast<hal::TimeNs>(part * static_cast<double>(half_ns));
  return {.duty_ns = negative ? half_ns - away_ns : half_ns + away_ns, .reverse = false};
}

}  // namespace tactus::drivers
