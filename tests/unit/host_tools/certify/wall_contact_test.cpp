#include "host_tools/certify/wall_contact.h"

#include <gtest/gtest.h>

#include "rendering/friction/sampled_device.h"
#include "tests/support/csv.h"
#include "tests/support/share.h"
#include "tests/unit/host_tools/certify/ideal_contact.h"

namespace tactus::host {
namespace {

constexpr double kTolerance = 0.02;

void expect_limit(ContactTrial& trial, const WallContact& contact, double stiffness_N_per_m,
                  double damping_Ns_per_m) {
  SCOPED_TRACE(::testing::Message()
               << "limit " << stiffness_N_per_m << " N/m with " << damping_Ns_per_m << " N s/m");
  EXPECT_TRUE(
      is_stable(trial.run(contact, {(1.0 - kTolerance) * stiffness_N_per_m, damping_Ns_per_m})));
  EXPECT_FALSE(
      is_stable(trial.run(contact, {(1.0 + kTolerance) * stiffness_N_per_m, damping_Ns_per_m})));
}

TEST(WallContact, AgreesWithTheExactStabilityLimits) {
  const testing::Csv limits("wall_Kmax_m0.1.csv");
  ContactTrial trial;
  ASSERT_EQ(limits.rows(), 56U);
  const std::size_t step = 56 / testing::part_of(std::size_t{56});
  for (std::size_t row = 0; row < limits.rows(); row += step) {
    const WallContact contact = testing::ideal_contact(
        limits.number(row, "m_kg"), limits.number(row, "b_Ns_m"), limits.number(row, "f_Hz"));
    expect_limit(trial, contact, limits.number(row, "K_max_exact_N_m"),
                 limits.number(row, "B_virtual_Ns_m"));
  }
}

}  // namespace
}  // namespace tactus::host
