#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "rendering/world/world.h"
#include "tests/unit/rendering/detail/shaded_solid.h"

namespace tactus::rendering {
namespace {

using testing::ShadedSolid;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr Material kFrictionless{.stiffness_N_per_m = 1000.0};

class Hand {
 public:
  Hand(const Object& object, double radius_m) : object_(object) {
    EXPECT_TRUE(world_->set_scene({&object_, 1}, {.tool_radius_m = radius_m}));
  }
  Touch touch(const Vec3& tool, ProxyPath* path = nullptr) {
    return world_->touch({.p_W = tool}, path);
  }

 private:
  Object object_;
  std::unique_ptr<World> world_ = std::make_unique<World>();
};

constexpr int kSides = 16;
constexpr double kRadius_m = 0.02;
constexpr double kStep_deg = 0.05;

// Directions of the force, in degrees about the axis, as the tool goes round the prism.
std::vector<double> directions(const Object& object, double radius_m, double depth_m) {
  Hand hand(object, radius_m);
  const double at = kRadius_m * std::cos(std::numbers::pi / kSides) + radius_m - depth_m;
  hand.touch({kRadius_m + 2.0 * radius_m + 0.001, 0.0, 0.0});
  std::vector<double> result;
  for (int i = 0; i < static_cast<int>(400.0 / kStep_deg); ++i) {
    const double angle = kStep_deg * i * kDegree;
    const Touch t = hand.touch({at * std::cos(angle), at * std::sin(angle), 0.0});
    EXPECT_NEAR(t.force_W.z(), 0.0, 1e-3);
    result.push_back(std::atan2(t.force_W.y(), t.force_W.x()) / kDegree);
  }
  result.erase(result.begin(), result.begin() + static_cast<int>(40.0 / kStep_deg));
  return result;
}

// The most that the direction turns while the tool travels one degree.
double largest_turn_per_degree(const std::vector<double>& directions) {
  const auto window = static_cast<std::size_t>(1.0 / kStep_deg);
  double largest = 0.0;
  for (std::size_t i = window; i < directions.size(); ++i) {
    largest =
        std::max(largest, std::abs(std::remainder(directions[i] - directions[i - window], 360.0)));
  }
  return largest;
}

TEST(ForceShading, ASixteenSidedCylinderTurnsTheForceTenTimesMoreEvenly) {
  const ShadedSolid cylinder(testing::prism(kSides, kRadius_m, 0.04), 40.0, kFrictionless);
  for (const double radius_m : {0.0, 0.002}) {
    for (const double depth_m : {0.0005, 0.001, 0.002}) {
      const double faceted =
          largest_turn_per_degree(directions(cylinder.flat(), radius_m, depth_m));
      const double shaded =
          largest_turn_per_degree(directions(cylinder.shaded(), radius_m, depth_m));
      std::printf(
          "radius %.1f mm, depth %.1f mm: largest turn in a degree of travel %.2f deg "
          "faceted, %.2f deg shaded, ratio %.1f\n",
          1e3 * radius_m, 1e3 * depth_m, faceted, shaded, faceted / shaded);
      EXPECT_GE(faceted / shaded, 10.0);
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
