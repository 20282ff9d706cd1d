#include "drivers/pivot_can/pivot_config.h"

#include <array>

namespace tactus::drivers {

std::span<const Binding<PivotConfig>> pivot_keys() {
  using C = PivotConfig;
  static constexpr std::array kKeys{
      bind<&C::node>("node", {}, {1, 15, "must lie between 1 and 15"}),
      bind<&C::max_torque_Nm>("max_torque_Nm", "Nm", {1e-6, 5, "must be above 0 and at most 5"}),
      bind<&C::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s",
                                    {1, 1000, "must lie between 1 and 1000"}),
      bind<&C::counts_per_turn>("counts_per_turn", {}, {4, 1e6, "must lie between 4 and 1000000"}),
      bind<&C::lost_after_s>("lost_after_s", "s", {0.002, 1, "must lie between 0.002 and 1"}),
      bind<&C::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

Checked check(const PivotConfig& config) {
  return check_ranges(config, pivot_keys());
}

}  // namespace tactus::drivers
