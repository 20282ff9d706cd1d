// The figures of a comparison against numbers by hand on runs that are made up.
#include "host_tools/compare/run_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace tactus::host {
namespace {

constexpr double kTick_s = 1e-3;
constexpr TimeSpan kAlways{.from_s = -std::numeric_limits<double>::infinity(),
                           .to_s = std::numeric_limits<double>::infinity()};

// A tick in contact number k with this force.
ComparedTick pressed(std::size_t k, const Vec3& force_W) {
  ComparedTick tick;
  tick.t_s = kTick_s * static_cast<double>(k);
  tick.touch.contact = rendering::ContactKind::face;
  tick.touch.force_W = force_W;
  return tick;
}

// A run of so many ticks, each of which `make` makes of its number.
template <class Make>
ComparedRun run_of(std::size_t ticks, const Make& make) {
  ComparedRun run;
  for (std::size_t k = 0; k < ticks; ++k) {
    run.ticks.push_back(make(k));
  }
  return run;
}

RunFigures figures_alone(const ComparedRun& run, const TimeSpan& span = kAlways) {
  return figures_of(run, run, span);
}

TEST(RunFigures, AForceThatAlternatesHasItsDifferenceAsRipple) {
  const Vec3 even(0.3, 1.0, 0.0);
  const Vec3 odd(0.2, 1.0, 0.0);
  const ComparedRun run =
      run_of(101, [&](std::size_t k) { return pressed(k, k % 2 == 0 ? even : odd); });
  const RunFigures figures = figures_alone(run);
  EXPECT_NEAR(figures.ripple_N, 0.1, 1e-15);
  EXPECT_NEAR(figures.largest_jump_N, 0.1, 1e-15);
  EXPECT_NEAR(figures.largest_force_N, even.norm(), 1e-15);
  EXPECT_EQ(figures.contact_ticks, 101U);
  EXPECT_EQ(figures.breaks, 0U);
}

TEST(RunFigures, AForceThatGrowsEvenlyHasNoRippleAndABentOneHalfItsSecondDifference) {
  const ComparedRun even = run_of(
      50, [](std::size_t k) { return pressed(k, 0.25 * static_cast<double>(k) * Vec3::UnitY()); });
  EXPECT_EQ(figures_alone(even).ripple_N, 0.0);
  EXPECT_EQ(figures_alone(even).largest_jump_N, 0.25);
  // 0, 1, 4, 9, ...: every second difference is 2.
  const ComparedRun bent = run_of(
      50, [](std::size_t k) { return pressed(k, static_cast<double>(k * k) * Vec3::UnitZ()); });
  EXPECT_EQ(figures_alone(bent).ripple_N, 1.0);
}

TEST(RunFigures, RippleIsThatOfTicksInContactWithinTheSpan) {
  // 1 N in contact up to tick 20, then nothing, then 5 N.
  const ComparedRun run = run_of(40, [](std::size_t k) {
    ComparedTick tick = pressed(k, (k < 20 ? 1.0 : 5.0) * Vec3::UnitX());
    if (k >= 20 && k < 25) {
      tick.touch.contact = rendering::ContactKind::none;
      tick.touch.force_W = Vec3::Zero();
    }
    return tick;
  });
  EXPECT_EQ(figures_alone(run).ripple_N, 0.0);
  EXPECT_EQ(figures_alone(run).breaks, 1U);
  EXPECT_EQ(figures_alone(run).contact_ticks, 35U);
  EXPECT_EQ(figures_alone(run).largest_jump_N, 5.0);
  // A step of the force right behind the span does not count.
  const ComparedRun stepped =
      run_of(40, [](std::size_t k) { return pressed(k, (k <= 20 ? 1.0 : 5.0) * Vec3::UnitX()); });
  const TimeSpan before{.from_s = 0.0, .to_s = 20.5 * kTick_s};
  const RunFigures figures = figures_alone(stepped, before);
  EXPECT_EQ(figures.contact_ticks, 21U);
  EXPECT_EQ(figures.ripple_N, 0.0);
  EXPECT_EQ(figures.largest_jump_N, 0.0);
  EXPECT_EQ(figures.largest_force_N, 1.0);
}

TEST(RunFigures, CountsEachEndOfContactOnce) {
  const std::string contacts = "..##.###..#.#";
  const ComparedRun run = run_of(contacts.size(), [&](std::size_t k) {
    ComparedTick tick = pressed(k, Vec3::Zero());
    tick.touch.contact =
        contacts[k] == '#' ? rendering::ContactKind::edge : rendering::ContactKind::none;
    return tick;
  });
  EXPECT_EQ(figures_alone(run).breaks, 3U);
  EXPECT_EQ(figures_alone(run).contact_ticks, 7U);
}

TEST(RunFigures, TheWorkIsThatOfTheForceAlongThePath) {
  constexpr std::size_t kTicks = 201;
  constexpr double kStep_m = 1e-4;
  constexpr double kStiffness_N_per_m = 800.0;
  const auto place = [](std::size_t k) { return Vec3(kStep_m * static_cast<double>(k), 0.0, 0.0); };
  // A spring to the origin takes k x^2 / 2; a force across the path does no work.
  const ComparedRun spring = run_of(kTicks, [&](std::size_t k) {
    ComparedTick tick = pressed(k, -kStiffness_N_per_m * place(k) + 3.0 * Vec3::UnitY());
    tick.tool_W = place(k);
    return tick;
  });
  const double length_m = kStep_m * (kTicks - 1);
  EXPECT_NEAR(figures_alone(spring).given_out_J, -0.5 * kStiffness_N_per_m * length_m * length_m,
              1e-14);
  // There and back it gives all of it back.
  const ComparedRun closed = run_of(2 * kTicks - 1, [&](std::size_t k) {
    const std::size_t at = k < kTicks ? k : 2 * (kTicks - 1) - k;
    ComparedTick tick = pressed(k, -kStiffness_N_per_m * place(at));
    tick.tool_W = place(at);
    return tick;
  });
  EXPECT_NEAR(figures_alone(closed).given_out_J, 0.0, 1e-14);
}

TEST(RunFigures, MovesAndHeightsAreThoseOfTheTicksInContact) {
  const ComparedRun run = run_of(10, [](std::size_t k) {
    ComparedTick tick = pressed(k, Vec3::Zero());
    tick.touch.contact = k < 4 ? rendering::ContactKind::face : rendering::ContactKind::none;
    tick.touch.sub_goals = static_cast<std::uint16_t>(k < 4 ? k : 50);
    tick.height_m = k == 1 ? 2e-3 : k == 2 ? -5e-3 : 0.0;
    return tick;
  });
  const RunFigures figures = figures_alone(run);
  EXPECT_EQ(figures.mean_moves, 1.5);
  EXPECT_EQ(figures.most_moves, 3U);
  EXPECT_EQ(figures.above_m, 2e-3);
  EXPECT_EQ(figures.below_m, 5e-3);
}

// A run whose proxy and force move evenly, beside an offset.
ComparedRun even_run(double rate_Hz, std::size_t ticks, const Vec3& proxy_off,
                     const Vec3& force_off) {
  return run_of(ticks, [&](std::size_t k) {
    ComparedTick tick = pressed(0, Vec3::Zero());
    tick.t_s = static_cast<double>(k) / rate_Hz;
    tick.touch.proxy_W = tick.t_s * Vec3(0.1, -0.2, 0.3) + proxy_off;
    tick.touch.force_W = tick.t_s * Vec3(5.0, 0.0, -1.0) + force_off;
    return tick;
  });
}

TEST(RunFigures, ARunOfAnotherRateIsLinearBetweenItsTicks) {
  const ComparedRun slow = even_run(300.0, 31, Vec3::Zero(), Vec3::Zero());
  const ComparedRun same = even_run(1000.0, 101, Vec3::Zero(), Vec3::Zero());
  EXPECT_NEAR(figures_of(same, slow, kAlways).off_m, 0.0, 1e-15);
  EXPECT_NEAR(figures_of(same, slow, kAlways).force_off_N, 0.0, 1e-15);
  const ComparedRun other = even_run(1000.0, 101, {0.0, 3e-3, 4e-3}, {0.0, 0.6, 0.8});
  EXPECT_NEAR(figures_of(other, slow, kAlways).off_m, 5e-3, 1e-15);
  EXPECT_NEAR(figures_of(other, slow, kAlways).force_off_N, 1.0, 1e-14);
  EXPECT_NEAR(distance_from(other.ticks[7], slow), 5e-3, 1e-15);
  // Behind its end the other run keeps its last tick.
  const ComparedRun longer = even_run(1000.0, 151, Vec3::Zero(), Vec3::Zero());
  EXPECT_NEAR(figures_of(longer, slow, kAlways).off_m, 0.05 * Vec3(0.1, -0.2, 0.3).norm(), 1e-15);
}

TEST(RunFigures, ASpanWithoutTicksHasNothing) {
  const ComparedRun run = even_run(1000.0, 10, Vec3::Zero(), Vec3::Zero());
  const RunFigures figures = figures_alone(run, {.from_s = 5.0, .to_s = 6.0});
  EXPECT_EQ(figures.contact_ticks, 0U);
  EXPECT_EQ(figures.mean_moves, 0.0);
  EXPECT_EQ(figures.ripple_N, 0.0);
  EXPECT_EQ(figures.largest_force_N, 0.0);
}

}  // namespace
}  // namespace tactus::host
