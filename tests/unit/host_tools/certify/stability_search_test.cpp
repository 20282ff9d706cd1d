#include "host_tools/certify/stability_search.h"

#include <gtest/gtest.h>

#include <array>

#include "rendering/friction/sampled_device.h"
#include "tests/support/rows.h"
#include "tests/unit/host_tools/certify/ideal_contact.h"

namespace tactus::host {
namespace {

constexpr double kPrecision = 0.005;

double limit(const WallContact& contact, double damping_Ns_per_m = 0.0) {
  ContactTrial trial;
  const std::array<WallContact, 1> contacts{contact};
  return stiffest_stable(trial, contacts, damping_Ns_per_m, kPrecision).stiffness_N_per_m;
}

WallContact plain() {
  return testing::ideal_contact(0.1, 1.0, 1000.0);
}

double plain_limit() {
  static const double found = limit(plain());
  return found;
}

TEST(StabilitySearch, FindsTheExactLimitAtOtherRatesAndDelays) {
  for (const double rate_hz : {500.0, 2000.0}) {
    for (const std::size_t delay : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
      if (!testing::is_taken()) {
        continue;
      }
      WallContact contact = testing::ideal_contact(0.1, 1.0, rate_hz);
      contact.device.delay_ticks = delay;
      const double exact =
          rendering::largest_stable_stiffness({.mass_kg = 0.1,
                                               .damping_Ns_per_m = 1.0,
                                               .step_s = 1.0 / rate_hz,
                                               .delay_ticks = static_cast<int>(delay)},
                                              0.0);
      EXPECT_NEAR(limit(contact), exact, 0.02 * exact) << rate_hz << " Hz, " << delay << " ticks";
    }
  }
}

TEST(StabilitySearch, FindsTheExactLimitOfADeviceThatHoldsLittle) {
  for (const double damping : {0.005, 0.02, 0.04}) {
    if (!testing::is_taken()) {
      continue;
    }
    const double exact = rendering::largest_stable_stiffness(
        {.mass_kg = 0.1, .damping_Ns_per_m = damping, .step_s = 1e-3, .delay_ticks = 0}, 0.0);
    ASSERT_LT(exact, kSoftestWall_N_per_m);
    EXPECT_NEAR(limit(testing::ideal_contact(0.1, damping, 1000.0)), exact, 0.02 * exact)
        << damping << " N s/m";
  }
}

TEST(StabilitySearch, FindsADampingForADeviceThatHoldsLittle) {
  WallContact light = testing::ideal_contact(0.02, 0.02, 1000.0);
  light.device.delay_ticks = 1;
  const double light_limit = limit(light);
  ASSERT_LT(light_limit, kSoftestWall_N_per_m);
  ContactTrial trial;
  const double largest = largest_stable_damping(trial, {&light, 1});
  EXPECT_GT(largest, 1.0);
  EXPECT_GT(limit(light, 0.5 * largest), 2.0 * light_limit);
}

TEST(StabilitySearch, HoldsStifferWallsAtAHigherRate) {
  EXPECT_GT(limit(testing::ideal_contact(0.1, 1.0, 2000.0)), 1.5 * plain_limit());
}

TEST(StabilitySearch, HoldsStifferWallsWithMoreDampingOfEither) {
  EXPECT_GT(limit(testing::ideal_contact(0.1, 2.0, 1000.0)), 1.5 * plain_limit());
  EXPECT_GT(limit(plain(), 1.0), 1.5 * plain_limit());
}

TEST(StabilitySearch, HoldsSofterWallsWithCoarserEncoders) {
  WallContact coarse = plain();
  coarse.device.encoder_resolution = 50e-6;
  WallContact coarser = plain();
  coarser.device.encoder_resolution = 200e-6;
  const double coarse_limit = limit(coarse);
  EXPECT_LT(coarse_limit, 0.98 * plain_limit());
  EXPECT_LT(limit(coarser), 0.95 * coarse_limit);
}

TEST(StabilitySearch, HoldsSofterWallsWithMoreDelay) {
  WallContact late = plain();
  late.device.delay_ticks = 1;
  WallContact slow = late;
  slow.device.motor_time_constant_s = 1e-3;
  const double late_limit = limit(late);
  EXPECT_LT(late_limit, 0.5 * plain_limit());
  EXPECT_LT(limit(slow), 0.8 * late_limit);
}

TEST(StabilitySearch, HoldsStifferWallsWithFriction) {
  WallContact rubbing = plain();
  rubbing.device.plant.joint_friction = {.kind = rendering::FrictionKind::lugre,
                                         .coulomb = 0.2,
                                         .static_level = 0.2,
                                         .stribeck_velocity_m_per_s = 0.005,
                                         .stiffness_N_per_m = 4000.0,
                                         .damping_s_per_m = 1.0};
  EXPECT_GT(limit(rubbing), 1.05 * plain_limit());
}

TEST(StabilitySearch, HoldsStifferWallsWithAHandOnTheHandle) {
  WallContact held = plain();
  held.hand = kFingerHand;
  EXPECT_GT(limit(held), 2.0 * plain_limit());
}

TEST(StabilitySearch, TakesTheWorstPlace) {
  ContactTrial trial;
  WallContact late = plain();
  late.device.delay_ticks = 1;
  const std::array<WallContact, 3> contacts{plain(), late, plain()};
  const StableStiffness found = stiffest_stable(trial, contacts, 0.0, kPrecision);
  EXPECT_EQ(found.worst, 1U);
  EXPECT_EQ(found.stiffness_N_per_m < plain_limit(), true);
}

}  // namespace
}  // namespace tactus::host
