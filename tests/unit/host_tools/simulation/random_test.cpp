#include "host_tools/simulation/random.h"

#include <gtest/gtest.h>

namespace tactus::host {
namespace {

// Published check values of SplitMix64 for seed 1234567.
TEST(SplitMix64, GivesThePublishedSequence) {
  SplitMix64 random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317U);
  EXPECT_EQ(random.next(), 3203168211198807973U);
  EXPECT_EQ(random.next(), 9817491932198370423U);
}

}  // namespace
}  // namespace tactus::host
