#include "firmware/commissioning/trial_verdict.h"

#include <gtest/gtest.h>

#include <utility>

namespace tactus::firmware {
namespace {

constexpr JointExpectation kHalfAMetre = {
    .inertia = 0.1, .lower = -0.25, .upper = 0.25, .range = {0.5, 0.5, 0.0}};

TEST(TrialVerdict, OfATravelByHandIsThatOfItsRange) {
  for (const auto& [lower, upper] :
       {std::pair{-0.25, 0.25}, std::pair{-0.04, 0.04}, std::pair{-0.29, 0.29}}) {
    EXPECT_EQ(judge_travel({lower, upper}, kHalfAMetre), Verdict::passed) << lower;
  }
  // Too short, beyond one end, beyond the other, and four times as far.
  for (const auto& [lower, upper] : {std::pair{-0.03, 0.03}, std::pair{-0.25, 0.31},
                                     std::pair{-0.31, 0.25}, std::pair{-1.0, 1.0}}) {
    EXPECT_EQ(judge_travel({lower, upper}, kHalfAMetre), Verdict::travel_differs) << lower;
  }
}

// A hand moves the joint at 20 mm/s whenever it is pushed, whatever the push.
TEST(TrialVerdict, OfAJointThatAHandMovesIsUnclear) {
  JointTrial trial({.joint = 0,
                    .rate_hz = 1000.0,
                    .first_effort = 0.1,
                    .most_effort = 5.0,
                    .wanted_travel = 0.002,
                    .largest_travel = 0.03});
  drivers::JointSample sample;
  for (int tick = 0; tick < 100'000 && trial.end() == TrialEnd::running; ++tick) {
    sample.position[0] += trial.tick(sample) != 0.0 ? 2e-5 : 0.0;
  }
  EXPECT_EQ(trial.end(), TrialEnd::measured);
  EXPECT_LT(trial.fit().explained, kExplained);
  EXPECT_EQ(judge_trial(trial, 0, kHalfAMetre), Verdict::unclear);
}

}  // namespace
}  // namespace tactus::firmware
