#include "hal/angle.h"

#include <gtest/gtest.h>

#include <numbers>

namespace tactus::hal {
namespace {

TEST(Angle, AFullTurnHas360Degrees) {
  EXPECT_DOUBLE_EQ(degrees_of(2.0 * std::numbers::pi), 360.0);
  EXPECT_DOUBLE_EQ(radians_of(-360.0), -2.0 * std::numbers::pi);
}

TEST(Angle, DegreesOfRadiansAreTheSameDegrees) {
  EXPECT_DOUBLE_EQ(degrees_of(radians_of(35.0)), 35.0);
}

}  // namespace
}  // namespace tactus::hal
