#include "firmware/control/parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "firmware/control/controller.h"
#include "firmware/control/parameter_name.h"
#include "firmware/safety/faults.h"
#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

constexpr rendering::Material kSoftRubber = {.stiffness_N_per_m = 500.0,
                                             .damping_Ns_per_m = 0.0,
                                             .friction = rendering::cone_friction(0.6, 0.4)};
constexpr ParameterPlace kMaxForce{.parameter = Parameter::max_force};
constexpr ParameterPlace kStiffness{.parameter = Parameter::stiffness, .object = 0};

drivers::JointSample at_height(double y) {
  drivers::JointSample sample;
  sample.position = {0.01, y, 0.02};
  return sample;
}

// A Cartesian device over a floor at y = 0.
class ParametersTest : public ::testing::Test {
 protected:
  ParametersTest() {
    EXPECT_TRUE(controller_.configure(testing::without_sign_check(cartesian_config())));
    EXPECT_TRUE(controller_.load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  }

  void press() {
    controller_.tick(at_height(0.05), Request::home);
    controller_.tick(at_height(0.05), Request::none);
    controller_.tick(at_height(0.05), Request::enable);
    for (int tick = 0; tick < 1000; ++tick) {
      controller_.tick(at_height(-0.004), Request::none);
    }
    ASSERT_EQ(controller_.mode(), Mode::active);
  }

  ParameterRefusal refusal(const ParameterPlace& place, double value) {
    const auto done = controller_.set_parameter({.place = place, .value = value});
    EXPECT_FALSE(done);
    return done ? ParameterRefusal{} : done.error();
  }

  Floor floor_{kSoftRubber};
  Controller controller_;
};

// 2 N at 4 mm: 10 N in the 0.5 s of the soft start are 20 mN a tick.
TEST_F(ParametersTest, ANewStiffnessComesInUnderAPressedToolAsTheForceDoesAtActivation) {
  press();
  ASSERT_NEAR(controller_.record().force_commanded_W[1], 2.0, 1e-3);
  const auto event = controller_.set_parameter({.place = kStiffness, .value = 1000.0});
  ASSERT_TRUE(event);
  EXPECT_EQ(controller_.parameter(kStiffness)->value, 1000.0);
  for (int tick = 1; tick <= 110; ++tick) {
    controller_.tick(at_height(-0.004), Request::none);
    if (tick == 1) {
      EXPECT_EQ(controller_.record().tick, event->tick);
      EXPECT_EQ(controller_.record().change.place, kStiffness);
      EXPECT_EQ(controller_.record().change.value, 1000.0);
    } else {
      EXPECT_EQ(controller_.record().change.place.parameter, Parameter::none);
    }
    EXPECT_NEAR(controller_.record().force_commanded_W[1], std::min(4.0, 2.0 + 0.02 * tick), 2e-3);
    if (tick < 99 || tick > 101) {
      EXPECT_EQ((controller_.record().limits & kLimitChange) != 0, tick < 99) << tick;
    }
  }
}

TEST_F(ParametersTest, TheStiffestSurfaceUnderAPressedToolTakesTheSoftStartToReachTheLargestForce) {
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  config.safety.guards_off = kFaultTorqueWithoutMotion;  // this joint never moves
  ASSERT_TRUE(controller_.configure(config));
  press();
  ASSERT_TRUE(controller_.set_parameter({.place = kStiffness, .value = 1e6}));
  double last_N = controller_.record().force_commanded_W[1];
  for (int tick = 0; tick < 1000; ++tick) {
    controller_.tick(at_height(-0.004), Request::none);
    const double force_N = controller_.record().force_commanded_W[1];
    ASSERT_LE(force_N, last_N + 0.02 + 1e-9) << tick;
    last_N = force_N;
  }
  EXPECT_NEAR(last_N, 10.0, 1e-9);
}

TEST_F(ParametersTest, AStiffnessThatIsSetOutOfContactIsThereAtTheNextTouch) {
  press();
  for (int tick = 0; tick < 10; ++tick) {
    controller_.tick(at_height(0.01), Request::none);
  }
  ASSERT_TRUE(controller_.set_parameter({.place = kStiffness, .value = 1000.0}));
  controller_.tick(at_height(0.01), Request::none);
  EXPECT_EQ(controller_.record().limits & kLimitChange, 0U);
  for (int tick = 0; tick < 10; ++tick) {
    controller_.tick(at_height(-0.004), Request::none);
  }
  EXPECT_NEAR(controller_.record().force_commanded_W[1], 4.0, 2e-3);
}

TEST_F(ParametersTest, ALargestForceThatIsRaisedUnderAPressedToolComesInAsAtActivation) {
  press();
  ASSERT_TRUE(controller_.set_parameter({.place = kMaxForce, .value = 0.5}));
  for (int tick = 0; tick < 10; ++tick) {
    controller_.tick(at_height(-0.004), Request::none);
  }
  ASSERT_TRUE(controller_.set_parameter({.place = kMaxForce, .value = 10.0}));
  for (int tick = 1; tick <= 200; ++tick) {
    controller_.tick(at_height(-0.004), Request::none);
    EXPECT_NEAR(controller_.record().force_commanded_W[1], std::min(2.0, 0.5 + 0.02 * tick), 1e-3);
  }
}

TEST_F(ParametersTest, ALowerForceLimitHoldsWithoutAnotherSoftStart) {
  press();
  ASSERT_TRUE(controller_.set_parameter({.place = kMaxForce, .value = 1.0}));
  for (int tick = 0; tick < 2; ++tick) {
    controller_.tick(at_height(-0.004), Request::none);
  }
  EXPECT_NEAR(controller_.record().force_commanded_W[1], 1.0, 1e-9);
  EXPECT_EQ(controller_.record().limits, kLimitForce);
}

TEST_F(ParametersTest, SafetyGetsGentlerThanConfiguredAndNeverHarder) {
  const SafetyConfig safety = cartesian_config().safety;
  EXPECT_EQ(refusal(kMaxForce, safety.max_force_N + 1.0), ParameterRefusal::out_of_range);
  EXPECT_EQ(refusal({.parameter = Parameter::force_slew}, safety.force_slew_N_per_s + 1.0),
            ParameterRefusal::out_of_range);
  EXPECT_EQ(refusal({.parameter = Parameter::soft_start}, 0.0), ParameterRefusal::out_of_range);
  EXPECT_TRUE(controller_.set_parameter({.place = kMaxForce, .value = 1.0}));
  EXPECT_TRUE(controller_.set_parameter({.place = kMaxForce, .value = safety.max_force_N}));
}

TEST_F(ParametersTest, RefusesWhatIsNoNumberNoParameterOrNoObject) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(kMaxForce, kNoNumber), ParameterRefusal::not_finite);
  EXPECT_EQ(refusal(kStiffness, kInfinite), ParameterRefusal::not_finite);
  EXPECT_EQ(refusal({}, 1.0), ParameterRefusal::no_such_parameter);
  EXPECT_EQ(refusal({.parameter = static_cast<Parameter>(200)}, 1.0),
            ParameterRefusal::no_such_parameter);
  EXPECT_EQ(refusal({.parameter = Parameter::stiffness, .object = 1}, 1.0),
            ParameterRefusal::no_such_object);
  EXPECT_EQ(refusal({.parameter = Parameter::viscous_friction, .object = 0}, 1.0),
            ParameterRefusal::not_of_this_model);
}

TEST_F(ParametersTest, TheFrictionAtRestStaysAboveTheOneInMotion) {
  const ParameterPlace at_rest{.parameter = Parameter::static_friction, .object = 0};
  const ParameterPlace in_motion{.parameter = Parameter::dynamic_friction, .object = 0};
  EXPECT_EQ(refusal(at_rest, 0.3), ParameterRefusal::out_of_range);
  EXPECT_EQ(refusal(in_motion, 0.7), ParameterRefusal::out_of_range);
  EXPECT_TRUE(controller_.set_parameter({.place = in_motion, .value = 0.2}));
  EXPECT_TRUE(controller_.set_parameter({.place = at_rest, .value = 0.3}));
}

TEST_F(ParametersTest, ASoftStartChangesOnlyAtRest) {
  const ParameterPlace soft_start{.parameter = Parameter::soft_start};
  EXPECT_TRUE(controller_.set_parameter({.place = soft_start, .value = 1.0}));
  press();
  EXPECT_EQ(refusal(soft_start, 2.0), ParameterRefusal::not_while_active);
}

TEST_F(ParametersTest, ANewSceneHasItsOwnMaterials) {
  ASSERT_TRUE(controller_.set_parameter({.place = kStiffness, .value = 900.0}));
  EXPECT_EQ(controller_.parameter(kStiffness)->value, 900.0);
  ASSERT_TRUE(controller_.load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  EXPECT_EQ(controller_.parameter(kStiffness)->value, 500.0);
}

TEST_F(ParametersTest, TheSameChangesAtTheSameTicksGiveTheSameHashes) {
  const auto run = [](Controller& controller, const Floor& floor) {
    EXPECT_TRUE(controller.configure(testing::without_sign_check(cartesian_config())));
    EXPECT_TRUE(controller.load_scene(floor.objects(), {.tool_radius_m = 0.0}));
    for (int tick = 0; tick < 2000; ++tick) {
      if (tick == 700) {
        EXPECT_TRUE(controller.set_parameter({.place = kStiffness, .value = 800.0}));
      }
      if (tick == 900) {
        EXPECT_TRUE(controller.set_parameter(
            {.place = {.parameter = Parameter::velocity_cutoff}, .value = 200.0}));
      }
      const Request request = tick == 0   ? Request::home
                              : tick == 5 ? Request::enable
                                          : Request::none;
      controller.tick(at_height(tick < 20 ? 0.01 : -0.001 * (tick % 5)), request);
    }
    return controller.record().state_hash;
  };
  Controller again;
  EXPECT_EQ(run(controller_, floor_), run(again, floor_));
}

TEST(ParameterName, EveryNameIsReadAsItIsWritten) {
  for (const ParameterText& text : kParameterTexts) {
    const ParameterPlace place{.parameter = text.parameter, .object = 4294967295U};
    std::array<char, kMaxParameterName> room{};
    const auto name = parse_parameter_name(write_parameter_name(place, room));
    ASSERT_TRUE(name) << text.name;
    EXPECT_EQ(name->parameter, text.parameter);
    EXPECT_EQ(name->object, is_of_object(text.parameter) ? "4294967295" : "");
  }
}

TEST(ParameterName, OnlyDigitsAreAnObjectsNumber) {
  EXPECT_EQ(object_number("17"), 17U);
  EXPECT_FALSE(object_number(""));
  EXPECT_FALSE(object_number("17a"));
  EXPECT_FALSE(object_number("-1"));
  EXPECT_FALSE(object_number("4294967296"));
}

TEST(Parameters, StandInOrderOfTheirNumbers) {
  for (std::size_t i = 1; i < kParameterTexts.size(); ++i) {
    EXPECT_LT(kParameterTexts[i - 1].parameter, kParameterTexts[i].parameter);
  }
}

}  // namespace
}  // namespace tactus::firmware
