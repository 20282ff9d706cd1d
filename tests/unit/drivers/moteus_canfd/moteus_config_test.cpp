#include "drivers/moteus_canfd/moteus_config.h"

#include <gtest/gtest.h>

#include <limits>
#include <string_view>

namespace tactus::drivers {
namespace {

std::string_view refused_moteus_field(const MoteusConfig& config) {
  const Checked checked = check(config);
  return checked ? std::string_view{} : checked.error().field;
}

TEST(MoteusConfig, DefaultsAreValid) {
  EXPECT_TRUE(check(MoteusConfig{}));
}

TEST(MoteusConfig, EveryFieldOutOfItsRangeIsNamed) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused_moteus_field({.servo_id = 0}), "servo_id");
  EXPECT_EQ(refused_moteus_field({.servo_id = 127}), "servo_id");
  EXPECT_EQ(refused_moteus_field({.host_id = 128}), "host_id");
  EXPECT_EQ(refused_moteus_field({.servo_id = 3, .host_id = 3}), "host_id");
  EXPECT_EQ(refused_moteus_field({.prefix = 8192}), "prefix");
  EXPECT_EQ(refused_moteus_field({.max_torque_Nm = 0.0}), "max_torque_Nm");
  EXPECT_EQ(refused_moteus_field({.watchdog_s = 0.0}), "watchdog_s");
  EXPECT_EQ(refused_moteus_field({.watchdog_s = kNan}), "watchdog_s");
  EXPECT_EQ(refused_moteus_field({.max_speed_rad_per_s = kNan}), "max_speed_rad_per_s");
  EXPECT_EQ(refused_moteus_field({.jump_margin_rad = 0.0}), "jump_margin_rad");
  EXPECT_EQ(refused_moteus_field({.reply_stale_s = 0.0}), "reply_stale_s");
  EXPECT_EQ(refused_moteus_field({.reply_lost_s = 0.001}), "reply_lost_s");
  EXPECT_EQ(refused_moteus_field({.bring_up_s = 0.001}), "bring_up_s");
}

}  // namespace
}  // namespace tactus::drivers
