#include "drivers/odrive_can/odrive_config.h"

#include "drivers/odrive_can/odrive_protocol.h"

namespace tactus::drivers {

namespace {

Checked check_deadlines(const ODriveConfig& config) {
  constexpr double kShortest_s = 0.001;
  constexpr double kLongest_s = 10.0;
  if (!lies_between(config.estimate_stale_s, kShortest_s, kLongest_s)) {
    return std::unexpected(FieldError{"estimate_stale_s", "must lie between 0.001 and 10"});
  }
  if (!lies_between(config.estimate_lost_s, config.estimate_stale_s, kLongest_s)) {
    return std::unexpected(
        FieldError{"estimate_lost_s", "must lie between estimate_stale_s and 10"});
  }
  if (!lies_between(config.heartbeat_lost_s, config.estimate_lost_s, kLongest_s)) {
    return std::unexpected(
        FieldError{"heartbeat_lost_s", "must lie between estimate_lost_s and 10"});
  }
  if (!lies_between(config.bring_up_s, config.heartbeat_lost_s, kLongest_s)) {
    return std::unexpected(FieldError{"bring_up_s", "must lie between heartbeat_lost_s and 10"});
  }
  if (!lies_between(config.poll_period_s, 0.0, kLongest_s)) {
    return std::unexpected(FieldError{"poll_period_s", "must lie between 0 and 10"});
  }
  return {};
}

}  // namespace

Checked check(const ODriveConfig& config) {
  if (config.node_id > odrive::kMaxNode) {
    return std::unexpected(FieldError{"node_id", "must lie between 0 and 62"});
  }
  if (!lies_between(config.max_torque_Nm, 1e-6, 100.0)) {
    return std::unexpected(FieldError{"max_torque_Nm", "must be above 0 and at most 100"});
  }
  if (!lies_between(config.max_speed_rad_per_s, 0.1, 10'000.0)) {
    return std::unexpected(FieldError{"max_speed_rad_per_s", "must lie between 0.1 and 10000"});
  }
  if (!lies_between(config.jump_margin_rad, 1e-6, 3.0)) {
    return std::unexpected(FieldError{"jump_margin_rad", "must be above 0 and at most 3"});
  }
  if (!lies_between(config.drive_speed_limit_rad_per_s, 0.0, 100'000.0)) {
    return std::unexpected(
        FieldError{"drive_speed_limit_rad_per_s", "must lie between 0 and 100000"});
  }
  if (!lies_between(config.drive_current_limit_A, 0.0, 200.0)) {
    return std::unexpected(FieldError{"drive_current_limit_A", "must lie between 0 and 200"});
  }
  if ((config.drive_speed_limit_rad_per_s > 0.0) != (config.drive_current_limit_A > 0.0)) {
    return std::unexpected(
        FieldError{"drive_current_limit_A",
                   "must be given together with drive_speed_limit_rad_per_s: one frame sets both"});
  }
  if (!lies_between(config.watchdog_s, 0.001, 1.0)) {
    return std::unexpected(FieldError{"watchdog_s", "must lie between 0.001 and 1"});
  }
  if (!lies_between(config.torque_period_s, 0.0, 10.0)) {
    return std::unexpected(FieldError{"torque_period_s", "must lie between 0 and 10"});
  }
  if (!lies_between(config.torque_constant_Nm_per_A, 0.0, 10.0)) {
    return std::unexpected(FieldError{"torque_constant_Nm_per_A", "must lie between 0 and 10"});
  }
  return check_deadlines(config);
}

}  // namespace tactus::drivers
