#include "drivers/odrive_can/odrive_config.h"

#include <gtest/gtest.h>

#include <limits>
#include <string_view>

namespace tactus::drivers {
namespace {

std::string_view refused_odrive_field(const ODriveConfig& config) {
  const Checked checked = check(config);
  return checked ? std::string_view{} : checked.error().field;
}

TEST(ODriveConfig, DefaultsAreValid) {
  EXPECT_TRUE(check(ODriveConfig{}));
}

TEST(ODriveConfig, EveryFieldOutOfItsRangeIsNamed) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused_odrive_field({.node_id = 63}), "node_id");
  EXPECT_EQ(refused_odrive_field({.max_torque_Nm = 0.0}), "max_torque_Nm");
  EXPECT_EQ(refused_odrive_field({.max_torque_Nm = kNan}), "max_torque_Nm");
  EXPECT_EQ(refused_odrive_field({.max_torque_Nm = 101.0}), "max_torque_Nm");
  EXPECT_EQ(refused_odrive_field({.max_speed_rad_per_s = 0.0}), "max_speed_rad_per_s");
  EXPECT_EQ(refused_odrive_field({.jump_margin_rad = -1.0}), "jump_margin_rad");
  EXPECT_EQ(refused_odrive_field({.drive_speed_limit_rad_per_s = -1.0}),
            "drive_speed_limit_rad_per_s");
  EXPECT_EQ(refused_odrive_field({.drive_current_limit_A = kNan}), "drive_current_limit_A");
  EXPECT_EQ(refused_odrive_field({.drive_speed_limit_rad_per_s = 100.0}), "drive_current_limit_A");
  EXPECT_EQ(refused_odrive_field({.estimate_stale_s = 0.0}), "estimate_stale_s");
  EXPECT_EQ(refused_odrive_field({.estimate_stale_s = 0.01}), "estimate_lost_s");
  EXPECT_EQ(refused_odrive_field({.heartbeat_lost_s = 0.001}), "heartbeat_lost_s");
  EXPECT_EQ(refused_odrive_field({.bring_up_s = 0.1}), "bring_up_s");
  EXPECT_EQ(refused_odrive_field({.poll_period_s = -0.1}), "poll_period_s");
}

}  // namespace
}  // namespace tactus::drivers
