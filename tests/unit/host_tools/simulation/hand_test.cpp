#include "host_tools/simulation/hand.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tactus::host {
namespace {

WishPath still() {
  return WishPath({{.t_s = 0.0, .p_W = {0.01, 0.02, 0.03}}});
}

TEST(Tremor, StaysWithinItsAmplitudeAndUsesMostOfIt) {
  Tremor tremor(100e-6, 7, 1e-3);
  double largest = 0.0;
  for (int k = 0; k < 100000; ++k) {
    largest = std::max(largest, tremor.offset().cwiseAbs().maxCoeff());
    tremor.advance();
  }
  EXPECT_LE(largest, 100e-6 * (1.0 + 1e-9));
  EXPECT_GT(largest, 60e-6);
}

TEST(Tremor, TurnsBetweenEightAndTwelveTimesASecond) {
  Tremor tremor(100e-6, 8, 1e-3);
  int rises = 0;
  double before = tremor.offset().x();
  for (int k = 0; k < 20000; ++k) {
    tremor.advance();
    const double now = tremor.offset().x();
    rises += before < 0.0 && now >= 0.0 ? 1 : 0;
    before = now;
  }
  EXPECT_GE(rises, 20 * 8 - 20);
  EXPECT_LE(rises, 20 * 12 + 20);
}

TEST(Hand, TheSameSeedTremblesTheSameBitsAndAnotherSeedOthers) {
  Hand one(kPenHand, still(), 42, 1e-3);
  Hand same(kPenHand, still(), 42, 1e-3);
  Hand other(kPenHand, still(), 43, 1e-3);
  double difference = 0.0;
  for (int k = 0; k < 1000; ++k) {
    ASSERT_EQ(one.wish_W(), same.wish_W());
    difference = std::max(difference, (one.wish_W() - other.wish_W()).norm());
    one.advance();
    same.advance();
    other.advance();
  }
  EXPECT_GT(difference, 20e-6);
}

TEST(Hand, NextWishBecomesTheWish) {
  Hand hand(kFirmHand, still(), 1, 1e-3);
  for (int k = 0; k < 100; ++k) {
    const Vec3 next = hand.next_wish_W();
    hand.advance();
    ASSERT_EQ(hand.wish_W(), next);
  }
}

TEST(Hand, PresetsAreFoundByName) {
  EXPECT_EQ(hand_preset("finger")->stiffness_N_per_m, 400.0);
  EXPECT_EQ(hand_preset("pen")->mass_kg, 0.1);
  EXPECT_EQ(hand_preset("firm")->damping_Ns_per_m, 10.0);
  EXPECT_FALSE(hand_preset("paw").has_value());
}

}  // namespace
}  // namespace tactus::host
