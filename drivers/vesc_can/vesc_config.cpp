#include "drivers/vesc_can/vesc_config.h"

#include <array>

namespace tactus::drivers {

namespace {

struct VescRange {
  std::string_view field;
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  std::string_view rule;
};

}  // namespace

Checked check(const VescConfig& config) {
  const std::array ranges = std::to_array<VescRange>({
      {"vesc_id", static_cast<double>(config.vesc_id), 0, 254, "must lie between 0 and 254"},
      {"host_id", static_cast<double>(config.host_id), 0, 254, "must lie between 0 and 254"},
      {"torque_constant_Nm_per_A", config.torque_constant_Nm_per_A, 1e-4, 10,
       "must lie between 0.0001 and 10"},
      {"max_torque_Nm", config.max_torque_Nm, 1e-5, 100, "must lie between 0.00001 and 100"},
      {"pole_pairs", static_cast<double>(config.pole_pairs), 1, 60, "must lie between 1 and 60"},
      {"off_delay_s", config.off_delay_s, 0.01, 30, "must lie between 0.01 and 30"},
      {"watchdog_s", config.watchdog_s, 0.001, 1, "must lie between 0.001 and 1"},
      {"max_speed_rad_per_s", config.max_speed_rad_per_s, 1, 100000,
       "must lie between 1 and 100000"},
      {"jump_margin_rad", config.jump_margin_rad, 0, 3, "must lie between 0 and 3"},
      {"status_period_s", config.status_period_s, 0.001, 0.1, "must lie between 0.001 and 0.1"},
      {"lost_after_s", config.lost_after_s, 2.5 * config.status_period_s, 1,
       "must lie between two and a half status periods and 1"},
      {"poll_period_s", config.poll_period_s, 0.001, 1, "must lie between 0.001 and 1"},
      {"bring_up_s", config.bring_up_s, 0.1, 60, "must lie between 0.1 and 60"},
  });
  for (const VescRange& range : ranges) {
    if (!lies_between(range.value, range.low, range.high)) {
      return std::unexpected(FieldError{range.field, range.rule});
    }
  }
  if (config.host_id == config.vesc_id) {
    return std::unexpected(FieldError{"host_id", "must not be the VESC's"});
  }
  return {};
}

}  // namespace tactus::drivers
