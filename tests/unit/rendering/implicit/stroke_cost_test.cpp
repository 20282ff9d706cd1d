// How often a formula is evaluated under a stroking tool. The number is the same on every machine.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "tests/unit/rendering/implicit/implicit_scene.h"

namespace tactus::rendering {
namespace {

// Returns the evaluations of the formula in a tick, on average over a second. The tool goes round
// in a circle at 40 mm/s, 1.5 mm below a ball of 30 mm radius.
double evaluations_per_tick(const FormulaSurface& ball, const Material& material) {
  constexpr int kTicks = 1000;
  constexpr double kStrokeRadius_m = 0.0285;
  constexpr double kTurn_rad = 4e-5 / kStrokeRadius_m;
  ImplicitTracker tracker;
  tracker.place({0.0, 0.0, 0.04});
  std::size_t evaluated = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    const double angle = kTurn_rad * tick;
    const Vec3 tool =
        kStrokeRadius_m * Vec3{std::sin(angle), 0.3 * std::cos(angle), std::cos(angle)};
    const ImplicitRest rest = tracker.advance(ball.surface, material, tool);
    EXPECT_EQ(rest.flags, kTouchClean);
    evaluated += rest.evaluated;
  }
  const std::size_t size = ball.surface.formula.instructions.size();
  return static_cast<double>(evaluated) / static_cast<double>(size) / kTicks;
}

// A glide measures the curvature with two evaluations, settles with one or two, and is proved free
// with one; a tick has two glides and begins with one evaluation.
TEST(StrokeCost, AStrokeOverSmoothGroundTakesAFewEvaluationsATick) {
  constexpr double kMost = 12.0;
  for (const char* text : {"sphere(1)", "x^2 + y^2 + z^2 - 1 + 0.01*sin(5*x)*sin(4*y)*cos(3*z)"}) {
    const FormulaSurface ball(text, 0.03);
    EXPECT_LT(evaluations_per_tick(ball, kNoFriction), kMost) << text;
    EXPECT_LT(evaluations_per_tick(ball, rough(0.4, 0.3)), kMost) << text;
  }
}

}  // namespace
}  // namespace tactus::rendering
