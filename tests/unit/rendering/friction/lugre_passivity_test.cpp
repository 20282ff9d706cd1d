#include "rendering/friction/lugre_passivity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/support/csv.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::testing {
namespace {

using rendering::FrictionKind;
using rendering::FrictionMemory;
using rendering::FrictionParameters;
using rendering::lugre_passivity;
using rendering::LugrePassivity;
using rendering::update_friction;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(LugrePassivity, OfThePublishedValuesIsNotGivenAndSaysWhatToChange) {
  const LugrePassivity result = lugre_passivity(published(FrictionKind::lugre));
  EXPECT_FALSE(result.passive);
  EXPECT_NEAR(result.needed_viscous_s_per_m, 158.114, 1e-3);
  EXPECT_NEAR(result.largest_fade_m_per_s, 29.55e-3, 0.02e-3);
  EXPECT_NEAR(result.safe_speed_m_per_s, 12.665e-3, 1e-6);
}

TEST(LugrePassivity, EitherChangeSuffices) {
  FrictionParameters viscous = published(FrictionKind::lugre);
  const LugrePassivity advice = lugre_passivity(viscous);
  FrictionParameters fading = viscous;
  viscous.viscous_s_per_m = advice.needed_viscous_s_per_m;
  fading.damping_fade_m_per_s = advice.largest_fade_m_per_s;
  EXPECT_TRUE(lugre_passivity(viscous).passive);
  EXPECT_TRUE(lugre_passivity(fading).passive);
  EXPECT_EQ(lugre_passivity(fading).safe_speed_m_per_s, kInfinity);
  fading.damping_fade_m_per_s *= 1.01;
  EXPECT_FALSE(lugre_passivity(fading).passive);
  // The condition fails first a little before the fading is at its worst, v_d / sqrt(2).
  EXPECT_NEAR(lugre_passivity(fading).safe_speed_m_per_s, 0.0211 / std::sqrt(2.0) * 1.3, 3e-3);
  viscous.viscous_s_per_m *= 0.99;
  EXPECT_FALSE(lugre_passivity(viscous).passive);
}

TEST(LugrePassivity, IsGivenWithoutDampingAndWithoutABreakAwayForce) {
  FrictionParameters undamped = published(FrictionKind::lugre);
  undamped.damping_s_per_m = 0.0;
  EXPECT_TRUE(lugre_passivity(undamped).passive);
  FrictionParameters level = published(FrictionKind::lugre);
  level.static_level = level.coulomb;
  EXPECT_TRUE(lugre_passivity(level).passive);
  EXPECT_TRUE(lugre_passivity(published(FrictionKind::dahl)).passive);
  EXPECT_TRUE(lugre_passivity(published(FrictionKind::karnopp)).passive);
}

// Slow, so that the bristle bends to Fs, and then fast, so that it springs back to Fc against its
// damping: the demonstration that a constant sigma1 gives out energy.
TEST(LugrePassivity, TheDemonstrationGivesOutTheEnergyThatTheReferenceSays) {
  const Csv csv("lugre_passivity_demo.csv");
  const FrictionParameters constant = published(FrictionKind::lugre);
  FrictionParameters fading = constant;
  fading.damping_fade_m_per_s = constant.stribeck_velocity_m_per_s;
  std::array<FrictionMemory<double>, 2> memory;
  std::array<double, 2> absorbed_J{};
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double v = csv.number(row, "v_m_s");
    const double duration = csv.number(row, "duration_s");
    const int ticks = row % 2 == 0 ? 600 : 1;
    const double displacement = v * duration / ticks;
    for (int k = 0; k < ticks; ++k) {
      const std::array<const FrictionParameters*, 2> parameters{&constant, &fading};
      for (std::size_t i = 0; i < 2; ++i) {
        absorbed_J[i] += displacement * update_friction(*parameters[i], memory[i], displacement,
                                                        1.0, duration / ticks)
                                            .mean_force_N;
      }
    }
    EXPECT_NEAR(absorbed_J[0], csv.number(row, "E_absorbed_const_sigma1_J"), 1e-9) << row;
    EXPECT_NEAR(absorbed_J[1], csv.number(row, "E_absorbed_sigma1(v)_J"), 1e-9) << row;
    EXPECT_NEAR(memory[0].elastic_force_N / 1e5, csv.number(row, "z_end_m"), 1e-14) << row;
  }
  EXPECT_LT(absorbed_J[0], -0.027);
}

}  // namespace
}  // namespace tactus::testing
