// A controller over a floor, and where its tool is put.
#pragma once

#include <gtest/gtest.h>

#include <array>

#include "firmware/control/controller.h"
#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {

inline constexpr rendering::Material kRubber = {
    .stiffness_N_per_m = 500.0, .damping_Ns_per_m = 0.0, .friction = {}};

inline drivers::JointSample at(double x, double y, double z) {
  drivers::JointSample sample;
  sample.position = {x, y, z};
  return sample;
}

inline const drivers::JointSample kAbove = at(0.01, 0.05, 0.02);
inline const drivers::JointSample kPressed = at(0.01, -0.004, 0.02);  // 4 mm deep: 2 N

// The proxy stands off by the contact skin, below 1 um: below 0.5 mN.
inline constexpr double kSkin_m = 1e-6;
inline constexpr double kSkinForce_N = 500.0 * kSkin_m;

inline bool is_zero(const drivers::JointCommand& command) {
  return !command.enable && command.effort == std::array<double, drivers::kMaxJoints>{};
}

// The samples of these tests are where they are needed, without a way between them.
inline ControllerConfig teleporting_config() {
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  config.safety.max_joint_speed = 1e6;
  return config;
}

// A Cartesian device over the floor at y = 0.
class ControllerTest : public ::testing::Test {
 protected:
  ControllerTest() {
    EXPECT_TRUE(controller_.configure(teleporting_config()));
    EXPECT_TRUE(controller_.load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  }

  // Leaves the controller active and at rest, above the floor.
  void activate() {
    controller_.tick(kAbove, Request::home);
    controller_.tick(kAbove, Request::none);
    controller_.tick(kAbove, Request::enable);
    ASSERT_EQ(controller_.mode(), Mode::active);
  }

  void press_until_steady() {
    activate();
    for (int tick = 0; tick < 1000; ++tick) {
      controller_.tick(kAbove, Request::none);
    }
    for (int tick = 0; tick < 100; ++tick) {
      last_ = controller_.tick(kPressed, Request::none);
    }
    ASSERT_NEAR(last_.effort[1], 2.0, kSkinForce_N);
    ASSERT_EQ(controller_.record().limits, 0U);
  }

  Floor floor_{kRubber};
  Controller controller_;
  drivers::JointCommand last_;
};

}  // namespace tactus::firmware
