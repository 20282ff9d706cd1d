#include "firmware/control/force_path.h"

#include <gtest/gtest.h>

#include "firmware/safety/faults.h"
#include "tests/support/without_sign_check.h"

namespace tactus::firmware {
namespace {

// The path of a device at 1 kHz in contact, in mode `active`, with ramps of one tick by default.
class ForcePathTest : public ::testing::Test {
 protected:
  ForcePathTest() {
    touch_.contact = rendering::ContactKind::face;
    configure(testing::without_sign_check(cartesian_config()));
    touch_.force_W = {0.0, 1.0, 0.0};
  }

  void configure(ControllerConfig config, double soft_start_s = 0.0) {
    config.safety.soft_start_s = soft_start_s;
    config.safety.contact_start_s = 0.0;
    config.safety.force_slew_N_per_s = 1e6;
    guards_.configure(config);
    path_.configure(config);
    modes_.configure(kNoFault);
    modes_.advance(true, Request::home);
    modes_.advance(true, Request::enable);
    path_.restart();
    guards_.signs.restart();
    limit();  // the ramps begin at 0 and end with this tick
  }
  SafeForce limit() {
    modes_.begin_tick();
    return path_.limit({.touch = touch_, .tool = tool_, .step_s = 0.001}, guards_, modes_);
  }

  Guards guards_;
  ModeMachine modes_;
  ForcePath path_;
  rendering::Touch touch_;
  rendering::ToolState tool_;
};

TEST_F(ForcePathTest, ASmallForcePassesAsItIs) {
  EXPECT_EQ(limit().force_W, touch_.force_W);
  EXPECT_EQ(modes_.raised(), kNoFault);
}

TEST_F(ForcePathTest, ALargeForceIsCutAndNamesItsSource) {
  touch_.force_W = {0.0, 40.0, 0.0};
  touch_.parts.friction_W = {0.0, 30.0, 0.0};
  const SafeForce safe = limit();
  EXPECT_NEAR(safe.force_W.norm(), cartesian_config().safety.max_force_N, 1e-12);
  EXPECT_EQ(safe.limited_source, EnergySource::friction);
  EXPECT_TRUE(modes_.has_raised(kLimitForce));
}

TEST_F(ForcePathTest, ThereIsNoForceWithoutPower) {
  modes_.advance(true, Request::disable);
  EXPECT_EQ(limit().force_W, Vec3::Zero());
  EXPECT_EQ(modes_.raised(), kNoFault);
}

TEST_F(ForcePathTest, EnergyThatASurfaceGivesWithoutEndTakesTheForceAway) {
  touch_.force_W = {0.0, 5.0, 0.0};
  SafeForce safe;
  for (int tick = 0; tick < 1000 && modes_.mode() == Mode::active; ++tick) {
    safe = limit();
    path_.apply(safe.force_W);
    tool_.p_W.y() += 0.001;
  }
  EXPECT_EQ(modes_.faults(), kFaultNotPassive);
  EXPECT_EQ(safe.force_W, Vec3::Zero());
}

TEST_F(ForcePathTest, AWallPushesOnlyInATickThatHasFoundIt) {
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  config.safety.workspace_lower_W = {-0.1, -0.1, -0.1};
  config.safety.workspace_upper_W = {0.1, 0.1, 0.1};
  config.safety.workspace_stiffness_N_per_m = 500.0;
  configure(config);
  touch_ = {};
  tool_.p_W = {0.101, 0.0, 0.0};
  EXPECT_EQ(limit().force_W, Vec3::Zero());
  modes_.begin_tick();
  modes_.raise(guards_.walls.check(tool_.p_W));
  const SafeForce safe =
      path_.limit({.touch = touch_, .tool = tool_, .step_s = 0.001}, guards_, modes_);
  EXPECT_NEAR(safe.force_W.x(), -0.5, 1e-9);
  EXPECT_EQ(safe.limited_source, EnergySource::safety);
}

TEST_F(ForcePathTest, TheForceStaysSmallUntilTheMotorsHaveAnswered) {
  configure(cartesian_config(), 0.1);
  touch_.force_W = {0.0, 5.0, 0.0};
  SafeForce safe;
  for (int tick = 0; tick < 200; ++tick) {
    safe = limit();
  }
  // In each tick the limit rises by a tick of the soft start before it acts.
  const double rise_N = 0.01 * cartesian_config().safety.max_force_N;
  EXPECT_NEAR(safe.force_W.norm(), guards_.signs.force_limit_N() + rise_N, 1e-9);
  EXPECT_TRUE(modes_.has_raised(kLimitForce));
}

}  // namespace
}  // namespace tactus::firmware
