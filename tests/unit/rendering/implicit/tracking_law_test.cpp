// The textbook's tracking law on a sphere against the closed form of its convergence, and the same
// presses with the proxy that is protected against its limit cycle.
#include <gtest/gtest.h>

#include <cmath>

#include "rendering/contact/textbook/plain_tracking.h"
#include "tests/support/csv.h"
#include "tests/unit/rendering/implicit/implicit_scene.h"

namespace tactus::rendering {
namespace {

using testing::Csv;

constexpr double kStartAngle = 0.3;

Vec3 at_angle(double angle, double radius) {
  return radius * Vec3{std::sin(angle), 0.0, std::cos(angle)};
}

double angle_of(const Vec3& p) {
  return std::atan2(p.x(), p.z());
}

struct Press {
  bool concave;
  double ratio;  // depth over radius

  Press(const Csv& csv, std::size_t row)
      : concave(csv.text(row, "side") == "concave"), ratio(csv.number(row, "depth_over_R")) {}

  [[nodiscard]] const char* formula() const { return concave ? "-sphere(1)" : "sphere(1)"; }
  [[nodiscard]] Vec3 tool() const { return {0.0, 0.0, concave ? 1.0 + ratio : 1.0 - ratio}; }
};

TEST(PlainTracking, ContractsAndSwingsAsTheReferenceHasIt) {
  const Csv csv("tracking_sphere_convergence.csv");
  ASSERT_EQ(csv.rows(), 21U);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const Press press(csv, row);
    SCOPED_TRACE(row);
    const FormulaSurface sphere(press.formula());
    Vec3 contact = at_angle(kStartAngle, 1.0);
    for (int step = 1; step <= 4000; ++step) {
      const Seed next = plain_tracking_step(sphere.surface.formula, contact, press.tool());
      ASSERT_TRUE(next.converged);
      contact = next.point;
      const double angle = angle_of(contact);
      if (step == 1 || step == 2 || step == 5) {
        EXPECT_NEAR(angle, csv.number(row, "theta_after_" + std::to_string(step)), 2e-12);
      }
    }
    EXPECT_NEAR(std::abs(angle_of(contact)), csv.number(row, "abs_theta_after_4000"), 1e-8);
  }
}

TEST(ImplicitTracking, ComesToRestAtTheNearestPointWhereThePlainLawSwings) {
  const Csv csv("tracking_sphere_convergence.csv");
  constexpr double kScale_m = 0.03;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const Press press(csv, row);
    SCOPED_TRACE(row);
    const FormulaSurface sphere(press.formula(), kScale_m);
    ImplicitTracker tracker;
    tracker.place(kScale_m * at_angle(kStartAngle, press.concave ? 0.9 : 1.1));
    tracker.advance(sphere.surface, kNoFriction,
                    kScale_m * at_angle(kStartAngle, press.concave ? 1.001 : 0.999));
    ImplicitRest rest = tracker.advance(sphere.surface, kNoFriction, kScale_m * press.tool());
    for (int tick = 0; tick < 3; ++tick) {
      const ImplicitRest next =
          tracker.advance(sphere.surface, kNoFriction, kScale_m * press.tool());
      EXPECT_LE((next.proxy_W - rest.proxy_W).norm(), 1e-8) << "it keeps still";
      EXPECT_EQ(next.flags, kTouchClean);
      rest = next;
    }
    EXPECT_NEAR(angle_of(rest.proxy_W), 0.0, 1e-6);
    EXPECT_NEAR(rest.depth_m, press.ratio * kScale_m, 2e-7);
  }
}

TEST(ImplicitTracking, SettlesWithinOneTickWhereThePlainLawNeedsHundreds) {
  constexpr double kScale_m = 0.03;
  const FormulaSurface sphere("sphere(1)", kScale_m);
  ImplicitTracker tracker;
  tracker.place(kScale_m * at_angle(kStartAngle, 1.1));
  tracker.advance(sphere.surface, kNoFriction, kScale_m * at_angle(kStartAngle, 0.99));
  // Depth 0.9 of the radius: the plain law multiplies the angle by 0.9 a step.
  const ImplicitRest rest =
      tracker.advance(sphere.surface, kNoFriction, kScale_m * Vec3{0.0, 0.0, 0.1});
  EXPECT_NEAR(angle_of(rest.proxy_W), 0.0, 1e-6);
  EXPECT_EQ(rest.flags, kTouchClean);
}

}  // namespace
}  // namespace tactus::rendering
