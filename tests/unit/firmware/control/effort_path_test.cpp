#include "firmware/control/effort_path.h"

#include <gtest/gtest.h>

#include <limits>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

ControllerConfig with_friction() {
  ControllerConfig config;
  config.safety.soft_start_s = 0.0;
  config.friction.fill({.model = {.kind = rendering::FrictionKind::dahl,
                                  .coulomb = 1.0,
                                  .static_level = 1.0,
                                  .viscous_s_per_m = 2.0,
                                  .stiffness_N_per_m = 1e4},
                        .compensated_share = 0.5});
  return config;
}

// The path of a Cartesian device: its efforts are the force, N.
class EffortPathTest : public ::testing::Test {
 protected:
  EffortPathTest() { configure(cartesian_config()); }

  void configure(const ControllerConfig& config) {
    locator_.configure(config);
    path_.configure(config);
    most_N_ = config.joints[0].max_effort;
    locator_.locate(sample_);
  }
  ActiveEfforts distribute(const Vec3& force_W, double max_force_N = 100.0) {
    return path_.distribute({.sample = sample_,
                             .locator = locator_,
                             .effort = force_W,
                             .force_W = force_W,
                             .max_force_N = max_force_N,
                             .push = push_});
  }

  EffortPath path_;
  ToolLocator locator_;
  drivers::JointSample sample_;
  JointEfforts push_{};
  double most_N_ = 0.0;
};

TEST_F(EffortPathTest, AForceWithinTheLimitsGoesToTheJointsAsItIs) {
  push_[2] = 0.5;
  const ActiveEfforts efforts = distribute({1.0, 2.0, 3.0});
  EXPECT_EQ(efforts.found, kNoFault);
  EXPECT_EQ(efforts.force_W, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(efforts.all, (JointEfforts{1.0, 2.0, 3.5}));
}

TEST_F(EffortPathTest, AForceBeyondAJointIsScaledAsAWhole) {
  const ActiveEfforts efforts = distribute({2.0 * most_N_, most_N_, 0.0});
  EXPECT_EQ(efforts.found, kLimitEffort);
  EXPECT_NEAR(efforts.all[0], most_N_, 1e-12);
  EXPECT_NEAR(efforts.all[1], 0.5 * most_N_, 1e-12);
  EXPECT_NEAR(efforts.force_W.x(), most_N_, 1e-12);
}

TEST_F(EffortPathTest, ThePushOfTheSignCheckKeepsToTheJointsLimit) {
  push_[0] = 1.0;
  EXPECT_LE(distribute({most_N_, 0.0, 0.0}).all[0], most_N_);
}

TEST_F(EffortPathTest, FrictionIsCompensatedWithinWhatTheForceLeaves) {
  configure(with_friction());
  sample_.velocity[0] = 0.1;
  ActiveEfforts efforts;
  for (int tick = 0; tick < 100; ++tick) {
    sample_.position[0] += 1e-4;
    efforts = distribute({1.0, 0.0, 0.0});
  }
  EXPECT_NEAR(efforts.friction.x(), 0.5 * 1.0 + 0.5 * 2.0 * 0.1, 1e-3);
  EXPECT_EQ(efforts.all[0], 1.0 + efforts.friction.x());
  EXPECT_EQ(efforts.force_W.x(), 1.0) << "the force is without it";
  EXPECT_EQ(distribute({1.0, 0.0, 0.0}, 1.0).friction.x(), 0.0);
}

TEST_F(EffortPathTest, ARestTakesTheCompensationAway) {
  configure(with_friction());
  for (int tick = 0; tick < 100; ++tick) {
    sample_.position[0] += 1e-4;
    distribute(Vec3::Zero());
  }
  path_.rest();
  EXPECT_EQ(distribute(Vec3::Zero()).friction.x(), 0.0);
}

TEST_F(EffortPathTest, APushThatIsNoNumberIsAFaultWithoutEffort) {
  configure(with_friction());
  sample_.velocity[0] = std::numeric_limits<double>::max();
  distribute(Vec3::Zero());
  sample_.velocity[0] = -std::numeric_limits<double>::max();
  const ActiveEfforts efforts = distribute({1.0, 0.0, 0.0});
  EXPECT_EQ(efforts.found & kFaultMask, kFaultCommandNotFinite);
  EXPECT_EQ(efforts.all, JointEfforts{});
  EXPECT_EQ(efforts.friction, Vec3::Zero());
}

}  // namespace
}  // namespace tactus::firmware
