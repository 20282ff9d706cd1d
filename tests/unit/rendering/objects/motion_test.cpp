#include "rendering/objects/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tactus::rendering {
namespace {

TEST(Motion, IsAtRestWhereTheScenePutsItAtTheStart) {
  const Motion motion{.velocity_W = {1, 2, 3},
                      .sway_W = {1, 0, 0},
                      .sway_Hz = 2.0,
                      .spin_W = {0, 0, 5},
                      .pivot_W = {0.3, 0.1, 0.0}};
  const Placement at = place_at(motion, 0.0);
  EXPECT_EQ(at.X_WO.rotation, Mat3::Identity());
  EXPECT_EQ(at.X_WO.translation, Vec3::Zero());
}

TEST(Motion, GoesStraightToAndFroAndRoundItsPivot) {
  const Motion straight{.velocity_W = {0.1, 0.0, -0.2}};
  EXPECT_LE((place_at(straight, 3.0).X_WO.translation - Vec3(0.3, 0.0, -0.6)).norm(), 1e-15);
  const Motion sway{.sway_W = {0.0, 0.02, 0.0}, .sway_Hz = 0.5};
  EXPECT_NEAR(place_at(sway, 0.5).X_WO.translation.y(), 0.02, 1e-15);
  EXPECT_NEAR(place_at(sway, 1.5).X_WO.translation.y(), -0.02, 1e-15);
  const Motion spin{.spin_W = {0.0, 0.0, M_PI_2}, .pivot_W = {0.1, 0.0, 0.0}};
  const RigidPose quarter = place_at(spin, 1.0).X_WO;
  EXPECT_LE((quarter.point({0.1, 0.0, 0.0}) - Vec3(0.1, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_LE((quarter.point({0.3, 0.0, 0.0}) - Vec3(0.1, 0.2, 0.0)).norm(), 1e-15);
}

// The oracle is the difference of two places.
TEST(Motion, ItsTwistIsTheChangeOfItsPlace) {
  const Motion motion{.velocity_W = {0.1, 0.2, -0.1},
                      .sway_W = {0.02, 0, 0.01},
                      .sway_Hz = 3.0,
                      .spin_W = {4.0, -2.0, 5.0},
                      .pivot_W = {0.3, 0.1, 0.2}};
  constexpr double kStep_s = 1e-6;
  const Vec3 point_O(0.05, -0.03, 0.02);
  for (double t = 0.1; t < 2.0; t += 0.13) {
    const Placement at = place_at(motion, t);
    const Vec3 difference = (place_at(motion, t + kStep_s).X_WO.point(point_O) -
                             place_at(motion, t - kStep_s).X_WO.point(point_O)) /
                            (2.0 * kStep_s);
    const Vec3 from_origin = at.X_WO.direction(point_O);
    EXPECT_LE((at.twist.at(from_origin) - difference).norm(), 1e-6) << "t " << t;
    EXPECT_LE((at.X_WO.rotation.transpose() * at.X_WO.rotation - Mat3::Identity()).norm(), 1e-14);
  }
}

TEST(Motion, AWaveRunsAlongItsDirection) {
  const Motion wave{.wave_m = 0.002, .wave_Hz = 2.0, .wave_per_m = {10.0, 0.0, 0.0}};
  const auto height = [&](const Vec3& rest_O, double t_s) {
    return wave_at(wave, wave_angle(wave, rest_O), wave_angle(wave, t_s));
  };
  EXPECT_NEAR(height({0.0, 0.5, 0.0}, 0.125), 0.002, 1e-15);
  EXPECT_NEAR(height({0.05, 0.0, 0.0}, 0.375), 0.002, 1e-15);
  EXPECT_NEAR(height({0.025, 0.0, 0.0}, 0.0), -0.002, 1e-15);
  for (double t_s = 0.0; t_s < 2.0; t_s += 0.01) {
    EXPECT_NEAR(height({0.033, 0.1, 0.2}, t_s),
                0.002 * std::sin(2.0 * std::numbers::pi * (2.0 * t_s - 0.33)), 1e-15);
  }
}

TEST(Motion, RefusesNumbersThatAreNone) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(valid(Motion{}));
  EXPECT_FALSE(valid(Motion{.velocity_W = {kNone, 0, 0}}));
  EXPECT_FALSE(valid(Motion{.sway_W = {200, 0, 0}}));
  EXPECT_FALSE(valid(Motion{.sway_Hz = -1.0}));
  EXPECT_FALSE(valid(Motion{.spin_W = {0, kNone, 0}}));
  EXPECT_FALSE(valid(Motion{.wave_m = kNone}));
  EXPECT_FALSE(valid(Motion{.wave_Hz = std::numeric_limits<double>::infinity()}));
}

}  // namespace
}  // namespace tactus::rendering
