#include "rendering/geometry/capsule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tactus::rendering {
namespace {

TEST(Capsule, ALineLeavesItWhereItsDepthIsZeroAndNotBefore) {
  constexpr std::uint64_t kSeed = 7;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> signed_unit(-1.0, 1.0);
  const auto vector = [&] {
    return Vec3{signed_unit(random), signed_unit(random), signed_unit(random)};
  };
  int inside = 0;
  for (int k = 0; k < 100'000; ++k) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(k));
    const Vec3 axis = k % 5 == 0 ? Vec3{Vec3::Zero()} : vector();
    const Capsule capsule{.start = vector(), .axis = axis, .radius = std::abs(signed_unit(random))};
    const Vec3 p =
        capsule.start + capsule.radius * vector() + 0.5 * (1.0 + signed_unit(random)) * axis;
    if (capsule.depth(p) < 1e-6) {
      continue;
    }
    ++inside;
    const bool along = k % 7 == 0 && axis.norm() > 0.0;
    const Vec3 direction =
        along ? Vec3{(k % 2 == 0 ? 1.0 : -1.0) * axis.normalized()} : Vec3{vector().normalized()};
    const double travel = capsule.room_along(p, direction);
    EXPECT_NEAR(capsule.depth(p + travel * direction), 0.0, 1e-9);
    EXPECT_GT(capsule.depth(p + 0.999 * travel * direction), 0.0);
  }
  EXPECT_GT(inside, 10'000);
}

TEST(Capsule, WithoutAnAxisItIsABallAndWithoutARadiusEmpty) {
  const Capsule ball{.start = {1, 2, 3}, .radius = 0.5};
  EXPECT_DOUBLE_EQ(ball.depth({1, 2, 3.25}), 0.25);
  EXPECT_DOUBLE_EQ(ball.room_along({1, 2, 3.25}, Vec3::UnitZ()), 0.25);
  EXPECT_LT(Capsule{}.depth(Vec3::Zero()), 0.0);
}

}  // namespace
}  // namespace tactus::rendering
