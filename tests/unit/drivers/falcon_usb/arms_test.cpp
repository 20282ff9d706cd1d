#include "drivers/falcon_usb/arms.h"

#include <gtest/gtest.h>

#include <array>

namespace tactus::drivers {
namespace {

constexpr hal::TimeNs kArms_ms = 1'000'000;

TEST(FalconArms, CountsBecomeAngles) {
  FalconArms arms(100.0, 60.0);
  arms.take({0, 100, -100}, kArms_ms);
  std::array<AxisSample, kFalconArms> samples;
  arms.report(kDeviceOk, samples);
  EXPECT_DOUBLE_EQ(samples[0].position_rad, kFalconZeroRad);
  EXPECT_DOUBLE_EQ(samples[1].position_rad, kFalconZeroRad + 100 * kFalconRadPerCount);
  EXPECT_DOUBLE_EQ(samples[2].position_rad, kFalconZeroRad - 100 * kFalconRadPerCount);
}

TEST(FalconArms, AnArmReachesWhatTheFastestHandTurnsAndFourCounts) {
  FalconArms arms(100.0, 60.0);
  arms.take({0, 0, 0}, kArms_ms);
  const auto in_a_ms = static_cast<std::int16_t>(4 + static_cast<int>(0.06 / kFalconRadPerCount));
  const auto beyond = static_cast<std::int16_t>(in_a_ms + 1);
  EXPECT_TRUE(arms.can_reach({0, in_a_ms, 0}, 2 * kArms_ms));
  EXPECT_FALSE(arms.can_reach({0, beyond, 0}, 2 * kArms_ms));
  EXPECT_TRUE(arms.can_reach({0, beyond, 0}, 3 * kArms_ms));
}

}  // namespace
}  // namespace tactus::drivers
