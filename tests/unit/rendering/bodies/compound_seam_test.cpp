// Parts of a body that lie side by side, against the same body of one part.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tests/unit/rendering/bodies/compound_bench.h"

namespace tactus::rendering {
namespace {

// A box, and the same box of two halves.
struct WholeAndHalves {
  Vec3 half{0.02, 0.01, 0.015};
  BodyBench whole;
  BodyBench halves;

  void add(const RigidPose& pose, const ContactSurface& surface) {
    constexpr double kBox_kg = 0.1;
    const Vec3 part(0.5 * half.x(), half.y(), half.z());
    whole.add(box_part(Vec3::Zero(), half), mass_of_box(kBox_kg, half), pose, surface);
    halves.add_compound({box_part(Vec3(-0.5 * half.x(), 0.0, 0.0), part),
                         box_part(Vec3(0.5 * half.x(), 0.0, 0.0), part)},
                        mass_of_box(kBox_kg, half), pose, surface);
  }
  void add_plane(const Vec3& normal, double friction) {
    whole.add_plane(normal, friction);
    halves.add_plane(normal, friction);
  }
  // Runs both, and returns the largest distance of the centres, m, with that of corners.
  double run(double seconds) {
    double most = 0.0;
    for (int i = 0; i < static_cast<int>(std::lround(seconds / kBodyTick_s)); ++i) {
      whole.run(kBodyTick_s);
      halves.run(kBodyTick_s);
      const BodyMotion& a = whole.body(0).motion();
      const BodyMotion& b = halves.body(0).motion();
      most = std::max(most, (a.center_W - b.center_W).norm() +
                                half.norm() * (a.rotation_WO - b.rotation_WO).norm());
    }
    return most;
  }
};

TEST(CompoundSeam, TwoHalvesDropAsTheWholeBox) {
  WholeAndHalves pair;
  pair.add_plane(Vec3::UnitY(), 0.5);
  pair.add({.translation = Vec3(0.0, 0.05, 0.0)}, {.friction = 0.5});
  EXPECT_LT(pair.run(0.5), 3e-4);
}

TEST(CompoundSeam, TwoHalvesSlideAsTheWholeBox) {
  const BodySlope slope{std::atan(0.4)};
  WholeAndHalves pair;
  pair.add_plane(slope.normal, 0.3);
  pair.add(slope.box_at(0.01), {.friction = 0.3});
  EXPECT_LT(pair.run(0.5), 2e-4);
  EXPECT_GT(pair.whole.body(0).motion().velocity_W.dot(slope.down), 0.3);
}

TEST(CompoundSeam, TwoHalvesTipAsTheWholeBox) {
  const BodySlope slope{std::atan(0.8)};
  WholeAndHalves pair;
  pair.half = Vec3(0.01, 0.02, 0.01);
  pair.add_plane(slope.normal, 1.5);
  pair.add(slope.box_at(0.02), {.friction = 1.5});
  EXPECT_LT(pair.run(0.15), 2e-4);
  EXPECT_LT(pair.whole.body(0).motion().rotation_WO.col(1).dot(slope.normal), 0.9);
}

// Parts that stand in one plane have the points of a whole box, four between two storeys.
TEST(CompoundSeam, ATowerOfHalvesStandsStill) {
  constexpr std::size_t kStoreys = 8;
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), 0.5);
  const Vec3 part(0.0095, 0.01, 0.02);
  for (std::size_t i = 0; i < kStoreys; ++i) {
    bench.add_compound(
        {box_part(Vec3(-0.0105, 0.0, 0.0), part), box_part(Vec3(0.0105, 0.0, 0.0), part)},
        mass_of_box(0.05, Vec3(0.02, 0.01, 0.02)),
        {.translation = Vec3(0.0, 0.01 + 0.02 * static_cast<double>(i), 0.0)}, {.friction = 0.5});
  }
  bench.run(1.0);
  const Vec3 settled = bench.body(kStoreys - 1).motion().center_W;
  bench.run(5.0);
  const BodyMotion& top = bench.body(kStoreys - 1).motion();
  EXPECT_LT((top.center_W - settled).norm(), 1e-5);
  EXPECT_LT(top.velocity_W.norm(), 1e-6);
  EXPECT_EQ(bench.world().point_count(), 4 * kStoreys);
  EXPECT_FALSE(bench.world().has_left_out_contacts());
}

// A box of a part or two, and a ball, that slide without friction over the seams of a plate.
TEST(CompoundSeam, NothingCatchesAtTheSeamOfTwoParts) {
  constexpr double kSpeed = 0.2;
  const Vec3 half(0.01, 0.01, 0.01);
  const BodyMass mass = mass_of_box(0.05, half);
  const RigidPose pose{.translation = Vec3(-0.03, 0.03, 0.0)};
  const Vec3 velocity(kSpeed, 0.0, 0.0);
  for (const double overlap : {0.0, 0.01}) {
    for (int kind = 0; kind < 3; ++kind) {
      BodyBench bench;
      bench.add_plane(Vec3::UnitY(), 0.9);
      const Vec3 part(0.05 + overlap, 0.01, 0.05);
      bench.add_compound(
          {box_part(Vec3(-0.05, 0.0, 0.0), part), box_part(Vec3(0.05, 0.0, 0.0), part)},
          mass_of_box(5.0, Vec3(0.1, 0.01, 0.05)), {.translation = Vec3(0.0, 0.01, 0.0)},
          {.friction = 0.5});
      if (kind == 0) {
        bench.add(box_part(Vec3::Zero(), half), mass, pose, {}, velocity);
      } else if (kind == 1) {
        const Vec3 narrow(0.005, 0.01, 0.01);
        bench.add_compound(
            {box_part(Vec3(-0.005, 0.0, 0.0), narrow), box_part(Vec3(0.005, 0.0, 0.0), narrow)},
            mass, pose, {}, velocity);
      } else {
        bench.add_ball(0.01, 0.05, pose.translation, {}, velocity);
      }
      bench.run(0.3);
      const BodyMotion& motion = bench.body(1).motion();
      EXPECT_NEAR(motion.velocity_W.x(), kSpeed, 0.01 * kSpeed) << overlap << ", " << kind;
      EXPECT_NEAR(motion.center_W.y(), 0.03, 2e-5) << overlap << ", " << kind;
    }
  }
}

// The wall begins where the floor ends, on it or within it.
TEST(CompoundSeam, AWallThatRisesFromAFloorStopsABox) {
  for (const double from_m : {0.0, 0.01, 0.02}) {
    for (const bool is_ball : {false, true}) {
      BodyBench bench;
      bench.add_plane(Vec3::UnitY(), 0.9);
      const double half_m = 0.5 * (0.03 - from_m);
      bench.add_compound({box_part(Vec3(0.0, 0.01, 0.0), Vec3(0.1, 0.01, 0.05)),
                          box_part(Vec3(0.05, 0.03 - half_m, 0.0), Vec3(0.005, half_m, 0.05))},
                         mass_of_box(5.0, Vec3(0.1, 0.01, 0.05)), {}, {.friction = 0.5});
      const Vec3 start(0.02, 0.03, 0.0);
      if (is_ball) {
        bench.add_ball(0.01, 0.05, start, {}, Vec3(0.3, 0.0, 0.0));
      } else {
        bench.add_box(Vec3(0.01, 0.01, 0.01), 0.05, {.translation = start}, 0.0,
                      Vec3(0.3, 0.0, 0.0));
      }
      bench.run(0.5);
      EXPECT_NEAR(bench.body(1).motion().center_W.x(), 0.035, 2e-4) << from_m << ", " << is_ball;
      EXPECT_NEAR(bench.body(1).motion().center_W.y(), 0.03, 2e-4) << from_m << ", " << is_ball;
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
