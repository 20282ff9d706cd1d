#include "host_tools/simulation/portable_math.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host_tools/simulation/random.h"

namespace tactus::host {
namespace {

// The C library is the oracle here: its functions are right to about one unit in the last place.
TEST(PortableMath, ExpAgreesWithTheLibraryToTwoUnitsInTheLastPlace) {
  SplitMix64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const double x = -random.uniform(0.0, i % 2 == 0 ? 2.0 : 690.0);
    EXPECT_NEAR(exp_nonpositive(x) / std::exp(x), 1.0, 4.5e-16) << "x = " << x;
  }
}

TEST(PortableMath, ExpOfZeroIsOneAndFarBelowIsZero) {
  EXPECT_EQ(exp_nonpositive(0.0), 1.0);
  EXPECT_EQ(exp_nonpositive(-701.0), 0.0);
}

// Published check values of SplitMix64 for seed 1234567.
TEST(SplitMix64, GivesThePublishedSequence) {
  SplitMix64 random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317U);
  EXPECT_EQ(random.next(), 3203168211198807973U);
  EXPECT_EQ(random.next(), 9817491932198370423U);
}

}  // namespace
}  // namespace tactus::host
