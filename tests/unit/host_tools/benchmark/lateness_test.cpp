// The lateness of ticks whose budget is too small, where the tool jumps about a ball and waits.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "host_tools/benchmark/touch_benchmark.h"
#include "host_tools/benchmark/workload.h"
#include "rendering/friction/friction_model.h"
#include "tests/support/shapes.h"
#include "tests/support/solid.h"

namespace tactus::host {
namespace {

using testing::Solid;

constexpr double kLatenessBall_m = 0.04;
constexpr double kToolRadius_m = 0.002;
constexpr double kDepth_m = 0.005;
// The instructions of a tick that ends after a few moves.
constexpr double kLittle = 10'000.0;
// The ticks in which the proxy arrives from anywhere.
constexpr std::size_t kWait = 500;

class LatenessTest : public ::testing::Test {
 protected:
  // Returns the tool's place where it presses at an angle about the ball, rad.
  [[nodiscard]] static Vec3 pressed_at(double angle) {
    return (kLatenessBall_m + kToolRadius_m - kDepth_m) *
           Vec3{std::cos(angle), std::sin(angle), 0.0};
  }

  // Returns a path on which the tool presses at each of the angles (rad) in turn, long enough for
  // the proxy to arrive.
  [[nodiscard]] static std::vector<Vec3> jumps(const std::vector<double>& angles) {
    std::vector<Vec3> path{{kLatenessBall_m + 2.0 * kToolRadius_m, 0.0, 0.0}};
    for (const double angle : angles) {
      path.insert(path.end(), kWait, pressed_at(angle));
    }
    return path;
  }

  [[nodiscard]] Lateness late(const std::vector<Vec3>& path,
                              std::optional<double> tick_instructions) const {
    return lateness_of({&ball_.object(), 1}, kToolRadius_m, path, tick_instructions);
  }

  Solid ball_{
      testing::icosphere(kLatenessBall_m, 6), rendering::Sides::one, {.stiffness_N_per_m = 1000.0}};
};

TEST_F(LatenessTest, IsNoneWhereTheBudgetIsEnough) {
  const Lateness lateness =
      late(stroke_workload(ball_.object().mesh, kToolRadius_m, 2000), std::nullopt);
  EXPECT_EQ(lateness.late_ticks, 0U);
  EXPECT_EQ(lateness.worst_m, 0.0);
  EXPECT_EQ(lateness.worst_turn_rad, 0.0);
  EXPECT_EQ(lateness.in_a_row, 0U);
  EXPECT_EQ(lateness.turned_ticks, 0U);
}

TEST_F(LatenessTest, IsReportedOverTheUsualPathWhereTheBudgetIsTooSmall) {
  const Lateness lateness =
      late(stroke_workload(ball_.object().mesh, kToolRadius_m, 2000), kLittle);
  EXPECT_GT(lateness.late_ticks, 10U);
  EXPECT_GT(lateness.worst_m, 10.0 * kLate_m);
  EXPECT_GT(lateness.in_a_row, 1U);
  EXPECT_LT(lateness.in_a_row, lateness.late_ticks);
}

TEST_F(LatenessTest, TheSeriesIsThatOfTheLongestJumpAlone) {
  const Lateness one = late(jumps({0.0, 1.0}), kLittle);
  const Lateness two = late(jumps({0.0, 1.0, 0.8}), kLittle);
  EXPECT_GT(one.in_a_row, 1U);
  EXPECT_EQ(one.in_a_row, one.late_ticks) << "the tool jumps once";
  EXPECT_EQ(two.in_a_row, one.in_a_row) << "the second jump is shorter";
  EXPECT_GT(two.late_ticks, one.late_ticks);
  // The chord between the proxy before the jump and the place where it belongs after it.
  const double chord_m = 2.0 * (kLatenessBall_m + kToolRadius_m) * std::sin(0.5);
  EXPECT_LT(one.worst_m, chord_m);
  EXPECT_GT(one.worst_m, 0.5 * chord_m);
  EXPECT_EQ(two.worst_m, one.worst_m);
}

TEST_F(LatenessTest, OnlyAForceThatPointsElsewhereIsTurned) {
  // The proxy lags by at most the jump, so the force turns by no more than this angle.
  constexpr double kShort = 0.05;
  const double most_rad = std::atan2((kLatenessBall_m + kToolRadius_m) * kShort, kDepth_m);
  ASSERT_LT(most_rad, kTurned_rad);
  const Lateness near = late(jumps({0.0, kShort}), kLittle);
  EXPECT_GT(near.late_ticks, 0U);
  EXPECT_GT(near.worst_turn_rad, 0.0);
  EXPECT_LE(near.worst_turn_rad, most_rad);
  EXPECT_EQ(near.turned_ticks, 0U);
  // A quarter of the way round, most of it is beyond that angle.
  const Lateness far = late(jumps({0.0, 0.5 * std::numbers::pi}), kLittle);
  EXPECT_GT(far.worst_turn_rad, kTurned_rad);
  EXPECT_GT(far.turned_ticks, far.late_ticks / 2);
  EXPECT_LE(far.turned_ticks, far.late_ticks);
}

TEST_F(LatenessTest, IsThatOfTicksFromTheSameState) {
  // The late proxy is dragged to the last place from one side, and one that was never late from the
  // other. Friction holds them on these two sides for ever, but no tick there is late.
  const Solid rough(testing::icosphere(kLatenessBall_m, 6), rendering::Sides::one,
                    {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(0.6, 0.4)});
  std::vector<Vec3> path = jumps({0.0});
  path.insert(path.end(), 5, pressed_at(1.0));
  path.insert(path.end(), kWait, pressed_at(0.5));
  const Lateness lateness = lateness_of({&rough.object(), 1}, kToolRadius_m, path, kLittle);
  EXPECT_GT(lateness.in_a_row, 5U);
  EXPECT_LT(lateness.late_ticks, kWait / 2);
}

}  // namespace
}  // namespace tactus::host
