// The proxy, brought to the surface from the free side, comes to rest at the closest points of the
// reference.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/csv.h"
#include "tests/unit/rendering/implicit/implicit_scene.h"

namespace tactus::rendering {
namespace {

using testing::Csv;

constexpr double kClosestScale_m = 0.05;

std::string formula_of(const std::string& surface) {
  if (surface == "sphere_r1") {
    return "sphere(1)";
  }
  return surface == "torus_R1_r0.4" ? "torus(1, 0.4)" : "heart()";
}

// Starts on the free side of the closest point c, a little beside it, and presses to p. A reference
// point outside is pressed from the inside, with inside and outside swapped.
void expect_closest(const std::string& surface, const Vec3& p, const Vec3& c) {
  const bool outside = FormulaSurface(formula_of(surface)).value_at(p) > 0.0;
  const FormulaSurface shape((outside ? "-(" : "(") + formula_of(surface) + ")", kClosestScale_m);
  const Vec3 away = (c - p).normalized();
  const Vec3 beside = away.unitOrthogonal();
  const Vec3 start = c + 0.03 * away + 0.02 * beside;
  ASSERT_GT(shape.value_at(kClosestScale_m * start), 0.0);
  ImplicitTracker tracker;
  tracker.place(kClosestScale_m * start);
  ImplicitRest rest;
  for (int tick = 0; tick < 20; ++tick) {
    rest = tracker.advance(shape.surface, kNoFriction, kClosestScale_m * p);
  }
  // It rests 0.1 um above, and is as near to the tool as that lets it.
  EXPECT_LE((rest.proxy_W - kClosestScale_m * c).norm(), 1e-6);
  EXPECT_NEAR((rest.proxy_W - kClosestScale_m * p).norm(), kClosestScale_m * (c - p).norm(), 2e-7);
  EXPECT_GE(shape.value_at(rest.proxy_W), 0.0);
  EXPECT_EQ(rest.planes, 1);
}

TEST(ImplicitClosestPoint, IsReachedOnSphereAndTorus) {
  const Csv csv("implicit_closest_analytic.csv");
  ASSERT_EQ(csv.rows(), 200U);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    SCOPED_TRACE(row);
    expect_closest(csv.text(row, "surface"), csv.vector(row, "p"), csv.vector(row, "c"));
  }
}

TEST(ImplicitClosestPoint, IsReachedOnTheHeart) {
  const Csv csv("implicit_closest_numeric.csv");
  ASSERT_EQ(csv.rows(), 60U);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    SCOPED_TRACE(row);
    expect_closest(csv.text(row, "surface"), csv.vector(row, "p"), csv.vector(row, "c"));
  }
}

}  // namespace
}  // namespace tactus::rendering
