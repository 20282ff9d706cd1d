#include "drivers/cia402_can/cia402_config.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace tactus::drivers {
namespace {

constexpr Cia402Config kGoodDrive{.max_torque_Nm = 0.5};

TEST(Cia402Config, DefaultsNeedATorqueLimitAndNothingElse) {
  EXPECT_TRUE(check(kGoodDrive));
  const Checked refused = check(Cia402Config{});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "max_torque_Nm");
}

TEST(Cia402Config, FieldOutOfItsRangeIsNamed) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(Cia402Config&)>>> mistakes = {
      {"node", [](auto& c) { c.node = 0; }},
      {"node", [](auto& c) { c.node = 128; }},
      {"host_node", [](auto& c) { c.host_node = 0; }},
      {"host_node", [](auto& c) { c.host_node = c.node; }},
      {"period_s", [](auto& c) { c.period_s = 0.0001; }},
      {"counts_per_turn", [](auto& c) { c.counts_per_turn = 0.0; }},
      {"counts_per_turn", [](auto& c) { c.counts_per_turn = kNan; }},
      {"max_torque_Nm", [](auto& c) { c.max_torque_Nm = -1.0; }},
      {"rated_torque_Nm", [](auto& c) { c.rated_torque_Nm = -1.0; }},
      {"rated_torque_Nm", [](auto& c) { c.rated_torque_from = RatedTorque::configured; }},
      {"max_speed_rad_per_s", [](auto& c) { c.max_speed_rad_per_s = 0.0; }},
      {"jump_margin_rad", [](auto& c) { c.jump_margin_rad = 2.0; }},
      {"velocity_unit_rad_per_s", [](auto& c) { c.velocity_unit_rad_per_s = -1.0; }},
      {"velocity_filter_s", [](auto& c) { c.velocity_filter_s = 1.0; }},
      {"watchdog_ms", [](auto& c) { c.watchdog_ms = 4; }},
      {"drive_heartbeat_ms", [](auto& c) { c.drive_heartbeat_ms = 2000; }},
      {"lost_after_s", [](auto& c) { c.lost_after_s = c.period_s; }},
      {"sdo_timeout_s", [](auto& c) { c.sdo_timeout_s = 0.0; }},
      {"bring_up_timeout_s", [](auto& c) { c.bring_up_timeout_s = 100.0; }},
      {"enable_timeout_s", [](auto& c) { c.enable_timeout_s = kNan; }},
  };
  for (const auto& [field, make] : mistakes) {
    Cia402Config config = kGoodDrive;
    make(config);
    const Checked refused = check(config);
    ASSERT_FALSE(refused) << field;
    EXPECT_EQ(refused.error().field, field);
    EXPECT_FALSE(refused.error().rule.empty());
  }
}

std::array<Cia402Config, 3> good_bus() {
  std::array<Cia402Config, 3> drives{kGoodDrive, kGoodDrive, kGoodDrive};
  for (std::uint8_t i = 0; i < 3; ++i) {
    drives[i].node = static_cast<std::uint8_t>(i + 1);
    drives[i].leads_bus = i == 0;
  }
  return drives;
}

TEST(Cia402Config, DrivesOfABusAreToldTogether) {
  EXPECT_TRUE(check_bus(good_bus()));
  const std::vector<std::pair<std::string, std::function<void(std::array<Cia402Config, 3>&)>>>
      mistakes = {
          {"leads_bus", [](auto& d) { d[0].leads_bus = false; }},
          {"leads_bus", [](auto& d) { d[2].leads_bus = true; }},
          {"node", [](auto& d) { d[2].node = 1; }},
          {"host_node", [](auto& d) { d[1].host_node = 100; }},
          {"host_node",
           [](auto& d) {
             for (Cia402Config& drive : d) {
               drive.host_node = 3;
             }
           }},
          {"period_s", [](auto& d) { d[1].period_s = 0.002; }},
          {"max_torque_Nm", [](auto& d) { d[1].max_torque_Nm = 0.0; }},
      };
  for (const auto& [field, make] : mistakes) {
    auto drives = good_bus();
    make(drives);
    const Checked refused = check_bus(drives);
    ASSERT_FALSE(refused) << field;
    EXPECT_EQ(refused.error().field, field);
  }
}

}  // namespace
}  // namespace tactus::drivers
