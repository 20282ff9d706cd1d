#include "host_tools/simulation/side_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/shapes.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

using host::broadest_place;
using host::SeenFrom;
using host::SideMap;

constexpr double kRadius_m = 0.04;

Solid ball() {
  return Solid(icosphere(kRadius_m, 5), rendering::Sides::one, {});
}

TEST(SideMap, ABallIsSeenFromTheFrontAsItsUpperHalf) {
  const Solid solid = ball();
  const std::vector<double> places{-0.05, -0.03, -0.01, 0.0, 0.02, 0.05};
  const SideMap map({&solid.object(), 1}, SeenFrom::front, places, places);
  for (std::size_t row = 0; row < places.size(); ++row) {
    for (std::size_t column = 0; column < places.size(); ++column) {
      const double aside_m = std::hypot(places[column], places[row]);
      const auto z = map.at(column, row);
      if (aside_m > kRadius_m) {
        EXPECT_FALSE(z) << column << " " << row;
      } else {
        ASSERT_TRUE(z) << column << " " << row;
        EXPECT_NEAR(*z, std::sqrt(kRadius_m * kRadius_m - aside_m * aside_m), 1e-4);
      }
    }
  }
}

TEST(SideMap, FromTheRightXAndZChangePlaces) {
  const Solid solid = ball();
  const SideMap front({&solid.object(), 1}, SeenFrom::front, {0.013}, {0.021});
  const SideMap right({&solid.object(), 1}, SeenFrom::right, {0.013}, {0.021});
  EXPECT_NEAR(front.at(0, 0).value_or(0.0), right.at(0, 0).value_or(1.0), 1e-4);
}

// On a ball of radius R the front is no steeper than 45 degrees within R / sqrt(2) of the middle.
TEST(SideMap, ARunEndsWhereTheFrontIsSteep) {
  const Solid solid = ball();
  std::vector<double> across;
  for (int i = -40; i <= 40; ++i) {
    across.push_back(0.001 * i);
  }
  const SideMap map({&solid.object(), 1}, SeenFrom::front, across, {0.0});
  EXPECT_NEAR(static_cast<double>(map.run_about(40, 0).value_or(0)), 40.0 / std::sqrt(2.0), 1.5);
  EXPECT_EQ(SideMap({&solid.object(), 1}, SeenFrom::front, {0.05}, {0.0}).run_about(0, 0),
            std::nullopt);
}

// A ring lies about its middle, where there is nothing: its left and its right side are the same.
TEST(BroadestPlace, OfARingLiesOnTheRing) {
  constexpr double kRing_m = 0.03;
  constexpr double kTube_m = 0.01;
  const Solid ring(torus(kRing_m, kTube_m, 64, 32), rendering::Sides::one, {});
  const Vec3 reach(kRing_m + kTube_m, kRing_m + kTube_m, kTube_m);
  const auto place = broadest_place({&ring.object(), 1}, SeenFrom::front,
                                    rendering::Bounds{.lower_W = -reach, .upper_W = reach});
  ASSERT_TRUE(place);
  // The point is on the torus: a tube of kTube_m about the ring.
  const double out_m = place->head<2>().norm() - kRing_m;
  EXPECT_NEAR(std::hypot(place->z(), out_m), kTube_m, 2e-4);
  EXPECT_GT(place->z(), 0.0);
}

TEST(BroadestPlace, OfTwoBallsIsTheFrontOfTheLargerOne) {
  const Solid small(moved(icosphere(0.02, 4), {-0.06, 0.0, 0.0}), rendering::Sides::one, {});
  const Solid large(moved(icosphere(0.04, 4), {0.06, 0.0, 0.0}), rendering::Sides::one, {});
  const std::array objects{small.object(), large.object()};
  const auto place = broadest_place(
      objects, SeenFrom::front,
      rendering::Bounds{.lower_W = {-0.08, -0.04, -0.04}, .upper_W = {0.1, 0.04, 0.04}});
  ASSERT_TRUE(place);
  EXPECT_LT((*place - Vec3(0.06, 0.0, 0.04)).norm(), 0.004);
}

TEST(BroadestPlace, OfNothingIsNowhere) {
  EXPECT_FALSE(broadest_place({}, SeenFrom::front, rendering::Bounds{.upper_W = Vec3::Ones()}));
}

}  // namespace
}  // namespace tactus::testing
