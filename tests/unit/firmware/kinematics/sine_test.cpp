#include "firmware/kinematics/sine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace tactus::firmware {
namespace {

TEST(SineCosine, AgreesWithTheCLibraryOverTheWholeRange) {
  double worst = 0.0;
  for (int i = -200'000; i <= 200'000; ++i) {
    const double angle = 0.005 * i + 1e-7 * (i % 977);
    const SineCosine got = sine_cosine(angle);
    worst = std::max(
        {worst, std::abs(got.sine - std::sin(angle)), std::abs(got.cosine - std::cos(angle))});
  }
  EXPECT_LT(worst, 2.5e-16);
}

TEST(SineCosine, AgreesWithTheCLibraryBesideEveryQuarterTurn) {
  for (int quarter = -600; quarter <= 600; ++quarter) {
    for (const double side : {-1e-9, 0.0, 1e-9}) {
      const double angle = quarter * std::numbers::pi / 2.0 + side;
      EXPECT_NEAR(sine_cosine(angle).sine, std::sin(angle), 2.5e-16) << angle;
      EXPECT_NEAR(sine_cosine(angle).cosine, std::cos(angle), 2.5e-16) << angle;
    }
  }
}

TEST(SineCosine, GivesNaNBeyondItsRange) {
  for (const double angle : {1000.1, -1e300, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(std::isnan(sine_cosine(angle).sine));
    EXPECT_TRUE(std::isnan(sine_cosine(angle).cosine));
  }
}

}  // namespace
}  // namespace tactus::firmware
