// The end of a tick of a proxy that swings, for places that are written down here.
#include "rendering/contact/implicit_stall.h"

#include <gtest/gtest.h>

namespace tactus::rendering {
namespace {

// A proxy whose place is numbered by its x.
class ImplicitStallTest : public ::testing::Test {
 protected:
  static constexpr double kTooLow_m = 0.4 * kImplicitRest_m;
  static constexpr double kOut_m = 2.0 * kImplicitReach_m;

  bool note(double place, double distance_m, double height_m = kImplicitRest_m) {
    return stall_.note({place, 0.0, 0.0}, height_m, distance_m);
  }

  ImplicitStall stall_;
};

TEST_F(ImplicitStallTest, GoesOnWhileEveryPlaceIsNearer) {
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(note(i, 0.01 - 2e-9 * i));
  }
  EXPECT_FALSE(stall_.has_swung());
}

TEST_F(ImplicitStallTest, EndsAfterFourPlacesThatAreNoNearerAtTheNearest) {
  EXPECT_FALSE(note(1.0, 0.002));
  EXPECT_FALSE(note(2.0, 0.001));
  EXPECT_FALSE(note(3.0, 0.003));
  EXPECT_TRUE(stall_.has_swung());
  EXPECT_FALSE(note(4.0, 0.002));
  EXPECT_FALSE(note(5.0, 0.003));
  EXPECT_TRUE(note(6.0, 0.002));
  EXPECT_EQ(stall_.best_O().x(), 2.0);
}

TEST_F(ImplicitStallTest, AGainOfRoundingCountsAsNoneButGivesAPlace) {
  EXPECT_FALSE(note(1.0, 0.001));
  for (int i = 1; i < 4; ++i) {
    EXPECT_FALSE(note(1.0 + i, 0.001 - 1e-13 * i));
  }
  EXPECT_TRUE(note(5.0, 0.001 - 4e-13));
  EXPECT_EQ(stall_.best_O().x(), 5.0);
}

TEST_F(ImplicitStallTest, APlaceBelowTheRestHeightIsNotTheBest) {
  EXPECT_FALSE(note(1.0, 0.002));
  EXPECT_FALSE(note(2.0, 0.001, kTooLow_m));
  EXPECT_EQ(stall_.best_O().x(), 1.0);
}

TEST_F(ImplicitStallTest, StartsOverOutOfContact) {
  note(1.0, 0.001);
  note(2.0, 0.002);
  ASSERT_TRUE(stall_.has_swung());
  EXPECT_FALSE(note(3.0, 0.003, kOut_m));
  EXPECT_FALSE(stall_.has_swung());
  EXPECT_FALSE(note(4.0, 0.004));
  EXPECT_EQ(stall_.best_O().x(), 4.0);
}

}  // namespace
}  // namespace tactus::rendering
