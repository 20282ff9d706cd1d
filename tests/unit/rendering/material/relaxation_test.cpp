#include "rendering/material/relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tactus::rendering {
namespace {

constexpr double kFast_m = 1e-3;
const Vec3 kResidual{1e-3, 2e-3, -1e-3};

TEST(Relaxation, AMovingToolTakesWholeStepsAtFirst) {
  Relaxation relaxation;
  relaxation.begin_tick(kFast_m, false);
  EXPECT_EQ(relaxation.share_of(kResidual), 1.0);
  EXPECT_FALSE(relaxation.is_at_rest());
}

// A residual that falls by s times the step is zero after the share 1 / s.
TEST(Relaxation, TwoResidualsOfALineGiveTheStepToItsZero) {
  for (const double slope : {0.5, 1.5, 2.0, 5.0, 18.0}) {
    Relaxation relaxation;
    relaxation.begin_tick(kFast_m, false);
    const double first = relaxation.share_of(kResidual);
    const double second = relaxation.share_of((1.0 - slope * first) * kResidual);
    EXPECT_NEAR(second, std::min(1.0, 1.0 / slope), 1e-12) << slope;
  }
}

TEST(Relaxation, StepsUnderAToolAtRestBecomeShorterUntilNoneIsTaken) {
  Relaxation relaxation;
  relaxation.begin_tick(kFast_m, false);
  double share = 1.0;
  int ticks = 0;
  for (; !relaxation.is_at_rest(); ++ticks) {
    relaxation.restart();
    const double next = relaxation.share_of(kResidual);
    EXPECT_LE(next, share);
    share = next;
    relaxation.begin_tick(0.0, false);
  }
  EXPECT_EQ(ticks, 43);
  relaxation.begin_tick(kFast_m, false);
  EXPECT_FALSE(relaxation.is_at_rest());
  EXPECT_EQ(relaxation.share_of(kResidual), 1.0);
}

TEST(Relaxation, ASlowToolIsNeverAtRest) {
  Relaxation relaxation;
  for (int tick = 0; tick < 1000; ++tick) {
    relaxation.begin_tick(1e-8, false);
  }
  EXPECT_FALSE(relaxation.is_at_rest());
}

}  // namespace
}  // namespace tactus::rendering
