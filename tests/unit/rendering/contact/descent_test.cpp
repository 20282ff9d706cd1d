#include "rendering/contact/descent.h"

#include <gtest/gtest.h>

#include <array>

namespace tactus::rendering {
namespace {

TEST(Descent, GoesOnWhileEveryPlaceIsNearer) {
  Descent descent;
  double distance_m = 0.01;
  for (int move = 0; move < 1000; ++move) {
    distance_m -= 1e-9;
    ASSERT_TRUE(descent.note(distance_m, {distance_m, 0.0, 0.0}));
  }
}

TEST(Descent, EndsACycleOfThreePlacesAtTheNearest) {
  constexpr std::array<double, 3> kDistances_m{9.930685e-3, 9.930600e-3, 9.930683e-3};
  Descent descent;
  int moves = 0;
  std::size_t place = 0;
  while (descent.note(kDistances_m[place], {static_cast<double>(place), 0.0, 0.0})) {
    place = (place + 1) % kDistances_m.size();
    ASSERT_LT(++moves, 100);
  }
  EXPECT_EQ(descent.best_W(), Vec3(1.0, 0.0, 0.0));
}

TEST(Descent, LetsAMoveLeadFartherForAWhile) {
  Descent descent;
  ASSERT_TRUE(descent.note(1e-3, Vec3::Zero()));
  for (int move = 0; move < 10; ++move) {
    ASSERT_TRUE(descent.note(2e-3, Vec3::UnitX()));
  }
  EXPECT_TRUE(descent.note(0.5e-3, Vec3::UnitY()));
  EXPECT_EQ(descent.best_W(), Vec3(Vec3::UnitY()));
}

// A gain that rounding could make is none.
TEST(Descent, DoesNotCountRoundingAsAGain) {
  Descent descent;
  double distance_m = 0.01;
  int moves = 0;
  while (descent.note(distance_m, Vec3::Zero())) {
    distance_m -= 1e-13;
    ASSERT_LT(++moves, 1000);
  }
  EXPECT_LT(moves, 100);
}

}  // namespace
}  // namespace tactus::rendering
