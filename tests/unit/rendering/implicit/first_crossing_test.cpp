// First contact by intervals, against fine sampling.
#include "rendering/contact/first_crossing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/rendering/implicit/implicit_scene.h"

namespace tactus::rendering {
namespace {

constexpr std::size_t kPlentyOfWork = 10'000'000;
constexpr std::size_t kPlentyOfRanges = 100'000;
constexpr std::uint64_t kCrossingSeed = 20260320;

Crossing cross(const FormulaSurface& shape, const Vec3& from, const Vec3& to,
               const EndValues& known = {}) {
  ImplicitField field(shape.surface, 1.0, kPlentyOfWork);
  return first_crossing(field, from, to, kPlentyOfRanges, known);
}

TEST(FirstCrossing, FindsWhereALineEntersASphere) {
  const FormulaSurface sphere("sphere(1)", 0.05);
  const Crossing crossing = cross(sphere, {-3.0, 0.6, 0.0}, {3.0, 0.6, 0.0});
  EXPECT_EQ(crossing.state, SegmentState::blocked);
  EXPECT_NEAR(-3.0 + 6.0 * crossing.free_to, -0.8, 2.0e-9 / 0.05);
  EXPECT_GE(crossing.blocked_at, crossing.free_to);
}

TEST(FirstCrossing, PassesWhatItMissesByAMicrometre) {
  const FormulaSurface sphere("sphere(1)", 0.05);
  EXPECT_EQ(cross(sphere, {-3.0, 1.0 + 2e-5, 0.0}, {3.0, 1.0 + 2e-5, 0.0}).state,
            SegmentState::free);
  EXPECT_EQ(cross(sphere, {-3.0, 1.0 - 2e-5, 0.0}, {3.0, 1.0 - 2e-5, 0.0}).state,
            SegmentState::blocked);
}

TEST(FirstCrossing, CatchesASheetOfANanometreInOneStepOfAMetre) {
  const FormulaSurface sheet("shell(z, 1e-9)");
  const Crossing crossing = cross(sheet, {0.1, 0.2, 0.3}, {0.1, 0.2, -0.7});
  EXPECT_EQ(crossing.state, SegmentState::blocked);
  EXPECT_NEAR(crossing.free_to, 0.3, 2e-9);
}

// f touches 0 in a kink, or is 0 but for rounding, and has the same sign on both sides.
TEST(FirstCrossing, IsBlockedByAWallWithoutAnInside) {
  for (const char* text : {"x^2", "abs(x)", "abs(x - 0.37)", "x^2 - 0.74*x + 0.1369",
                           "abs(exp(x) - exp(0.37))", "abs(x + 2*y + 2*z - 0.3)"}) {
    const FormulaSurface wall(text, 1.0);
    for (int i = 0; i < 200; ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      const Vec3 from(side * (0.6 + 0.001 * i), 0.003, 0.002);
      const Vec3 to(-side * (0.4 + 0.0017 * i), 0.003, 0.002);
      EXPECT_EQ(cross(wall, from, to).state, SegmentState::blocked) << text << " " << i;
    }
  }
}

TEST(FirstCrossing, StopsWhereTheBudgetRunsOutWithThePathBehindItFree) {
  const FormulaSurface sphere("sphere(1)");
  const Vec3 from{-3.0, 0.0, 1.001};
  const Vec3 to{3.0, 0.1, 0.999};
  const auto formula_size = sphere.surface.formula.instructions.size();
  int unfinished = 0;
  double last = 0.0;
  for (std::size_t evaluations = 1; evaluations < 60; ++evaluations) {
    ImplicitField field(sphere.surface, 1.0, evaluations * formula_size);
    const Crossing crossing = first_crossing(field, from, to, kPlentyOfRanges);
    unfinished += crossing.state == SegmentState::unknown ? 1 : 0;
    EXPECT_GE(crossing.free_to, last) << "more work gets no less far";
    last = crossing.free_to;
    for (int i = 0; i <= 1000; ++i) {
      ASSERT_GE(sphere.value_at(from + 1e-3 * i * crossing.free_to * (to - from)), 0.0);
    }
  }
  EXPECT_GE(unfinished, 5);
  EXPECT_GT(last, 0.5);
}

// An end that the caller has evaluated costs nothing, and a segment on which F only rises needs its
// start alone.
TEST(FirstCrossing, EvaluatesNoKnownEndAndNoEndThatTheBoundsMakeNeedless) {
  const FormulaSurface sphere("sphere(1)");
  const auto formula_size = sphere.surface.formula.instructions.size();
  const Vec3 low{1.0, 0.0, 0.0};
  const Vec3 high{1.01, 0.001, 0.0};
  const auto evaluations = [&](const Vec3& from, const Vec3& to, const EndValues& known) {
    ImplicitField field(sphere.surface, 1.0, kPlentyOfWork);
    EXPECT_EQ(first_crossing(field, from, to, 1, known).state, SegmentState::free);
    return (kPlentyOfWork - field.left()) / formula_size;
  };
  const double at_low = sphere.value_at(low);
  EXPECT_EQ(evaluations(low, high, {}), 2U);
  EXPECT_EQ(evaluations(high, low, {}), 2U);
  EXPECT_EQ(evaluations(low, high, {.from = at_low, .to = {}}), 1U);
  EXPECT_EQ(evaluations(high, low, {.from = {}, .to = at_low}), 1U);
}

// F rises beside the pole of -1/x without a bound, and is below 0 behind it.
TEST(FirstCrossing, DoesNotTakeARiseToAPoleForFree) {
  const FormulaSurface pole("-1/x");
  EXPECT_EQ(cross(pole, {-1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}).state, SegmentState::blocked);
  EXPECT_EQ(cross(pole, {-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}).state, SegmentState::blocked);
}

class RandomSegments : public ::testing::TestWithParam<const char*> {};

TEST_P(RandomSegments, AreFreeUpToTheFirstCrossingThatSamplingFinds) {
  constexpr int kSegments = 300;
  constexpr int kSamples = 4000;
  const FormulaSurface shape(GetParam(), 0.05);
  SCOPED_TRACE(kCrossingSeed);
  std::mt19937_64 random(kCrossingSeed);
  std::uniform_real_distribution<double> side(-1.6, 1.6);
  int blocked = 0;
  for (int run = 0; run < kSegments; ++run) {
    const Vec3 from{side(random), side(random), side(random)};
    const Vec3 to{side(random), side(random), side(random)};
    const auto f = [&](double t) {
      return evaluate(shape.surface.formula, from + t * (to - from));
    };
    if (f(0.0) < 0.0) {
      continue;
    }
    const Crossing crossing = cross(shape, from, to);
    ASSERT_NE(crossing.state, SegmentState::unknown);
    const Crossing with_ends =
        cross(shape, from, to, {.from = f(0.0), .to = evaluate(shape.surface.formula, to)});
    EXPECT_EQ(with_ends.state, crossing.state);
    EXPECT_EQ(with_ends.free_to, crossing.free_to);
    for (int i = 0; i <= kSamples && i <= crossing.free_to * kSamples; ++i) {
      ASSERT_GE(f(static_cast<double>(i) / kSamples), 0.0) << "run " << run;
    }
    if (crossing.state == SegmentState::blocked) {
      ++blocked;
      EXPECT_GE(f(crossing.free_to), 0.0);
      EXPECT_LE(f(crossing.blocked_at), 1e-7) << "there is something";
    }
  }
  EXPECT_GT(blocked, 10);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, RandomSegments,
    ::testing::Values("sphere(1)", "torus(1, 0.4)", "heart()",
                      "intersection(barth_sextic(), sphere(1.5))", "klein_bottle()",
                      "scale(gyroid(), 0.2)", "scale(shell(gyroid(), 0.01), 0.2)",
                      "scale(quartic(), 0.5)", "shell(sphere(1), 0.001)",
                      "difference(box(2,2,2), rotate(cylinder(0.5,3),1,0,0,90))",
                      "union(capsule(0.3,1), rotate(cone(0.5,1),0,1,1,30), torus(1,0.1))",
                      "blend_union(sphere(.7), translate(sphere(.7),1,0,0), 6)",
                      "blend_difference(box(2,2,2), sphere(1.2), 8)",
                      "sphere(1) + 0.1*sin(20*x)*sin(20*y)*sin(20*z)", "exp(x)*y - log(2+z)",
                      "1/(x^2+y^2+z^2) - 3", "x*y*z"));

}  // namespace
}  // namespace tactus::rendering
