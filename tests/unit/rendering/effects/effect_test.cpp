#include "rendering/effects/effect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "rendering/effects/law_numbers.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

constexpr double kDt_s = 1e-3;
constexpr double kPlenty_N = 100.0;

Vec3 force_at(const EffectLaw& law, const Vec3& p, const Vec3& v = Vec3::Zero(),
              double max_force_N = kPlenty_N) {
  EffectState state;
  return apply({.law = law, .max_force_N = max_force_N}, state, {.p_W = p, .v_W = v}, kDt_s);
}

Primitive pool() {
  return {.kind = PrimitiveKind::box, .dimensions_m = {0.05, 0.05, 0.05}};
}

constexpr SnapLaw kSnap{.stiffness_N_per_m = 400.0, .damping_Ns_per_m = 2.0, .capture_m = 0.02};

std::vector<EffectLaw> all_laws() {
  return {Spring{.anchor_W = {0.01, 0, 0}, .stiffness_N_per_m = 300.0},
          SpringDamper{.spring = {.anchor_W = {0, 0.01, 0}, .stiffness_N_per_m = 300.0},
                       .damping_Ns_per_m = 2.0},
          FluidDrag{
              .volume = pool(), .linear_Ns_per_m = 3.0, .quadratic_Ns2_per_m2 = 5.0, .rim_m = 0.01},
          Magnet{.pole_W = {0, 0, 0.01}, .strength_N = 2.0, .core_m = 0.01},
          Magnet{.pole_W = {0, 0, 0.01}, .strength_N = -2.0, .core_m = 0.01},
          ConstantField{.force_W = {0.0, -1.0, 0.5}},
          Vibration{.direction_W = Vec3::UnitX(), .amplitude_N = 1.0, .frequency_Hz = 80.0},
          StickSlip{.stiffness_N_per_m = 500.0, .break_force_N = 1.0},
          SnapToPoint{.point_W = {0.005, 0, 0}, .law = kSnap},
          SnapToLine{.point_W = {0, 0.005, 0}, .direction_W = Vec3::UnitZ(), .law = kSnap},
          SnapToPlane{.point_W = {0, 0, 0.005}, .normal_W = Vec3::UnitX(), .law = kSnap}};
}

// A smooth wandering of a hand within about 3 cm: sums of slow sines at random.
class WanderingHand {
 public:
  explicit WanderingHand(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> size(-0.01, 0.01);
    std::uniform_real_distribution<double> rate(1.0, 25.0);
    for (Wave& wave : waves_) {
      wave = {{size(random), size(random), size(random)}, rate(random), 600.0 * size(random)};
    }
  }

  [[nodiscard]] ToolState at(double t) const {
    ToolState tool;
    for (const Wave& wave : waves_) {
      tool.p_W += std::sin(wave.rate * t + wave.phase) * wave.size;
      tool.v_W += wave.rate * std::cos(wave.rate * t + wave.phase) * wave.size;
    }
    return tool;
  }

 private:
  struct Wave {
    Vec3 size;
    double rate;
    double phase;
  };
  std::array<Wave, 4> waves_;
};

TEST(Effect, SpringPullsByStiffnessTimesWayAndDamperAgainstVelocity) {
  const Spring spring{.anchor_W = {0.1, 0, 0}, .stiffness_N_per_m = 50.0};
  EXPECT_LT((force_at(spring, {0.0, 0.02, 0}) - Vec3(5, -1, 0)).norm(), 1e-12);
  const SpringDamper damped{.spring = spring, .damping_Ns_per_m = 4.0};
  EXPECT_LT((force_at(damped, {0.0, 0.02, 0}, {0, 0.5, 1}) - Vec3(5, -3, -4)).norm(), 1e-12);
}

TEST(Effect, DragActsInsideItsVolumeAloneAndGrowsOverItsRim) {
  const FluidDrag drag{
      .volume = pool(), .linear_Ns_per_m = 2.0, .quadratic_Ns2_per_m2 = 3.0, .rim_m = 0.01};
  const Vec3 v(0, 0, 2.0);
  EXPECT_LT((force_at(drag, {0, 0, 0}, v) - Vec3(0, 0, -16.0)).norm(), 1e-12);
  EXPECT_LT((force_at(drag, {0.045, 0, 0}, v) - Vec3(0, 0, -8.0)).norm(), 1e-12);
  EXPECT_EQ(force_at(drag, {0.051, 0, 0}, v), Vec3::Zero());
  const FluidDrag rimless{.volume = pool(), .linear_Ns_per_m = 2.0};
  EXPECT_LT((force_at(rimless, {0.0499, 0, 0}, v) - Vec3(0, 0, -4.0)).norm(), 1e-12);
}

TEST(Effect, MagnetPullsHardestAtItsCoreOverRootTwoAndFadesWithTheSquare) {
  const Magnet magnet{.strength_N = 3.0, .core_m = 0.01};
  const double peak = 0.01 / std::numbers::sqrt2;
  EXPECT_NEAR(force_at(magnet, {peak, 0, 0}).x(), -3.0, 1e-12);
  EXPECT_LT(force_at(magnet, {0.9 * peak, 0, 0}).norm(), 3.0);
  EXPECT_LT(force_at(magnet, {1.1 * peak, 0, 0}).norm(), 3.0);
  EXPECT_EQ(force_at(magnet, Vec3::Zero()), Vec3::Zero());
  EXPECT_NEAR(force_at(magnet, {2, 0, 0}).norm() / force_at(magnet, {4, 0, 0}).norm(), 4.0, 1e-3);
  EXPECT_GT(force_at(Magnet{.strength_N = -3.0}, {peak, 0, 0}).x(), 0.0);
}

TEST(Effect, SnapPullsTowardPointLineAndPlane) {
  const SnapLaw law{.stiffness_N_per_m = 100.0, .capture_m = 0.02};
  EXPECT_LT((force_at(SnapToPoint{.law = law}, {0, 0.006, 0.008}) - Vec3(0, -0.6, -0.8)).norm(),
            1e-12);
  EXPECT_LT((force_at(SnapToLine{.direction_W = Vec3::UnitX(), .law = law}, {5, 0.004, 0}) -
             Vec3(0, -0.4, 0))
                .norm(),
            1e-12);
  EXPECT_LT((force_at(SnapToPlane{.normal_W = Vec3::UnitY(), .law = law}, {5, -0.004, 7}) -
             Vec3(0, 0.4, 0))
                .norm(),
            1e-12);
  EXPECT_EQ(force_at(SnapToPoint{.law = law}, {0.021, 0, 0}), Vec3::Zero());
  EXPECT_NEAR(force_at(SnapToPoint{.law = law}, {0.015, 0, 0}).x(), -0.5, 1e-12);
}

TEST(Effect, SnapLetsGoWithoutAJumpAndSlidesFreelyAlongItsLineAndPlane) {
  const SnapToPoint point{.law = kSnap};
  double before = 0.0;
  for (double r = 0.0; r < 0.03; r += 1e-5) {
    const double now = force_at(point, {r, 0, 0}, {0.1, 0, 0}).x();
    EXPECT_LT(std::abs(now - before), r == 0.0 ? 0.21 : 0.005);
    before = now;
  }
  const SnapToLine line{.direction_W = Vec3::UnitX(), .law = kSnap};
  EXPECT_EQ(force_at(line, {0.1, 0, 0}, {1, 0, 0}), Vec3::Zero());
  const SnapToPlane plane{.normal_W = Vec3::UnitY(), .law = kSnap};
  EXPECT_EQ(force_at(plane, {0.1, 0, 0.2}, {1, 0, -1}), Vec3::Zero());
  EXPECT_LT(force_at(plane, Vec3::Zero(), {0, 1, 0}).y(), 0.0);
}

TEST(Effect, StickSlipIsASawtooth) {
  const Effect effect{.law = StickSlip{.stiffness_N_per_m = 1000.0, .break_force_N = 2.0},
                      .max_force_N = 10.0};
  EffectState state;
  int slips = 0;
  double greatest = 0.0;
  double before = 0.0;
  for (int i = 0; i <= 10'000; ++i) {  // 0.1 m in steps of 10 um
    const double force =
        apply(effect, state, {.p_W = {i * 1e-5, 0, 0}, .v_W = {0.01, 0, 0}}, kDt_s).norm();
    slips += force < before ? 1 : 0;
    greatest = std::max(greatest, force);
    before = force;
  }
  EXPECT_NEAR(greatest, 2.0, 0.011);
  EXPECT_NEAR(slips, 50, 1);  // every 2 mm, or one step later
}

TEST(Effect, VibrationHasItsFrequencyAndIsSilentFromNyquistOn) {
  const auto run = [](double frequency_Hz, int ticks) {
    const Effect effect{.law = Vibration{.direction_W = Vec3::UnitZ(),
                                         .amplitude_N = 1.5,
                                         .frequency_Hz = frequency_Hz},
                        .max_force_N = 10.0};
    EffectState state;
    std::vector<double> forces;
    forces.reserve(static_cast<std::size_t>(ticks));
    for (int i = 0; i < ticks; ++i) {
      forces.push_back(apply(effect, state, {}, kDt_s).z());
    }
    return forces;
  };
  const std::vector<double> forces = run(60.0, 100'000);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const double turns = std::fmod(0.06 * static_cast<double>(i), 1.0);
    ASSERT_NEAR(forces[i], 1.5 * std::sin(2.0 * std::numbers::pi * turns), 1e-9) << i;
  }
  for (const double frequency : {500.0, 940.0, 1060.0}) {
    EXPECT_EQ(std::ranges::max(run(frequency, 100)), 0.0);
  }
}

TEST(Effect, ConstantFieldIsEverywhereTheSame) {
  const ConstantField field{.force_W = {0, -0.7, 0.1}};
  EXPECT_EQ(force_at(field, {1, 2, 3}, {4, 5, 6}), field.force_W);
}

TEST(Effect, NoForceIsEverLargerThanItsBound) {
  constexpr std::uint64_t kSeed = 81;
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> bell;
  std::uniform_real_distribution<double> decade(-3.0, 3.0);
  for (const EffectLaw& law : all_laws()) {
    const Effect effect{.law = law, .max_force_N = 0.8};
    EffectState state;
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 p =
          std::pow(10.0, decade(random) - 2.0) * Vec3(bell(random), bell(random), bell(random));
      const Vec3 v =
          std::pow(10.0, decade(random)) * Vec3(bell(random), bell(random), bell(random));
      const Vec3 force = apply(effect, state, {.p_W = p, .v_W = v}, kDt_s);
      ASSERT_TRUE(force.allFinite());
      ASSERT_LE(force.norm(), 0.8 * (1.0 + 1e-12)) << "law " << law.index() << ", seed 81, " << i;
    }
  }
}

TEST(Effect, TheAccountIsTheSumOfHeldForceTimesWay) {
  for (const EffectLaw& law : all_laws()) {
    const Effect effect{.law = law, .max_force_N = 5.0};
    const WanderingHand hand(91);
    EffectState state;
    double sum = 0.0;
    Vec3 held = Vec3::Zero();
    Vec3 last = hand.at(0.0).p_W;
    for (int i = 0; i < 2000; ++i) {
      const ToolState tool = hand.at(i * kDt_s);
      sum += held.dot(tool.p_W - last);
      held = apply(effect, state, tool, kDt_s);
      last = tool.p_W;
      ASSERT_NEAR(state.delivered_J, sum, 1e-15) << "law " << law.index();
    }
  }
}

// Slowly and undamped, an elastic law gives exactly what it stored; this checks stored_J too.
TEST(Effect, AConservativeLawDeliversWhatItStored) {
  SnapLaw undamped = kSnap;
  undamped.damping_Ns_per_m = 0.0;
  const std::vector<EffectLaw> laws{
      Spring{.anchor_W = {0.01, 0, 0}, .stiffness_N_per_m = 300.0},
      Magnet{.pole_W = {0, 0, 0.01}, .strength_N = 2.0, .core_m = 0.01},
      Magnet{.pole_W = {0, 0, 0.01}, .strength_N = -2.0, .core_m = 0.01},
      ConstantField{.force_W = {0.0, -1.0, 0.5}},
      SnapToPoint{.law = undamped},
      SnapToLine{.law = undamped},
      SnapToPlane{.law = undamped}};
  for (const double max_force_N : {0.4, 50.0}) {
    for (const EffectLaw& law : laws) {
      const Effect effect{.law = law, .max_force_N = max_force_N};
      const WanderingHand hand(101);
      EffectState state;
      double stored_at_start = 0.0;
      double sampling = 1e-9;  // the laws' steepest is 520 N/m
      Vec3 last = hand.at(0.0).p_W;
      for (int i = 0; i < testing::share_of(200'000); ++i) {
        const ToolState tool = hand.at(i * 1e-5);
        apply(effect, state, tool, 1e-5);
        sampling += 0.5 * 520.0 * (tool.p_W - last).squaredNorm();
        last = tool.p_W;
        if (i == 0) {
          stored_at_start = stored_J(effect, state, tool.p_W);
        }
        ASSERT_NEAR(state.delivered_J, stored_at_start - stored_J(effect, state, tool.p_W),
                    sampling)
            << "law " << law.index() << ", bound " << max_force_N << ", tick " << i;
      }
    }
  }
}

TEST(Effect, APassiveLawNeverDeliversMoreThanItStored) {
  const std::vector<EffectLaw> laws{
      SpringDamper{.spring = {.stiffness_N_per_m = 300.0}, .damping_Ns_per_m = 2.0},
      FluidDrag{.volume = pool(), .linear_Ns_per_m = 3.0, .quadratic_Ns2_per_m2 = 5.0},
      SnapToPoint{.law = kSnap}, SnapToLine{.law = kSnap}, SnapToPlane{.law = kSnap}};
  const std::uint64_t seeds = std::max(std::uint64_t{8}, testing::part_of(std::uint64_t{40}));
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    for (const double max_force_N : {0.3, 50.0}) {
      for (const EffectLaw& law : laws) {
        const Effect effect{.law = law, .max_force_N = max_force_N};
        const WanderingHand hand(seed);
        EffectState state;
        double stored_at_start = 0.0;
        // The energy error of forces that are held for a tick, if the bound leaves no room for the
        // damping that would pay for it.
        double sampling = 1e-7;
        Vec3 last = hand.at(0.0).p_W;
        for (int i = 0; i < 3000; ++i) {
          const ToolState tool = hand.at(i * kDt_s);
          apply(effect, state, tool, kDt_s);
          if (i == 0) {
            stored_at_start = stored_J(effect, state, tool.p_W);
          }
          const double step = (tool.p_W - last).norm();
          sampling += max_force_N < 1.0 ? 0.5 * 400.0 * step * step : 0.0;
          last = tool.p_W;
          ASSERT_LE(state.delivered_J,
                    stored_at_start - stored_J(effect, state, tool.p_W) + sampling)
              << "law " << law.index() << ", seed " << seed << ", tick " << i;
        }
      }
    }
  }
}

TEST(Effect, StickSlipAlwaysTakesEnergyOnARoundTrip) {
  const Effect effect{.law = StickSlip{.stiffness_N_per_m = 500.0, .break_force_N = 1.0},
                      .max_force_N = 5.0};
  const WanderingHand hand(7);
  EffectState state;
  for (int i = 0; i < 20'000; ++i) {
    const ToolState tool = hand.at(i * 1e-4);
    apply(effect, state, tool, 1e-4);
    ASSERT_LE(state.delivered_J, 1e-9);
  }
  EXPECT_LT(state.delivered_J, -0.01);
}

TEST(Effect, IsTheSameAfterItsNumbers) {
  for (const EffectLaw& law : all_laws()) {
    const LawNumbers numbers = numbers_of(law);
    const auto again = law_of(name_of(law), numbers.all());
    ASSERT_TRUE(again.has_value()) << name_of(law);
    EXPECT_EQ(again->index(), law.index());
    EXPECT_TRUE(std::ranges::equal(numbers_of(*again).all(), numbers.all())) << name_of(law);
    EXPECT_FALSE(law_of(name_of(law), numbers.all().first(numbers.count - 1)));
  }
}

// The stiffness at 2,000 random places, along random directions, is never above what the law says.
TEST(Effect, IsNowhereStifferThanItSays) {
  std::mt19937_64 random(77);
  std::uniform_real_distribution<double> place(-0.03, 0.03);
  constexpr double kStep_m = 1e-7;
  for (const EffectLaw& law : all_laws()) {
    const double steepest_N_per_m =
        steepest({.law = law, .max_force_N = kPlenty_N}).stiffness_N_per_m;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p(place(random), place(random), place(random));
      const Vec3 way = Vec3(place(random), place(random), place(random)).normalized();
      const Vec3 rise = force_at(law, p + kStep_m * way) - force_at(law, p - kStep_m * way);
      ASSERT_LE(-rise.dot(way) / (2.0 * kStep_m), steepest_N_per_m * (1.0 + 1e-6) + 1e-6)
          << name_of(law) << ", seed 77, place " << i;
    }
  }
}

TEST(Effect, RefusesWhatCannotBeFelt) {
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  const auto ok = [](const EffectLaw& law) { return valid({.law = law, .max_force_N = 1.0}); };
  for (const EffectLaw& law : all_laws()) {
    EXPECT_TRUE(ok(law)) << law.index();
    EXPECT_FALSE(valid({.law = law, .max_force_N = 0.0}));
    EXPECT_FALSE(valid({.law = law, .max_force_N = kNotANumber}));
  }
  EXPECT_FALSE(ok(Spring{.stiffness_N_per_m = -1.0}));
  EXPECT_FALSE(ok(SpringDamper{.damping_Ns_per_m = kNotANumber}));
  EXPECT_FALSE(ok(FluidDrag{.volume = pool(), .rim_m = -0.1}));
  EXPECT_FALSE(ok(FluidDrag{.volume = {.kind = PrimitiveKind::sphere}}));
  EXPECT_FALSE(ok(Magnet{.core_m = 0.0}));
  EXPECT_FALSE(ok(ConstantField{.force_W = {kNotANumber, 0, 0}}));
  EXPECT_FALSE(ok(Vibration{.direction_W = {1, 1, 0}}));
  EXPECT_FALSE(ok(Vibration{.frequency_Hz = -1.0}));
  EXPECT_FALSE(ok(StickSlip{}));
  EXPECT_FALSE(ok(SnapToPoint{.law = {.capture_m = 0.0}}));
  EXPECT_FALSE(ok(SnapToLine{.direction_W = Vec3::Zero()}));
  EXPECT_FALSE(ok(SnapToPlane{.normal_W = {2, 0, 0}}));
}

}  // namespace
}  // namespace tactus::rendering
