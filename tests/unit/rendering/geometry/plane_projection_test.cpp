// Compares the projection on planes with 1000 cases solved in exact rational arithmetic
// (tests/reference/README.md).
#include "rendering/geometry/plane_projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/csv.h"

namespace tactus::rendering {
namespace {

using testing::Csv;

std::vector<Plane> planes_of(const Csv& csv, std::size_t row) {
  std::vector<Plane> planes;
  for (int i = 0; i < static_cast<int>(csv.number(row, "m")); ++i) {
    const std::string k = std::to_string(i);
    const Vec3 n = csv.vector(row, "n" + k);
    planes.push_back({.normal = n.normalized(), .offset = csv.number(row, "d" + k) / n.norm()});
  }
  return planes;
}

unsigned mask_of(const PlaneProjection& p) {
  unsigned mask = 0;
  for (std::size_t i = 0; i < p.active_count; ++i) {
    mask |= 1U << p.active[i];
  }
  return mask;
}

// If two planes are less than a microradian apart, 1e-17 m decide which of them holds the point.
// That is less than the rounding of an offset of some centimetres. Any of the optimal sets of such
// a pair is right, and the points differ by depth times angle.
bool nearly_parallel(const std::vector<Plane>& planes) {
  return planes.size() == 2 && planes[0].normal.cross(planes[1].normal).norm() < 1e-6;
}

class ReferenceCases : public ::testing::Test {
 protected:
  Csv csv_{"godobject_2000.csv"};
};

TEST_F(ReferenceCases, ThePointIsTheExactMinimum) {
  std::size_t checked = 0;
  for (std::size_t row = 0; row < csv_.rows(); ++row) {
    const Vec3 h = csv_.vector(row, "h");
    const std::vector<Plane> planes = planes_of(csv_, row);
    const PlaneProjection got = project_on_planes(h, planes);
    ASSERT_TRUE(got.point.allFinite()) << "row " << row;
    if (csv_.text(row, "status") != "OK") {
      continue;
    }
    const double det = nearly_parallel(planes)
                           ? planes[0].normal.cross(planes[1].normal).squaredNorm()
                           : csv_.number(row, "unit_gram_det_of_active_set");
    const double tolerance = 10.0 * (1e-14 + (det > 0.0 ? 3e-17 / std::sqrt(det) : 0.0));
    EXPECT_LE((got.point - csv_.vector(row, "g")).norm(), tolerance)
        << "row " << row << " " << csv_.text(row, "category");
    EXPECT_TRUE(got.feasible) << "row " << row << " " << csv_.text(row, "category");
    ++checked;
  }
  EXPECT_EQ(checked, 993U);  // the others are infeasible by a rounding of their own
}

TEST_F(ReferenceCases, ThePlanesThatHoldThePointAreTheExactOnes) {
  std::size_t checked = 0;
  for (std::size_t row = 0; row < csv_.rows(); ++row) {
    const bool comparable = csv_.text(row, "status") == "OK" &&
                            csv_.number(row, "n_min_cardinality_optimal_sets") == 1 &&
                            csv_.number(row, "min_inactive_slack") > 1e-9 &&
                            csv_.number(row, "min_active_lambda_unit") > 1e-9;
    const std::vector<Plane> planes = planes_of(csv_, row);
    if (!comparable || nearly_parallel(planes)) {
      continue;
    }
    const PlaneProjection got = project_on_planes(csv_.vector(row, "h"), planes);
    EXPECT_EQ(mask_of(got), static_cast<unsigned>(csv_.number(row, "active_mask")))
        << "row " << row << " " << csv_.text(row, "category");
    ++checked;
  }
  EXPECT_GT(checked, 800U);
}

TEST(PlaneProjection, WithoutPlanesThePointStays) {
  const Vec3 h{0.1, 0.2, 0.3};
  const PlaneProjection got = project_on_planes(h, {});
  EXPECT_EQ(got.point, h);
  EXPECT_TRUE(got.feasible);
  EXPECT_EQ(got.active_count, 0);
}

TEST(PlaneProjection, ContradictingPlanesAreSaidToBeInfeasible) {
  const std::vector<Plane> apart{{.normal = Vec3::UnitX(), .offset = 0.01},
                                 {.normal = -Vec3::UnitX(), .offset = 0.01}};
  EXPECT_FALSE(project_on_planes({0.0, 0.0, 0.0}, apart).feasible);
}

TEST(PlaneProjection, NearlyParallelPlanesKeepTheFullPrecisionOfTheDepth) {
  // Two planes through one point, 2.3e-4 rad apart, a tool four centimetres below: the crease is
  // the minimum.
  const Vec3 p{0.01, 0.02, -0.034};
  const Vec3 n0{0.0, 0.0, -1.0};
  const Vec3 n1 = Vec3{1.32723e-4, -1.86068e-4, -1.0}.normalized();
  const Vec3 h = p + Vec3{-8.4e-7, 2.9e-6, 0.0427};
  const PlaneProjection got =
      project_on_planes(h, std::vector<Plane>{{n0, n0.dot(p)}, {n1, n1.dot(p)}});
  EXPECT_TRUE(got.feasible);
  EXPECT_EQ(got.active_count, 2);
  EXPECT_NEAR(n0.dot(got.point - p), 0.0, 1e-15);
  EXPECT_NEAR(n1.dot(got.point - p), 0.0, 1e-15);
}

}  // namespace
}  // namespace tactus::rendering
