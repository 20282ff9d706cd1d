#include "drivers/cia402_can/cia402_config.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tactus::drivers {

namespace {

constexpr std::string_view kRatedRule =
    "must lie between 0 and 1000, and be there if rated_torque_from is configured";

std::unexpected<FieldError> refused(std::string_view field, std::string_view rule) {
  return std::unexpected(FieldError{field, rule});
}

}  // namespace

std::span<const Binding<Cia402Config>> cia402_keys() {
  using C = Cia402Config;
  static constexpr std::array kKeys{
      bind<&C::node>("node", {}, {1, 127, "must lie between 1 and 127"}),
      bind<&C::host_node>("host_node", {}, {1, 127, "must lie between 1 and 127"}),
      bind<&C::leads_bus>("leads_bus"),
      bind<&C::period_s>("period_s", "s", {0.0005, 0.02, "must lie between 0.0005 and 0.02"}),
      bind<&C::counts_per_turn>("counts_per_turn", {},
                                {1, 2147483648.0, "must lie between 1 and 2^31"}),
      bind<&C::max_torque_Nm>("max_torque_Nm", "Nm",
                              {1e-5, 1000, "must lie between 0.00001 and 1000"}),
      bind<&C::rated_torque_from>("rated_torque_from"),
      bind<&C::rated_torque_Nm>("rated_torque_Nm", "Nm", {0, 1000, kRatedRule}),
      bind<&C::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s",
                                    {1, 10000, "must lie between 1 and 10000"}),
      bind<&C::jump_margin_rad>("jump_margin_rad", "rad", {0, 1, "must lie between 0 and 1"}),
      bind<&C::velocity_unit_rad_per_s>("velocity_unit_rad_per_s", "rad_per_s",
                                        {0, 1000, "must lie between 0 and 1000"}),
      bind<&C::velocity_filter_s>("velocity_filter_s", "s", {0, 0.1, "must lie between 0 and 0.1"}),
      bind<&C::torque_on_receipt>("torque_on_receipt"),
      bind<&C::watchdog_ms>("watchdog_ms", "ms", {5, 1000, "must lie between 5 and 1000"}),
      bind<&C::drive_heartbeat_ms>("drive_heartbeat_ms", "ms",
                                   {5, 1000, "must lie between 5 and 1000"}),
      bind<&C::lost_after_s>("lost_after_s", "s"),
      bind<&C::sdo_timeout_s>("sdo_timeout_s", "s", {0.01, 5, "must lie between 0.01 and 5"}),
      bind<&C::bring_up_timeout_s>("bring_up_timeout_s", "s",
                                   {0.1, 60, "must lie between 0.1 and 60"}),
      bind<&C::enable_timeout_s>("enable_timeout_s", "s",
                                 {0.02, 10, "must lie between 0.02 and 10"}),
      bind<&C::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

Checked check(const Cia402Config& config) {
  constexpr double kLeastRated_Nm = 1e-5;
  constexpr double kLeastPeriods = 1.5;
  if (const Checked in_range = check_ranges(config, cia402_keys()); !in_range) {
    return in_range;
  }
  if (config.rated_torque_from == RatedTorque::configured &&
      config.rated_torque_Nm < kLeastRated_Nm) {
    return refused("rated_torque_Nm", kRatedRule);
  }
  if (!lies_between(config.lost_after_s, kLeastPeriods * config.period_s, 1.0)) {
    return refused("lost_after_s", "must lie between one and a half periods and 1");
  }
  if (heartbeat_node(config) < 1) {
    return refused("host_node", "must not be below node: drive n watches host_node + 1 - n");
  }
  if (heartbeat_node(config) == config.node) {
    return refused("host_node", "gives the drive's own number: drive n watches host_node + 1 - n");
  }
  return {};
}

int heartbeat_node(const Cia402Config& config) {
  return config.host_node + 1 - config.node;
}

Checked check_bus(std::span<const Cia402Config> configs) {
  std::array<bool, 128> taken{};
  for (const Cia402Config& config : configs) {
    if (const Checked alone = check(config); !alone) {
      return alone;
    }
    if (taken[config.node]) {
      return refused("node", "must differ from drive to drive");
    }
    taken[config.node] = true;
    if (config.host_node != configs[0].host_node) {
      return refused("host_node", "must be the same for all drives of a bus");
    }
    if (config.period_s != configs[0].period_s) {
      return refused("period_s", "must be the same for all drives of a bus");
    }
  }
  const auto is_a_drives = [&taken](const Cia402Config& config) {
    return taken[static_cast<std::size_t>(heartbeat_node(config))];
  };
  if (std::ranges::any_of(configs, is_a_drives)) {
    return refused("host_node", "gives a drive's number: drive n watches host_node + 1 - n");
  }
  if (!configs.empty() && std::ranges::count(configs, true, &Cia402Config::leads_bus) != 1) {
    return refused("leads_bus", "must be set for exactly one drive of a bus");
  }
  return {};
}

}  // namespace tactus::drivers
