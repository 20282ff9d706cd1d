#include "drivers/moteus_canfd/moteus_config.h"

#include "drivers/moteus_canfd/moteus_protocol.h"

namespace tactus::drivers {

Checked check(const MoteusConfig& config) {
  constexpr double kLongest_s = 10.0;
  if (config.servo_id < 1 || config.servo_id > moteus::kMaxServo) {
    return std::unexpected(FieldError{"servo_id", "must lie between 1 and 126"});
  }
  if (config.host_id > moteus::kMaxHost) {
    return std::unexpected(FieldError{"host_id", "must lie between 0 and 127"});
  }
  if (config.host_id == config.servo_id) {
    return std::unexpected(FieldError{"host_id", "must not be the servo's id"});
  }
  if (config.prefix > moteus::kMaxPrefix) {
    return std::unexpected(FieldError{"prefix", "must lie between 0 and 8191"});
  }
  if (!lies_between(config.max_torque_Nm, 1e-6, 1000.0)) {
    return std::unexpected(FieldError{"max_torque_Nm", "must be above 0 and at most 1000"});
  }
  if (!lies_between(config.watchdog_s, 0.002, 1.0)) {
    return std::unexpected(FieldError{"watchdog_s", "must lie between 0.002 and 1"});
  }
  if (!lies_between(config.max_speed_rad_per_s, 0.1, 10'000.0)) {
    return std::unexpected(FieldError{"max_speed_rad_per_s", "must lie between 0.1 and 10000"});
  }
  if (!lies_between(config.jump_margin_rad, 1e-6, 3.0)) {
    return std::unexpected(FieldError{"jump_margin_rad", "must be above 0 and at most 3"});
  }
  if (!lies_between(config.reply_stale_s, 0.001, kLongest_s)) {
    return std::unexpected(FieldError{"reply_stale_s", "must lie between 0.001 and 10"});
  }
  if (!lies_between(config.reply_lost_s, config.reply_stale_s, kLongest_s)) {
    return std::unexpected(FieldError{"reply_lost_s", "must lie between reply_stale_s and 10"});
  }
  if (!lies_between(config.bring_up_s, config.reply_lost_s, kLongest_s)) {
    return std::unexpected(FieldError{"bring_up_s", "must lie between reply_lost_s and 10"});
  }
  return {};
}

}  // namespace tactus::drivers
