// The friction that a device can hold, compared with exact limits (tests/reference/README.md) and a
// simulated device.
#include "rendering/friction/sampled_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/csv.h"

namespace tactus::testing {
namespace {

using rendering::largest_stable_damping;
using rendering::largest_stable_stiffness;
using rendering::RenderedSpring;
using rendering::SampledDevice;
using rendering::spectral_radius;

TEST(SampledDevice, HoldsTheStiffnessOfTheTable) {
  const Csv csv("wall_Kmax_m0.1.csv");
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const SampledDevice device{.mass_kg = csv.number(row, "m_kg"),
                               .damping_Ns_per_m = csv.number(row, "b_Ns_m"),
                               .step_s = 1.0 / csv.number(row, "f_Hz"),
                               .delay_ticks = static_cast<int>(csv.number(row, "delay_samples"))};
    const double reference = csv.number(row, "K_max_exact_N_m");
    EXPECT_NEAR(largest_stable_stiffness(device, csv.number(row, "B_virtual_Ns_m")), reference,
                1e-6 * reference)
        << "row " << row;
  }
}

TEST(SampledDevice, CannotHoldThePublishedBristleAtOneKilohertzButCanAtFour) {
  const RenderedSpring published{.stiffness_N_per_m = 1e5, .damping_Ns_per_m = std::sqrt(1e5)};
  for (const double b : {0.1, 0.5, 1.0}) {
    EXPECT_NEAR(spectral_radius({.mass_kg = 0.1, .damping_Ns_per_m = b, .step_s = 1e-3}, published),
                1.45, 0.01);
    EXPECT_NEAR(
        spectral_radius({.mass_kg = 0.1, .damping_Ns_per_m = b, .step_s = 0.25e-3}, published),
        0.92, 0.01);
  }
}

// The device itself, started beside the wall: how its swings grow from one stretch to the next.
double growth(const SampledDevice& device, const RenderedSpring& spring) {
  const double decay = std::exp(-device.damping_Ns_per_m * device.step_s / device.mass_kg);
  const double tau = device.mass_kg / device.damping_Ns_per_m;
  std::vector<double> pending(static_cast<std::size_t>(device.delay_ticks), 0.0);
  double x = 1e-3;
  double last_x = x;
  double v = 0.0;
  double before = 0.0;
  double after = 0.0;
  for (int k = 0; k < 4000; ++k) {
    pending.push_back(-spring.stiffness_N_per_m * x -
                      spring.damping_Ns_per_m * (x - last_x) / device.step_s);
    const double terminal = pending.front() / device.damping_Ns_per_m;
    pending.erase(pending.begin());
    last_x = x;
    x += terminal * device.step_s + (v - terminal) * tau * (1.0 - decay);
    v = terminal + (v - terminal) * decay;
    double& largest = k < 2000 ? before : after;
    largest = std::max(largest, std::fabs(x));
  }
  return after / before;
}

TEST(SampledDevice, ItsLimitsDivideWhatSettlesFromWhatGrows) {
  for (const int delay : {0, 1, 3}) {
    for (const double b : {0.5, 5.0}) {
      const SampledDevice device{
          .mass_kg = 0.1, .damping_Ns_per_m = b, .step_s = 1e-3, .delay_ticks = delay};
      for (const double virtual_damping : {0.0, 0.3}) {
        const double limit = largest_stable_stiffness(device, virtual_damping);
        ASSERT_GT(limit, 0.0);
        EXPECT_LT(growth(device, {0.97 * limit, virtual_damping}), 1.0);
        EXPECT_GT(growth(device, {1.03 * limit, virtual_damping}), 1.0);
      }
      const double limit = largest_stable_damping(device, 50.0);
      ASSERT_GT(limit, 0.0);
      EXPECT_LT(growth(device, {50.0, 0.97 * limit}), 1.0);
      EXPECT_GT(growth(device, {50.0, 1.03 * limit}), 1.0);
    }
  }
}

TEST(SampledDevice, StaysWhereItIsWithoutASpring) {
  EXPECT_NEAR(spectral_radius({.mass_kg = 0.1, .damping_Ns_per_m = 1.0, .step_s = 1e-3}, {}), 1.0,
              1e-9);
}

TEST(SampledDevice, WithMoreDelayThanIsCoveredHoldsNothing) {
  const SampledDevice device{.damping_Ns_per_m = 1.0, .delay_ticks = 17};
  EXPECT_EQ(largest_stable_stiffness(device, 0.0), 0.0);
  EXPECT_EQ(largest_stable_damping(device, 0.0), 0.0);
  EXPECT_TRUE(std::isinf(spectral_radius(device, {})));
}

}  // namespace
}  // namespace tactus::testing
