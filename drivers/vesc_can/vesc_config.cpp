#include "drivers/vesc_can/vesc_config.h"

#include <array>

namespace tactus::drivers {

std::span<const Binding<VescConfig>> vesc_keys() {
  using C = VescConfig;
  static constexpr std::array kKeys{
      bind<&C::vesc_id>("vesc_id", {}, {0, 254, "must lie between 0 and 254"}),
      bind<&C::host_id>("host_id", {}, {0, 254, "must lie between 0 and 254"}),
      bind<&C::torque_constant_Nm_per_A>("torque_constant_Nm_per_A", "Nm_per_A",
                                         {1e-4, 10, "must lie between 0.0001 and 10"}),
      bind<&C::max_torque_Nm>("max_torque_Nm", "Nm",
                              {1e-5, 100, "must lie between 0.00001 and 100"}),
      bind<&C::pole_pairs>("pole_pairs", {}, {1, 60, "must lie between 1 and 60"}),
      bind<&C::off_delay_s>("off_delay_s", "s", {0.01, 30, "must lie between 0.01 and 30"}),
      bind<&C::watchdog_s>("watchdog_s", "s", {0.001, 1, "must lie between 0.001 and 1"}),
      bind<&C::offers_position>("offers_position"),
      bind<&C::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s",
                                    {1, 100000, "must lie between 1 and 100000"}),
      bind<&C::jump_margin_rad>("jump_margin_rad", "rad", {0, 3, "must lie between 0 and 3"}),
      bind<&C::status_period_s>("status_period_s", "s",
                                {0.001, 0.1, "must lie between 0.001 and 0.1"}),
      bind<&C::lost_after_s>("lost_after_s", "s"),
      bind<&C::poll_period_s>("poll_period_s", "s", {0.001, 1, "must lie between 0.001 and 1"}),
      bind<&C::bring_up_s>("bring_up_s", "s", {0.1, 60, "must lie between 0.1 and 60"}),
      bind<&C::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

Checked check(const VescConfig& config) {
  constexpr double kLeastStatuses = 2.5;
  if (const Checked in_range = check_ranges(config, vesc_keys()); !in_range) {
    return in_range;
  }
  if (!lies_between(config.lost_after_s, kLeastStatuses * config.status_period_s, 1.0)) {
    return std::unexpected(
        FieldError{"lost_after_s", "must lie between two and a half status periods and 1"});
  }
  if (config.host_id == config.vesc_id) {
    return std::unexpected(FieldError{"host_id", "must not be the VESC's"});
  }
  return {};
}

}  // namespace tactus::drivers
