#include "drivers/common/encoder_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "drivers/common/torque_clamp.h"

namespace tactus::drivers {
namespace {

constexpr EncoderCheckConfig kShaft{.max_speed_rad_per_s = 100.0, .margin_rad = 0.01};
constexpr hal::TimeNs kMillisecond = 1'000'000;

TEST(EncoderCheck, TrustsThePositionAfterThreeGoodReadings) {
  EncoderCheck check(kShaft);
  EXPECT_FALSE(check.is_trusted());
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(check.is_trusted());
    EXPECT_EQ(check.check(1.0, 0.0, i * kMillisecond), EncoderVerdict::good);
  }
  EXPECT_TRUE(check.is_trusted());
  check.reset();
  EXPECT_FALSE(check.is_trusted());
  EXPECT_EQ(check.check(-5.0, 0.0, 3 * kMillisecond), EncoderVerdict::good);
}

TEST(EncoderCheck, AllowsWhatTheShaftCanTurnAndNoMore) {
  for (const double sign : {1.0, -1.0}) {
    EncoderCheck check(kShaft);
    check.check(0.0, 0.0, 0);
    EXPECT_EQ(check.check(sign * 0.111, 0.0, kMillisecond), EncoderVerdict::jumped);
    EXPECT_EQ(check.check(sign * 0.109, 0.0, kMillisecond), EncoderVerdict::good);
    EXPECT_EQ(check.check(sign * 0.109 + sign * 0.511, 0.0, 6 * kMillisecond),
              EncoderVerdict::jumped);
    EXPECT_EQ(check.check(sign * 0.109 + sign * 0.509, 0.0, 6 * kMillisecond),
              EncoderVerdict::good);
  }
}

TEST(EncoderCheck, TimeThatGoesBackLeavesTheMarginOnly) {
  EncoderCheck check(kShaft);
  check.check(0.0, 0.0, 10 * kMillisecond);
  EXPECT_EQ(check.check(0.02, 0.0, 0), EncoderVerdict::jumped);
  EXPECT_EQ(check.check(0.009, 0.0, 0), EncoderVerdict::good);
  EXPECT_EQ(check.check(0.02, 0.0, 10 * kMillisecond), EncoderVerdict::jumped);
}

TEST(EncoderCheck, RefusesWhatIsNoNumberOrTooFast) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EncoderCheck check(kShaft);
  EXPECT_EQ(check.check(kNan, 0.0, 0), EncoderVerdict::not_a_number);
  EXPECT_EQ(check.check(0.0, kNan, 0), EncoderVerdict::not_a_number);
  EXPECT_EQ(check.check(kInfinity, 0.0, 0), EncoderVerdict::not_a_number);
  EXPECT_EQ(check.check(0.0, -kInfinity, 0), EncoderVerdict::not_a_number);
  EXPECT_EQ(check.check(0.0, 101.0, 0), EncoderVerdict::too_fast);
  EXPECT_EQ(check.check(0.0, -101.0, 0), EncoderVerdict::too_fast);
  EXPECT_EQ(check.check(0.0, 99.0, 0), EncoderVerdict::good);
}

TEST(EncoderCheck, EveryVerdictButGoodHasWords) {
  EXPECT_FALSE(trouble_of(EncoderVerdict::good));
  for (const auto verdict :
       {EncoderVerdict::not_a_number, EncoderVerdict::jumped, EncoderVerdict::too_fast}) {
    EXPECT_TRUE(trouble_of(verdict));
    EXPECT_FALSE(trouble_of(verdict).remedy.empty());
  }
}

// 0.1 rounds up to the next float, and must not.
TEST(TorqueClamp, StaysWithinTheLimitInSinglePrecision) {
  for (const double limit_Nm : {0.1, 0.3, 1.0, 1e-6, 7.7}) {
    for (const double wanted_Nm : {limit_Nm, 2.0 * limit_Nm, -limit_Nm, -1e300}) {
      const float sent_Nm = clamped_torque_Nm({.torque_Nm = wanted_Nm, .enable = true}, limit_Nm);
      EXPECT_LE(std::abs(static_cast<double>(sent_Nm)), limit_Nm);
      EXPECT_NEAR(std::abs(static_cast<double>(sent_Nm)), limit_Nm, 1e-6 * limit_Nm);
    }
  }
  EXPECT_EQ(clamped_torque_Nm(
                {.torque_Nm = std::numeric_limits<double>::quiet_NaN(), .enable = true}, 1.0),
            0.0F);
  EXPECT_EQ(clamped_torque_Nm({.torque_Nm = 1.0, .enable = false}, 1.0), 0.0F);
}

}  // namespace
}  // namespace tactus::drivers
