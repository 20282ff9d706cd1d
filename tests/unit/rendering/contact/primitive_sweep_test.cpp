#include "rendering/contact/primitive_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "tests/support/primitive_points.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

using testing::kAllPrimitives;

double travel(const Primitive& primitive, const Vec3& from, const Vec3& to,
              const ContactMargin& margin, Sides sides = Sides::one) {
  const Vec3 motion = to - from;
  return travel_to_contact(primitive, sides, {.from = from, .direction = motion.normalized()},
                           motion.norm(), margin, sample(primitive, from));
}

// The smallest distance to the surface during the sweep, on the side given by `sign`: it is
// 1-Lipschitz, so steps as long as what is left above `floor` miss nothing but what is within
// `kResolution_m`.
double least_clearance(const Primitive& primitive, const Vec3& from, const Vec3& to, double sign,
                       double floor_m) {
  constexpr double kResolution_m = 2e-9;
  const double length = (to - from).norm();
  double least = sign * sample(primitive, to).distance_m;
  for (double at = 0.0; at < length;) {
    const double here = sign * sample(primitive, from + at / length * (to - from)).distance_m;
    least = std::min(least, here);
    at += std::max(here - floor_m, kResolution_m);
  }
  return least;
}

TEST(PrimitiveSweep, MeetsEachKindWhereTheClosedFormSays) {
  const ContactMargin margin(0.01);
  const auto check = [&](PrimitiveKind kind, std::array<double, 3> dimensions, const Vec3& from,
                         const Vec3& to, double expected) {
    const Primitive primitive{.kind = kind, .dimensions_m = dimensions};
    EXPECT_NEAR(travel(primitive, from, to, margin), expected, 2e-6) << static_cast<int>(kind);
  };
  check(PrimitiveKind::plane, {}, {0, 0.3, 0}, {0.4, 0, 0}, 0.29 / 0.6);
  check(PrimitiveKind::sphere, {0.05}, {0.2, 0, 0}, {-0.2, 0, 0}, 0.14);
  check(PrimitiveKind::box, {0.05, 0.05, 0.05}, {-0.2, 0.056, 0}, {0.2, 0.056, 0}, 0.142);
  check(PrimitiveKind::cylinder, {0.05, 0.1}, {0.2, 0, 0}, {-0.2, 0, 0}, 0.14);
  check(PrimitiveKind::capsule, {0.05, 0.1}, {0, 0.3, 0}, {0, -0.3, 0}, 0.14);
  check(PrimitiveKind::cone, {0.03, 0.04}, {0, 0.2, 0}, {0, 0, 0}, 0.15);
  check(PrimitiveKind::torus, {0.05, 0.01}, {0, 0, 0}, {0.3, 0, 0}, 0.03);
}

// It comes as near as between inner and stop. A stop that is behind the nearest place would hold a
// sphere by a plane that it goes away from.
TEST(PrimitiveSweep, DoesNotStopWhatHasPassed) {
  constexpr double kRadius_m = 0.05;
  int passes = 0;
  for (const PrimitiveKind kind :
       {PrimitiveKind::sphere, PrimitiveKind::cylinder, PrimitiveKind::capsule}) {
    const Primitive primitive{.kind = kind, .dimensions_m = {kRadius_m, 0.1}};
    for (const double radius_m : {0.0, 0.001, 0.004}) {
      const ContactMargin margin(radius_m);
      for (int i = 1; i < 200; ++i) {
        const double nearest = margin.inner_m + (margin.stop_m - margin.inner_m) * i / 200;
        for (const double before : {1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 5e-2}) {
          const Vec3 from(-before, 0.0, kRadius_m + nearest);
          const double free = travel(primitive, from, from + Vec3(1.0, 0.0, 0.0), margin);
          ASSERT_TRUE(free < before || free == 1.0)
              << "kind " << static_cast<int>(kind) << " radius " << radius_m << " nearest "
              << nearest << " from " << before << ": stopped " << free - before
              << " m behind the nearest place";
          passes += free == 1.0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(passes, 1'000);
}

TEST(PrimitiveSweep, NeverGoesTooFarAndNeverStopsForNothing) {
  constexpr std::uint64_t kSeed = 41;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  const auto point = [&] { return Vec3{place(random), place(random), place(random)}; };
  for (int i = 0; i < testing::share_of(40'000); ++i) {
    const PrimitiveKind kind = kAllPrimitives[static_cast<std::size_t>(i) % kAllPrimitives.size()];
    SCOPED_TRACE("seed 41, case " + std::to_string(i));
    const Primitive primitive = testing::random_primitive(kind, random);
    const ContactMargin margin(i % 3 == 0 ? 0.0 : 0.003);
    const Vec3 from = point();
    const Vec3 to = point();
    const double start = sample(primitive, from).distance_m;
    if (std::abs(start) < margin.rest_m) {
      continue;
    }
    const double length = (to - from).norm();
    const double free = travel(primitive, from, to, margin, Sides::two);
    const Vec3 end = from + free / length * (to - from);
    const double sign = start < 0.0 ? -1.0 : 1.0;
    ASSERT_GE(least_clearance(primitive, from, end, sign, margin.inner_m), margin.inner_m - 1e-10);
    if (free < length) {
      ASSERT_LE(std::abs(sample(primitive, end).distance_m), margin.stop_m + 1e-10);
    }
    const double solid = travel(primitive, from, to, margin, Sides::one);
    if (start > 0.0) {
      ASSERT_EQ(solid, free);
    } else if (convex(primitive)) {
      ASSERT_EQ(solid, length);
    }
  }
}

// Moves that begin at rest on the surface, at every angle to it: what the proxy does all day.
TEST(PrimitiveSweep, LeavesRestFreelyAndPressesNoDeeperThanTheContactMargin) {
  constexpr std::uint64_t kSeed = 43;
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> bell;
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  std::uniform_real_distribution<double> decade(-6.0, -1.0);
  for (int i = 0; i < testing::share_of(40'000); ++i) {
    const PrimitiveKind kind = kAllPrimitives[static_cast<std::size_t>(i) % kAllPrimitives.size()];
    SCOPED_TRACE("seed 43, case " + std::to_string(i));
    const Primitive primitive = testing::random_primitive(kind, random);
    const ContactMargin margin(i % 3 == 0 ? 0.0 : 0.003);
    const Vec3 anywhere(place(random), place(random), place(random));
    const SurfaceSample near = sample(primitive, anywhere);
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const Vec3 from = nearest_point(near, anywhere) + sign * margin.rest_m * near.normal_W;
    const SurfaceSample start = sample(primitive, from);
    if (std::abs(sign * start.distance_m - margin.rest_m) > 1e-9) {
      continue;  // too near to another part of the surface
    }
    Vec3 motion = Vec3(bell(random), bell(random), bell(random)).normalized();
    if (i % 5 < 2) {
      motion = (motion - motion.dot(start.normal_W) * start.normal_W).normalized();
    }
    const Vec3 to = from + std::pow(10.0, decade(random)) * motion;
    const double length = (to - from).norm();
    const double free = travel(primitive, from, to, margin, Sides::two);
    const Vec3 end = from + free / length * (to - from);
    ASSERT_GE(least_clearance(primitive, from, end, sign, margin.inner_m), margin.inner_m - 1e-10);
    if (free < length) {
      ASSERT_LE(sign * sample(primitive, end).distance_m, margin.stop_m + 1e-10);
    }
    if (convex(primitive) && sign > 0.0 && motion.dot(start.normal_W) > 1e-6) {
      ASSERT_EQ(free, length);
    }
  }
}

// The centre of a sphere that nearly fills a tube is always near to where the nearest point jumps
// from one side to the other.
TEST(PrimitiveSweep, StopsOnlyAtTheWallOfATubeThatTheSphereNearlyFills) {
  constexpr std::uint64_t kSeed = 53;
  constexpr double kRing_m = 0.02;
  constexpr double kTube_m = 0.0032;
  const Primitive torus{.kind = PrimitiveKind::torus, .dimensions_m = {kRing_m, kTube_m}};
  const ContactMargin margin(0.003);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> bell;
  std::uniform_real_distribution<double> aside(-0.0001, 0.0001);
  for (int i = 0; i < testing::share_of(20'000); ++i) {
    const Vec3 from(kRing_m + aside(random), aside(random), 0.0);
    const Vec3 to = from + Vec3(0.02 * bell(random), 0.002 * bell(random), 0.02 * bell(random));
    const double length = (to - from).norm();
    const double free = travel(torus, from, to, margin, Sides::two);
    const Vec3 end = from + free / length * (to - from);
    ASSERT_GE(least_clearance(torus, from, end, -1.0, margin.inner_m), margin.inner_m - 1e-10);
    if (free < length) {
      ASSERT_LE(-sample(torus, end).distance_m, margin.stop_m + 1e-10) << "seed 53, case " << i;
    }
  }
}

TEST(PrimitiveSweep, DeepInTheContactMarginItMayMoveOutButNotIn) {
  constexpr std::uint64_t kSeed = 47;
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> bell;
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  for (int i = 0; i < testing::share_of(20'000); ++i) {
    const PrimitiveKind kind = kAllPrimitives[static_cast<std::size_t>(i) % kAllPrimitives.size()];
    SCOPED_TRACE("seed 47, case " + std::to_string(i));
    const Primitive primitive = testing::random_primitive(kind, random);
    const ContactMargin margin(0.004);
    const Vec3 anywhere(place(random), place(random), place(random));
    const SurfaceSample near = sample(primitive, anywhere);
    const Vec3 from = nearest_point(near, anywhere) + (i % 2 == 0 ? 0.002 : -0.002) * near.normal_W;
    const SurfaceSample start = sample(primitive, from);
    const double sign = start.distance_m < 0.0 ? -1.0 : 1.0;
    const Vec3 motion = Vec3(bell(random), bell(random), bell(random)).normalized();
    const Vec3 to = from + 0.05 * motion;
    const double free = travel(primitive, from, to, margin, Sides::two);
    const double floor = std::min(sign * start.distance_m, margin.inner_m);
    const Vec3 end = from + free * motion;
    ASSERT_GE(least_clearance(primitive, from, end, sign, floor), floor - 1e-10);
    if (sign * motion.dot(start.normal_W) < -1e-6) {
      ASSERT_EQ(free, 0.0);
    }
  }
}

TEST(PrimitiveSweep, LeavesASolidFromInsideAndMeetsWhatComesNext) {
  const ContactMargin margin(0.002);
  const Primitive box{.kind = PrimitiveKind::box, .dimensions_m = {0.05, 0.05, 0.05}};
  EXPECT_DOUBLE_EQ(travel(box, {0, 0, 0}, {0.1, 0, 0}, margin), 0.1);
  EXPECT_NEAR(travel(box, {0, 0, 0}, {0.1, 0, 0}, margin, Sides::two), 0.048, 1e-6);
  // The sphere moves from inside the tube on the left, through the hole, to the tube on the right.
  const Primitive torus{.kind = PrimitiveKind::torus, .dimensions_m = {0.05, 0.01}};
  EXPECT_NEAR(travel(torus, {-0.05, 0, 0}, {0.1, 0, 0}, margin), 0.088, 1e-6);
}

}  // namespace
}  // namespace tactus::rendering
