#include "drivers/odrive_can/odrive_config.h"

#include "drivers/odrive_can/odrive_protocol.h"

namespace tactus::drivers {

namespace {

constexpr double kODriveLongest_s = 10.0;
constexpr std::string_view kUpTo10s = "must lie between 0 and 10";

Checked check_deadlines(const ODriveConfig& config) {
  if (!lies_between(config.estimate_lost_s, config.estimate_stale_s, kODriveLongest_s)) {
    return std::unexpected(
        FieldError{"estimate_lost_s", "must lie between estimate_stale_s and 10"});
  }
  if (!lies_between(config.heartbeat_lost_s, config.estimate_lost_s, kODriveLongest_s)) {
    return std::unexpected(
        FieldError{"heartbeat_lost_s", "must lie between estimate_lost_s and 10"});
  }
  if (!lies_between(config.bring_up_s, config.heartbeat_lost_s, kODriveLongest_s)) {
    return std::unexpected(FieldError{"bring_up_s", "must lie between heartbeat_lost_s and 10"});
  }
  return {};
}

}  // namespace

std::span<const Binding<ODriveConfig>> odrive_keys() {
  using C = ODriveConfig;
  static constexpr std::array kKeys{
      bind<&C::node_id>("node_id", {}, {0, odrive::kMaxNode, "must lie between 0 and 62"}),
      bind<&C::max_torque_Nm>("max_torque_Nm", "Nm",
                              {1e-6, 100.0, "must be above 0 and at most 100"}),
      bind<&C::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s",
                                    {0.1, 10'000.0, "must lie between 0.1 and 10000"}),
      bind<&C::jump_margin_rad>("jump_margin_rad", "rad",
                                {1e-6, 3.0, "must be above 0 and at most 3"}),
      bind<&C::drive_speed_limit_rad_per_s>("drive_speed_limit_rad_per_s", "rad_per_s",
                                            {0.0, 100'000.0, "must lie between 0 and 100000"}),
      bind<&C::drive_current_limit_A>("drive_current_limit_A", "A",
                                      {0.0, 200.0, "must lie between 0 and 200"}),
      bind<&C::watchdog_s>("watchdog_s", "s", {0.001, 1.0, "must lie between 0.001 and 1"}),
      bind<&C::torque_period_s>("torque_period_s", "s", {0.0, 10.0, kUpTo10s}),
      bind<&C::torque_constant_Nm_per_A>("torque_constant_Nm_per_A", "Nm_per_A",
                                         {0.0, 10.0, kUpTo10s}),
      bind<&C::estimates>("estimates"),
      bind<&C::ask_by_remote_frame>("ask_by_remote_frame"),
      bind<&C::estimate_stale_s>("estimate_stale_s", "s",
                                 {0.001, kODriveLongest_s, "must lie between 0.001 and 10"}),
      bind<&C::estimate_lost_s>("estimate_lost_s", "s"),
      bind<&C::heartbeat_lost_s>("heartbeat_lost_s", "s"),
      bind<&C::bring_up_s>("bring_up_s", "s"),
      bind<&C::poll_period_s>("poll_period_s", "s", {0.0, kODriveLongest_s, kUpTo10s}),
      bind<&C::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

Checked check(const ODriveConfig& config) {
  if (const Checked in_range = check_ranges(config, odrive_keys()); !in_range) {
    return in_range;
  }
  if ((config.drive_speed_limit_rad_per_s > 0.0) != (config.drive_current_limit_A > 0.0)) {
    return std::unexpected(
        FieldError{"drive_current_limit_A",
                   "must be given together with drive_speed_limit_rad_per_s: one frame sets both"});
  }
  return check_deadlines(config);
}

}  // namespace tactus::drivers
