// The first facet on a segment against a search through all triangles, which solves for the
// crossing in long double, and against the edges and corners of closed meshes.
#include "rendering/contact/textbook/first_facet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Dense>

#include "tests/support/brute_force.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Corners;
using testing::corners_of;
using testing::kSlippery;
using testing::Shape;
using testing::share_of;
using testing::Solid;

constexpr std::size_t kNoFacetLimit = 1'000'000;

FacetHit first_of(const Solid& solid, const Vec3& from, const Vec3& to,
                  std::span<const std::uint32_t> passed = {}) {
  return FacetSearch(solid.object().mesh, solid.object().sides, kNoFacetLimit)
      .first(from, to, passed);
}

// The crossing of a segment that a search through all triangles finds.
struct SearchedCrossing {
  std::uint32_t triangle = kNoTriangle;
  // The share of the segment before the crossing.
  long double share = 2.0L;
  // False if the segment passes so close to an edge, or ends so close to a plane, that rounding
  // decides.
  bool is_clear = true;
};

// Solves a + u (b - a) + v (c - a) = from + t (to - from) for every triangle.
SearchedCrossing search_all(const Shape& shape, Sides sides, const Vec3& from, const Vec3& to) {
  using LongVec = Eigen::Matrix<long double, 3, 1>;
  constexpr long double kUnclear = 1e-9L;
  SearchedCrossing first;
  long double second_share = 2.0L;
  const std::vector<Corners> corners = corners_of(shape);
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const LongVec a = corners[i].a.cast<long double>();
    Eigen::Matrix<long double, 3, 3> system;
    system.col(0) = corners[i].b.cast<long double>() - a;
    system.col(1) = corners[i].c.cast<long double>() - a;
    system.col(2) = from.cast<long double>() - to.cast<long double>();
    const LongVec front = LongVec(system.col(0)).cross(LongVec(system.col(1)));
    if (sides == Sides::one && front.dot(system.col(2)) <= 0.0L) {
      continue;
    }
    // Cramer's rule; a segment along the plane gives no finite number, which is not inside.
    const LongVec right = from.cast<long double>() - a;
    const LongVec toward = system.col(2);
    const LongVec uvt = LongVec(right.dot(LongVec(system.col(1)).cross(toward)),
                                right.dot(toward.cross(LongVec(system.col(0)))), right.dot(front)) /
                        front.dot(toward);
    const long double inside = std::min({uvt[0], uvt[1], 1.0L - uvt[0] - uvt[1]});
    const long double within = std::min(uvt[2], 1.0L - uvt[2]);
    if (inside < -kUnclear || within < -kUnclear) {
      continue;
    }
    if (inside < kUnclear || within < kUnclear) {
      first.is_clear = false;
    } else if (uvt[2] < first.share) {
      second_share = first.share;
      first.share = uvt[2];
      first.triangle = i;
    } else {
      second_share = std::min(second_share, uvt[2]);
    }
  }
  first.is_clear = first.is_clear && (second_share > 1.0L || second_share - first.share > kUnclear);
  return first;
}

// Random points in a cube about the origin.
class RandomPoints {
 public:
  RandomPoints(std::uint64_t seed, double half_m) : random_(seed), place_(-half_m, half_m) {}
  Vec3 next() { return {place_(random_), place_(random_), place_(random_)}; }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> place_;
};

TEST(FirstFacet, IsThatOfASearchThroughAllTriangles) {
  constexpr int kSegments = 400;
  const std::vector<Shape> shapes{
      testing::triangle_soup(11, 300, 0.05), testing::bumpy_sphere(0.03, 2, 0.1),
      testing::torus(0.03, 0.01, 24, 12),    testing::star(5, 0.04, 0.02, 0.03),
      testing::moebius(0.03, 0.02, 40),      testing::sliver_box({0.05, 0.03, 0.02}, 0.001)};
  std::uint64_t seed = 3;
  for (const Shape& shape : shapes) {
    for (const Sides sides : {Sides::one, Sides::two}) {
      SCOPED_TRACE(shape.name + (sides == Sides::one ? ", one side" : ", two sides"));
      const Solid solid(shape, sides, kSlippery);
      RandomPoints points(++seed, 0.06);
      int hits = 0;
      int unclear = 0;
      for (int k = 0; k < share_of(kSegments); ++k) {
        const Vec3 from = points.next();
        // Ticks are short, and some segments of them are long.
        const Vec3 to = k % 2 == 0 ? points.next() : Vec3{from + 0.2 * points.next()};
        const SearchedCrossing expected = search_all(solid.shape(), sides, from, to);
        if (!expected.is_clear) {
          ++unclear;
          continue;
        }
        const FacetHit hit = first_of(solid, from, to);
        ASSERT_EQ(hit.triangle, expected.triangle) << "segment " << k;
        if (hit.is_hit()) {
          ++hits;
          const auto share = static_cast<double>(expected.share);
          EXPECT_LT((hit.point - (from + share * (to - from))).norm(), 1e-12);
          EXPECT_NEAR(hit.normal.norm(), 1.0, 1e-12);
          EXPECT_LT(hit.normal.dot(to - from), 0.0) << "it faces the segment's beginning";
        }
      }
      EXPECT_GE(hits, share_of(kSegments) / 20);
      EXPECT_LE(unclear, share_of(kSegments) / 50 + 1);
    }
  }
}

// Aims segments at points on the edges and at the corners of a closed mesh. `outward` gives a
// direction out of the solid at a point of its surface.
template <class Outward>
void expect_no_gaps(const Shape& shape, double depth_m, std::uint64_t seed,
                    const Outward& outward) {
  constexpr int kAimed = 40'000;
  const Solid solid(shape, Sides::one, kSlippery);
  const std::vector<Corners> corners = corners_of(solid.shape());
  RandomPoints points(seed, 1.0);
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::size_t> any(0, corners.size() - 1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < share_of(kAimed); ++k) {
    const Corners& at = corners[any(random)];
    const double share = k % 4 == 0 ? 0.0 : unit(random);
    const Vec3 aim = at.a + share * (at.b - at.a);
    const Vec3 out = outward(aim);
    const Vec3 direction = (out + 0.5 * points.next()).normalized();
    const FacetHit hit = first_of(solid, aim + depth_m * direction, aim - depth_m * direction);
    ASSERT_TRUE(hit.is_hit()) << shape.name << ", segment " << k;
    EXPECT_LT((hit.point - aim).norm(), 1e-12) << shape.name << ", segment " << k;
  }
}

TEST(FirstFacet, LeavesNoGapAtTheEdgesAndCornersOfClosedMeshes) {
  const auto from_origin = [](const Vec3& p) { return Vec3{p.normalized()}; };
  expect_no_gaps(testing::icosphere(0.03, 3), 0.005, 21, from_origin);
  expect_no_gaps(testing::bumpy_sphere(0.03, 3, 0.02), 0.001, 22, from_origin);
  expect_no_gaps(testing::sliver_box({0.05, 0.05, 0.05}, 0.002), 0.001, 23, from_origin);
}

TEST(FirstFacet, HasTheFrontAloneOrBothSides) {
  const Shape sheet = testing::flat_sheet(0.01, 4);
  const Vec3 above(0.001, 0.01, 0.002);
  const Vec3 below(0.001, -0.01, 0.002);
  const Solid one(sheet, Sides::one, kSlippery);
  EXPECT_EQ(first_of(one, above, below).normal, Vec3::UnitY());
  EXPECT_FALSE(first_of(one, below, above).is_hit());
  const Solid two(sheet, Sides::two, kSlippery);
  EXPECT_EQ(first_of(two, above, below).normal, Vec3::UnitY());
  EXPECT_EQ(first_of(two, below, above).normal, -Vec3::UnitY());
}

TEST(FirstFacet, EndsASegmentOnAFacetAndDoesNotBeginThere) {
  const Solid sheet(testing::flat_sheet(0.01, 4), Sides::two, kSlippery);
  const Vec3 above(0.001, 0.01, 0.002);
  const Vec3 on(0.001, 0.0, 0.002);
  const Vec3 below(0.001, -0.01, 0.002);
  EXPECT_TRUE(first_of(sheet, above, on).is_hit());
  EXPECT_EQ(first_of(sheet, above, on).point, on);
  EXPECT_FALSE(first_of(sheet, on, above).is_hit());
  EXPECT_FALSE(first_of(sheet, on, below).is_hit());
  EXPECT_FALSE(first_of(sheet, above, above).is_hit()) << "a segment without length";
}

// The boxes of both facets are the same, so a search meets them in one order from either side.
TEST(FirstFacet, IsTheNearerOneOfTwoThatCross) {
  const Shape crossed{.name = "crossed facets",
                      .vertices = {{-0.01F, -0.01F, -0.01F},
                                   {0.01F, 0.01F, -0.01F},
                                   {0.01F, 0.01F, 0.01F},
                                   {-0.01F, 0.01F, -0.01F},
                                   {0.01F, -0.01F, -0.01F},
                                   {0.01F, -0.01F, 0.01F}},
                      .triangles = {{0, 1, 2}, {3, 4, 5}}};
  const Solid solid(crossed, Sides::two, kSlippery);
  const Vec3 above(0.005, 0.01, -0.009);
  const Vec3 below(0.005, -0.01, -0.009);
  EXPECT_NEAR(first_of(solid, above, below).point.y(), 0.005, 1e-9);
  EXPECT_NEAR(first_of(solid, below, above).point.y(), -0.005, 1e-9);
}

TEST(FirstFacet, PassesTheFacetsThatItIsTold) {
  const Solid sheets(
      testing::joined(testing::flat_sheet(0.01, 4),
                      testing::moved(testing::flat_sheet(0.01, 4), {0.0, -0.005, 0.0})),
      Sides::one, kSlippery);
  const Vec3 from(0.001, 0.01, 0.002);
  const Vec3 to(0.001, -0.01, 0.002);
  const FacetHit upper = first_of(sheets, from, to);
  ASSERT_TRUE(upper.is_hit());
  EXPECT_NEAR(upper.point.y(), 0.0, 1e-15);
  const FacetHit lower = first_of(sheets, from, to, {{upper.triangle}});
  ASSERT_TRUE(lower.is_hit());
  EXPECT_NEAR(lower.point.y(), -0.005, 1e-9);
  const std::array both{upper.triangle, lower.triangle};
  EXPECT_FALSE(first_of(sheets, from, to, both).is_hit());
}

TEST(FirstFacet, SaysThatTheLimitOfItsSearchesIsReached) {
  const Solid soup(testing::triangle_soup(5, 400, 0.05), Sides::two, kSlippery);
  const Vec3 from(-0.06, 0.001, 0.002);
  const Vec3 to(0.06, 0.003, -0.001);
  FacetSearch whole(soup.object().mesh, Sides::two, kNoFacetLimit);
  const FacetHit first = whole.first(from, to, {});
  ASSERT_TRUE(first.is_hit());
  EXPECT_FALSE(whole.is_cut());
  const std::size_t needed = kNoFacetLimit - whole.left();
  ASSERT_GT(needed, 2U);

  FacetSearch enough(soup.object().mesh, Sides::two, needed + 1);
  EXPECT_EQ(enough.first(from, to, {}).triangle, first.triangle);
  EXPECT_FALSE(enough.is_cut());
  EXPECT_EQ(enough.left(), 1U);
  enough.first(from, to, {});
  EXPECT_TRUE(enough.is_cut()) << "all searches share the limit";

  FacetSearch few(soup.object().mesh, Sides::two, needed / 2);
  few.first(from, to, {});
  EXPECT_TRUE(few.is_cut());
  EXPECT_EQ(few.left(), 0U);

  FacetSearch none(soup.object().mesh, Sides::two, 0);
  EXPECT_FALSE(none.first(from, to, {}).is_hit());
  EXPECT_TRUE(none.is_cut());
}

}  // namespace
}  // namespace tactus::rendering
