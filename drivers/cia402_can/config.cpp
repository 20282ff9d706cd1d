#include "drivers/cia402_can/config.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tactus::drivers {

namespace {

constexpr double kLargestNode = 127.0;
constexpr double kSmallestTorque_Nm = 1e-5;
constexpr double kLargestTorque_Nm = 1000.0;

std::expected<void, RangeError> outcome(const RangeCheck& ranges) {
  if (ranges.error()) {
    return std::unexpected(*ranges.error());
  }
  return {};
}

}  // namespace

std::expected<void, RangeError> check(const Cia402Config& config) {
  RangeCheck ranges;
  ranges.within("node", config.node, 1.0, kLargestNode);
  ranges.within("host_node", config.host_node, 1.0, kLargestNode);
  ranges.within("host_node, which is the drive's own", config.host_node == config.node ? 1.0 : 0.0,
                0.0, 0.0);
  ranges.within("period_s", config.period_s, 0.0005, 0.02);
  ranges.within("counts_per_turn", config.counts_per_turn, 1.0, 2147483648.0);
  ranges.within("max_torque_Nm", config.max_torque_Nm, kSmallestTorque_Nm, kLargestTorque_Nm);
  ranges.within("rated_torque_Nm", config.rated_torque_Nm,
                config.rated_torque_from == RatedTorque::configured ? kSmallestTorque_Nm : 0.0,
                kLargestTorque_Nm);
  ranges.within("max_speed_rad_per_s", config.max_speed_rad_per_s, 1.0, 10000.0);
  ranges.within("jump_margin_rad", config.jump_margin_rad, 0.0, 1.0);
  ranges.within("velocity_unit_rad_per_s", config.velocity_unit_rad_per_s, 0.0, 1000.0);
  ranges.within("velocity_filter_s", config.velocity_filter_s, 0.0, 0.1);
  ranges.within("watchdog_ms", config.watchdog_ms, 5.0, 1000.0);
  ranges.within("drive_heartbeat_ms", config.drive_heartbeat_ms, 5.0, 1000.0);
  ranges.within("lost_after_s", config.lost_after_s, 1.5 * config.period_s, 1.0);
  ranges.within("sdo_timeout_s", config.sdo_timeout_s, 0.01, 5.0);
  ranges.within("bring_up_timeout_s", config.bring_up_timeout_s, 0.1, 60.0);
  ranges.within("enable_timeout_s", config.enable_timeout_s, 0.01, 10.0);
  return outcome(ranges);
}

std::expected<void, RangeError> check_bus(std::span<const Cia402Config> configs) {
  std::array<bool, 128> taken{};
  RangeCheck ranges;
  for (const Cia402Config& config : configs) {
    if (auto alone = check(config); !alone) {
      return alone;
    }
    ranges.within("node, which another drive has", taken[config.node] ? 1.0 : 0.0, 0.0, 0.0);
    taken[config.node] = true;
    ranges.within("host_node", config.host_node, configs[0].host_node, configs[0].host_node);
    ranges.within("period_s", config.period_s, configs[0].period_s, configs[0].period_s);
  }
  if (!configs.empty()) {
    ranges.within("host_node, which a drive has", taken[configs[0].host_node] ? 1.0 : 0.0, 0.0,
                  0.0);
    const auto leaders = std::ranges::count(configs, true, &Cia402Config::leads_bus);
    ranges.within("leads_bus, drives that do", static_cast<double>(leaders), 1.0, 1.0);
  }
  return outcome(ranges);
}

}  // namespace tactus::drivers
