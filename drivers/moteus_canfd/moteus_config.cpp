#include "drivers/moteus_canfd/moteus_config.h"

#include "drivers/moteus_canfd/moteus_protocol.h"

namespace tactus::drivers {

namespace {

constexpr double kMoteusLongest_s = 10.0;

}  // namespace

std::span<const Binding<MoteusConfig>> moteus_keys() {
  using C = MoteusConfig;
  static constexpr std::array kKeys{
      bind<&C::servo_id>("servo_id", {}, {1, moteus::kMaxServo, "must lie between 1 and 126"}),
      bind<&C::host_id>("host_id", {}, {0, moteus::kMaxHost, "must lie between 0 and 127"}),
      bind<&C::prefix>("prefix", {}, {0, moteus::kMaxPrefix, "must lie between 0 and 8191"}),
      bind<&C::bit_rate_switch>("bit_rate_switch"),
      bind<&C::max_torque_Nm>("max_torque_Nm", "Nm",
                              {1e-6, 1000.0, "must be above 0 and at most 1000"}),
      bind<&C::watchdog_s>("watchdog_s", "s", {0.002, 1.0, "must lie between 0.002 and 1"}),
      bind<&C::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s",
                                    {0.1, 10'000.0, "must lie between 0.1 and 10000"}),
      bind<&C::jump_margin_rad>("jump_margin_rad", "rad",
                                {1e-6, 3.0, "must be above 0 and at most 3"}),
      bind<&C::query>("query"),
      bind<&C::reply_stale_s>("reply_stale_s", "s",
                              {0.001, kMoteusLongest_s, "must lie between 0.001 and 10"}),
      bind<&C::reply_lost_s>("reply_lost_s", "s"),
      bind<&C::bring_up_s>("bring_up_s", "s"),
      bind<&C::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

Checked check(const MoteusConfig& config) {
  if (const Checked in_range = check_ranges(config, moteus_keys()); !in_range) {
    return in_range;
  }
  if (config.host_id == config.servo_id) {
    return std::unexpected(FieldError{"host_id", "must not be the servo's id"});
  }
  if (!lies_between(config.reply_lost_s, config.reply_stale_s, kMoteusLongest_s)) {
    return std::unexpected(FieldError{"reply_lost_s", "must lie between reply_stale_s and 10"});
  }
  if (!lies_between(config.bring_up_s, config.reply_lost_s, kMoteusLongest_s)) {
    return std::unexpected(FieldError{"bring_up_s", "must lie between reply_lost_s and 10"});
  }
  return {};
}

}  // namespace tactus::drivers
