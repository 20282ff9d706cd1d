#include "firmware/commissioning/joint_trial.h"

#include <gtest/gtest.h>

#include "firmware/commissioning/trial_verdict.h"

namespace tactus::firmware {
namespace {

constexpr double kStep_s = 0.001;

// A free mass of 0.1 kg on the first of two joints; `gain` times the effort moves it.
class Rig {
 public:
  explicit Rig(double gain = 1.0) : gain_(gain) {}

  // The efforts until the trial ends, or for so many ticks.
  void run(JointTrial& trial, int ticks) {
    for (int i = 0; i < ticks && trial.end() == TrialEnd::running; ++i) {
      const double effort = trial.tick(sample);
      largest_effort = std::max(largest_effort, std::abs(effort));
      v_ += gain_ * effort / kMass_kg * kStep_s;
      sample.position[moved_joint] += v_ * kStep_s;
    }
  }

  drivers::JointSample sample;
  std::size_t moved_joint = 0;
  double largest_effort = 0.0;

 private:
  static constexpr double kMass_kg = 0.1;
  double gain_;
  double v_ = 0.0;
};

TrialConfig config() {
  return {.joint = 0,
          .rate_hz = 1.0 / kStep_s,
          .first_effort = 0.1,
          .most_effort = 5.0,
          .wanted_travel = 0.002,
          .largest_travel = 0.03};
}

JointExpectation expectation() {
  return {.inertia = 0.1, .lower = -0.25, .upper = 0.25, .range = {0.5, 0.5}};
}

TEST(JointTrialTest, GrowsItsPulseUntilTheJointMovesFarEnoughAndNoMore) {
  JointTrial trial(config());
  Rig rig;
  rig.run(trial, 10000);
  EXPECT_EQ(trial.end(), TrialEnd::measured);
  EXPECT_GE(trial.fit().travel, 0.002);
  EXPECT_LT(trial.fit().travel, 0.004);
  EXPECT_EQ(judge_trial(trial, 0, expectation()), Verdict::passed);
}

TEST(JointTrialTest, EndsAtOnceWhereTheJointGoesTooFar) {
  JointTrial trial(config());
  Rig rig(500.0);
  rig.run(trial, 10000);
  EXPECT_EQ(trial.end(), TrialEnd::went_too_far);
  EXPECT_EQ(trial.tick(rig.sample), 0.0);
  EXPECT_LT(std::abs(rig.sample.position[0]), 0.05);
  EXPECT_EQ(judge_trial(trial, 0, expectation()), Verdict::went_too_far);
}

TEST(JointTrialTest, EndsAtOnceWhereTheDeviceIsInTrouble) {
  JointTrial trial(config());
  Rig rig;
  rig.run(trial, 300);
  rig.sample.status = drivers::kDeviceDriveFault;
  EXPECT_EQ(trial.tick(rig.sample), 0.0);
  EXPECT_EQ(trial.end(), TrialEnd::sample_bad);
  EXPECT_EQ(judge_trial(trial, 0, expectation()), Verdict::sample_bad);
}

TEST(JointTrialTest, TellsAMotorThatMovesAnotherJointFromOneThatMovesNothing) {
  JointTrial nothing(config());
  Rig still(0.0);
  still.run(nothing, 100000);
  EXPECT_EQ(nothing.end(), TrialEnd::no_motion);
  EXPECT_EQ(judge_trial(nothing, 0, expectation()), Verdict::no_motion);
  EXPECT_EQ(still.largest_effort, 5.0);

  JointTrial other(config());
  Rig exchanged;
  exchanged.moved_joint = 1;
  exchanged.run(other, 100000);
  EXPECT_EQ(judge_trial(other, 0, expectation()), Verdict::moves_another);
}

TEST(JointTrialTest, NeverPushesAJointThatDoesNotComeToRest) {
  JointTrial trial(config());
  drivers::JointSample sample;
  for (int i = 0; i < 20000; ++i) {
    sample.position[0] = 1e-5 * i;
    EXPECT_EQ(trial.tick(sample), 0.0);
  }
  EXPECT_EQ(trial.end(), TrialEnd::never_still);
}

}  // namespace
}  // namespace tactus::firmware
