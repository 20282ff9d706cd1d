#include "drivers/cia402_can/cia402_config.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tactus::drivers {

namespace {

struct Range {
  std::string_view field;
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  std::string_view rule;
};

std::unexpected<FieldError> refused(std::string_view field, std::string_view rule) {
  return std::unexpected(FieldError{field, rule});
}

}  // namespace

Checked check(const Cia402Config& config) {
  const double least_rated_Nm = config.rated_torque_from == RatedTorque::configured ? 1e-5 : 0.0;
  const std::array ranges = std::to_array<Range>({
      {"node", static_cast<double>(config.node), 1, 127, "must lie between 1 and 127"},
      {"host_node", static_cast<double>(config.host_node), 1, 127, "must lie between 1 and 127"},
      {"period_s", config.period_s, 0.0005, 0.02, "must lie between 0.0005 and 0.02"},
      {"counts_per_turn", config.counts_per_turn, 1, 2147483648.0, "must lie between 1 and 2^31"},
      {"max_torque_Nm", config.max_torque_Nm, 1e-5, 1000, "must lie between 0.00001 and 1000"},
      {"rated_torque_Nm", config.rated_torque_Nm, least_rated_Nm, 1000,
       "must lie between 0 and 1000, and be there if rated_torque_from is configured"},
      {"max_speed_rad_per_s", config.max_speed_rad_per_s, 1, 10000, "must lie between 1 and 10000"},
      {"jump_margin_rad", config.jump_margin_rad, 0, 1, "must lie between 0 and 1"},
      {"velocity_unit_rad_per_s", config.velocity_unit_rad_per_s, 0, 1000,
       "must lie between 0 and 1000"},
      {"velocity_filter_s", config.velocity_filter_s, 0, 0.1, "must lie between 0 and 0.1"},
      {"watchdog_ms", static_cast<double>(config.watchdog_ms), 5, 1000,
       "must lie between 5 and 1000"},
      {"drive_heartbeat_ms", static_cast<double>(config.drive_heartbeat_ms), 5, 1000,
       "must lie between 5 and 1000"},
      {"lost_after_s", config.lost_after_s, 1.5 * config.period_s, 1,
       "must lie between one and a half periods and 1"},
      {"sdo_timeout_s", config.sdo_timeout_s, 0.01, 5, "must lie between 0.01 and 5"},
      {"bring_up_timeout_s", config.bring_up_timeout_s, 0.1, 60, "must lie between 0.1 and 60"},
      {"enable_timeout_s", config.enable_timeout_s, 0.02, 10, "must lie between 0.02 and 10"},
  });
  for (const Range& range : ranges) {
    if (!lies_between(range.value, range.low, range.high)) {
      return refused(range.field, range.rule);
    }
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
