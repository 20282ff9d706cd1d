#include "rendering/contact/sphere_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/brute_force.h"

namespace tactus::rendering {
namespace {

using testing::Corners;

constexpr double kFar = 1.0;

double travel(const Triangle& t, const Vec3& from, const Vec3& to, const ContactMargin& margin,
              bool one_sided = false) {
  const Vec3 motion = to - from;
  return travel_to_contact(t, one_sided, {.from = from, .direction = motion.normalized()}, kFar,
                           margin, t.nearest(from));
}

TEST(SphereSweep, MeetsFaceEdgeAndVertexWhereTheClosedFormsSay) {
  const Triangle t({0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0});
  const double r = 0.01;
  const ContactMargin margin(r);
  // Straight down on the face; sideways on the edge y = 0; along the diagonal on the vertex at the
  // origin.
  EXPECT_NEAR(travel(t, {0.02, 0.02, 0.05}, {0.02, 0.02, 0.0}, margin), 0.05 - r, 1e-6);
  EXPECT_NEAR(travel(t, {0.05, -0.05, 0.006}, {0.05, 0.0, 0.006}, margin),
              0.05 - std::sqrt(r * r - 0.006 * 0.006), 1e-6);
  EXPECT_NEAR(travel(t, {-0.03, -0.03, 0.0}, {0.0, 0.0, 0.0}, margin), 0.03 * std::sqrt(2.0) - r,
              1e-6);
}

TEST(SphereSweep, NeverGoesTooFarAndNeverStopsForNothing) {
  constexpr std::uint64_t kSeed = 21;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  const auto point = [&] { return Vec3{place(random), place(random), place(random)}; };
  for (int i = 0; i < 50'000; ++i) {
    SCOPED_TRACE("seed 21, case " + std::to_string(i));
    const Corners corners{point(), point(), point(), {}, 0.0};
    const Triangle t(corners.a, corners.b, corners.c);
    const ContactMargin margin(i % 3 == 0 ? 0.0 : 0.005);
    const Vec3 from = point();
    const Vec3 to = point();
    if ((from - testing::nearest_point(corners, from)).norm() < margin.rest_m) {
      continue;
    }
    const double length = (to - from).norm();
    const double free = std::min(length, travel(t, from, to, margin));
    const Vec3 end = from + free / length * (to - from);
    ASSERT_GE(testing::segment_distance(corners, from, end), margin.inner_m - 1e-10);
    if (free < length) {
      ASSERT_LE((end - testing::nearest_point(corners, end)).norm(), margin.stop_m + 1e-10);
    }
  }
}

// It comes as near as between inner and stop. A stop that is behind the nearest place would hold a
// sphere by a plane that it goes away from.
TEST(SphereSweep, DoesNotStopWhatHasPassed) {
  const Triangle t({0, 0, 0}, {-0.01, 0.01, 0}, {0.01, 0.01, 0});
  int passes = 0;
  for (const double radius_m : {0.0, 0.001, 0.004}) {
    const ContactMargin margin(radius_m);
    for (int i = 1; i < 200; ++i) {
      const double nearest = margin.inner_m + (margin.stop_m - margin.inner_m) * i / 200;
      for (const double before : {1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 5e-2}) {
        const double free = travel(t, {-before, -nearest, 0.0}, {0.1, -nearest, 0.0}, margin);
        ASSERT_TRUE(free < before || free == kFar)
            << "radius " << radius_m << " nearest " << nearest << " from " << before << ": stopped "
            << free - before << " m behind the nearest place";
        passes += free == kFar ? 1 : 0;
      }
    }
  }
  EXPECT_GT(passes, 1'000);
}

TEST(SphereSweep, AOneSidedTriangleLetsPassWhatComesFromBehind) {
  const Triangle t({0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0});
  const ContactMargin margin(0.002);
  EXPECT_EQ(travel(t, {0.02, 0.02, -0.05}, {0.02, 0.02, 0.05}, margin, true), kFar);
  EXPECT_LT(travel(t, {0.02, 0.02, 0.05}, {0.02, 0.02, -0.05}, margin, true), kFar);
  EXPECT_LT(travel(t, {0.02, 0.02, -0.05}, {0.02, 0.02, 0.05}, margin, false), kFar);
}

TEST(SeparatingPlanes, KeepOffNothingThatIsNear) {
  constexpr std::uint64_t kSeed = 22;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  const auto point = [&] { return Vec3{place(random), place(random), place(random)}; };
  int kept_off = 0;
  for (int i = 0; i < 50'000; ++i) {
    SCOPED_TRACE("seed 22, case " + std::to_string(i));
    const Corners corners{point(), point(), point(), {}, 0.0};
    const Vec3 from = point();
    const Vec3 to = from + 0.2 * point();
    const double distance = 0.2 * std::abs(place(random));
    SeparatingPlanes planes(from, to);
    for (int k = 0; k < i % 4; ++k) {
      planes.add(point().normalized());
    }
    if (planes.keep_off(Triangle(corners.a, corners.b, corners.c), distance)) {
      ASSERT_GE(testing::segment_distance(corners, from, to), distance - 1e-12);
      ++kept_off;
    }
  }
  EXPECT_GT(kept_off, 10'000);
}

TEST(SeparatingPlanes, KeepOffAConvexSolidThatTheSphereSlidesOn) {
  const double r = 0.002;
  const ContactMargin margin(r);
  const testing::Shape ball = testing::icosphere(0.05, 3);
  for (const Corners& touched : testing::corners_of(ball)) {
    const Vec3 normal = (touched.b - touched.a).cross(touched.c - touched.a).normalized();
    const Vec3 from = (touched.a + touched.b + touched.c) / 3.0 + margin.rest_m * normal;
    SeparatingPlanes planes(from, from + 0.01 * normal.unitOrthogonal());
    planes.add(normal);
    for (const Corners& t : testing::corners_of(ball)) {
      ASSERT_TRUE(planes.keep_off(Triangle(t.a, t.b, t.c), margin.inner_m));
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
