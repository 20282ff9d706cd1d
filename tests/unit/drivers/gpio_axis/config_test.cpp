#include <functional>
#include <limits>

#include "tests/unit/drivers/gpio_axis/axis_bench.h"

namespace tactus::drivers {
namespace {

struct Broken {
  std::string_view field;
  std::function<void(GpioAxisConfig&)> breaks;
};

TEST(GpioAxisConfig, ACompleteOneIsAccepted) {
  EXPECT_TRUE(check(full_config(), false));
}

TEST(GpioAxisConfig, EveryValueOutOfRangeIsNamed) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::array<Broken, 22> all{{
      {"encoder.counts_per_rev", [](auto& c) { c.encoder.counts_per_rev = 0; }},
      {"encoder.counts_per_rev", [](auto& c) { c.encoder.counts_per_rev = 10'000'004; }},
      {"encoder.counts_per_rev", [](auto& c) { c.encoder.counts_per_rev = 2001; }},
      {"encoder.max_speed_rad_per_s", [](auto& c) { c.encoder.max_speed_rad_per_s = 0.0; }},
      {"encoder.max_speed_rad_per_s", [](auto& c) { c.encoder.max_speed_rad_per_s = kNan; }},
      {"encoder.index_state", [](auto& c) { c.encoder.index_state = 4; }},
      {"encoder.index_tolerance_counts", [](auto& c) { c.encoder.index_tolerance_counts = 501; }},
      {"encoder.velocity_window_us", [](auto& c) { c.encoder.velocity_window_us = 20'001; }},
      {"encoder.silence_torque", [](auto& c) { c.encoder.silence_torque = 1.5; }},
      {"encoder.silence_ms", [](auto& c) { c.encoder.silence_ms = 60'001; }},
      {"pins.encoder_a", [](auto& c) { c.pins.encoder_b.reset(); }},
      {"bridge.full_duty_torque_Nm", [](auto& c) { c.bridge.full_duty_torque_Nm = -1.0; }},
      {"bridge.max_torque_Nm", [](auto& c) { c.bridge.max_torque_Nm = 0.06; }},
      {"bridge.max_duty", [](auto& c) { c.bridge.max_duty = 1.1; }},
      {"bridge.pwm_period_ns", [](auto& c) { c.bridge.pwm_period_ns = 0; }},
      {"bridge.direction_dead_us", [](auto& c) { c.bridge.direction_dead_us = 100'001; }},
      {"pins.direction", [](auto& c) { c.pins.direction.reset(); }},
      {"limit_debounce_us", [](auto& c) { c.limit_debounce_us = 100'001; }},
      {"emergency_stop_release_ms", [](auto& c) { c.emergency_stop_release_ms = 10'001; }},
      {"torque_ramp_ms", [](auto& c) { c.torque_ramp_ms = 10'001; }},
      {"command_timeout_ms", [](auto& c) { c.command_timeout_ms = 0; }},
      {"edge_buffer", [](auto& c) { c.edge_buffer = 1025; }},
  }};
  for (const Broken& broken : all) {
    GpioAxisConfig config = full_config();
    broken.breaks(config);
    const auto checked = check(config, false);
    ASSERT_FALSE(checked) << broken.field;
    EXPECT_EQ(checked.error().field, broken.field);
    EXPECT_FALSE(checked.error().rule.empty());
  }
}

TEST(GpioAxisConfig, LockedAntiphaseNeedsAnEnable) {
  GpioAxisConfig config = full_config();
  config.bridge.mode = BridgeMode::locked_antiphase;
  config.pins.enable.reset();
  const auto checked = check(config, false);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().field, "pins.enable");
}

TEST(GpioAxisConfig, OverACounterTheChannelsAreNotOurs) {
  EXPECT_FALSE(check(full_config(), true));
  GpioAxisConfig config = full_config();
  config.pins.encoder_a.reset();
  config.pins.encoder_b.reset();
  config.pins.encoder_index.reset();
  EXPECT_TRUE(check(config, true));
  EXPECT_FALSE(check(config, false));
}

}  // namespace
}  // namespace tactus::drivers
