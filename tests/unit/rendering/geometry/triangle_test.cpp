#include "rendering/geometry/triangle.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/brute_force.h"

namespace tactus::rendering {
namespace {

using testing::Corners;

Vec3 scattered_point(std::mt19937_64& random, double size) {
  std::uniform_real_distribution<double> place(-size, size);
  return {place(random), place(random), place(random)};
}

void expect_nearest(const Corners& t, const Vec3& q, double tolerance) {
  const Nearest got = Triangle(t.a, t.b, t.c).nearest(q);
  const Vec3 expected = testing::nearest_point(t, q);
  EXPECT_NEAR(got.distance, (q - expected).norm(), tolerance);
  EXPECT_LE((q - got.distance * got.normal - expected).norm(), tolerance);
  EXPECT_NEAR(got.normal.norm(), 1.0, 1e-12);
}

TEST(Triangle, FindsTheNearestPointOfRandomTriangles) {
  constexpr std::uint64_t kSeed = 11;
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 20'000; ++i) {
    SCOPED_TRACE("seed 11, case " + std::to_string(i));
    const Corners t{scattered_point(random, 0.1),
                    scattered_point(random, 0.1),
                    scattered_point(random, 0.1),
                    {},
                    0.0};
    expect_nearest(t, scattered_point(random, 0.2), 1e-12);
  }
}

TEST(Triangle, FindsTheNearestPointOfSlivers) {
  // A tenth of a metre long, a tenth of a micrometre high: the nearest point may move along, the
  // distance may not.
  constexpr std::uint64_t kSeed = 12;
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 20'000; ++i) {
    SCOPED_TRACE("seed 12, case " + std::to_string(i));
    const Vec3 a = scattered_point(random, 0.05);
    const Vec3 b = scattered_point(random, 0.05);
    const Vec3 c = 0.3 * a + 0.7 * b + scattered_point(random, 1e-7);
    const Vec3 q = scattered_point(random, 0.1);
    const Nearest got = Triangle(a, b, c).nearest(q);
    EXPECT_NEAR(got.distance, (q - testing::nearest_point({a, b, c, {}, 0.0}, q)).norm(), 1e-9);
  }
}

TEST(Triangle, TellsFaceEdgeAndVertexApart) {
  const Triangle t({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(t.nearest({0.2, 0.2, 0.5}).feature, Feature::face);
  EXPECT_EQ(t.nearest({0.5, -0.1, 0.0}).feature, Feature::edge);
  EXPECT_EQ(t.nearest({0.5, -0.1, 0.0}).edge, 0);
  EXPECT_EQ(t.nearest({-0.1, -0.1, 0.3}).feature, Feature::vertex);
  EXPECT_EQ(t.nearest({0.2, 0.2, -0.5}).normal, Vec3(0, 0, -1));
}

TEST(Triangle, GivesTheFrontNormalForAPointThatLiesOnIt) {
  const Triangle t({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(t.nearest({0.2, 0.2, 0.0}).normal, Vec3(0, 0, 1));
  EXPECT_EQ(t.nearest({0.5, 0.0, 0.0}).normal, Vec3(0, 0, 1));
  EXPECT_EQ(t.nearest({0.5, 0.0, 0.0}).distance, 0.0);
}

TEST(Triangle, OfNoAreaIsASegment) {
  const Triangle t({0, 0, 0}, {1, 0, 0}, {0.5, 0, 0});
  EXPECT_DOUBLE_EQ(t.nearest({0.25, 0.3, 0.0}).distance, 0.3);
  EXPECT_DOUBLE_EQ(t.nearest({2.0, 0.0, 0.0}).distance, 1.0);
}

TEST(Triangle, FacesWhatIsNearestToItsFace) {
  constexpr std::uint64_t kSeed = 13;
  std::mt19937_64 random(kSeed);
  int faced = 0;
  for (int i = 0; i < 20'000; ++i) {
    SCOPED_TRACE("seed 13, case " + std::to_string(i));
    const Triangle t(scattered_point(random, 0.1), scattered_point(random, 0.1),
                     scattered_point(random, 0.1));
    const Vec3 q = scattered_point(random, 0.1);
    ASSERT_EQ(t.faces(q), t.nearest(q).feature == Feature::face);
    faced += t.faces(q) ? 1 : 0;
  }
  EXPECT_GT(faced, 1'000);
}

TEST(Triangle, IsHighestInACorner) {
  const Triangle t({0, 0, 1}, {1, 0, 2}, {0, 1, 3});
  EXPECT_EQ(t.highest(Vec3::UnitZ()), 3.0);
  EXPECT_EQ(t.highest(-Vec3::UnitZ()), -1.0);
  EXPECT_EQ(t.highest(Vec3::UnitX()), 1.0);
}

}  // namespace
}  // namespace tactus::rendering
