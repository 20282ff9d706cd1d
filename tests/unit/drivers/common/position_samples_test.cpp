#include "drivers/common/position_samples.h"

#include <gtest/gtest.h>

#include <array>

namespace tactus::drivers {
namespace {

constexpr hal::TimeNs kSamples_ms = 1'000'000;

class PositionSamplesTest : public ::testing::Test {
 protected:
  // Returns the samples as they are reported.
  std::array<AxisSample, 2> report(std::uint32_t status = kDeviceOk) {
    std::array<AxisSample, 2> out;
    samples_.report(status, out);
    return out;
  }

  PositionSamples<2> samples_{1e6, 60.0};
};

TEST_F(PositionSamplesTest, EachAxisHasItsPositionVelocityAndTime) {
  samples_.take(0, 0.1, kSamples_ms);
  samples_.take(1, 0.2, kSamples_ms);
  samples_.take(1, 0.21, 2 * kSamples_ms);
  const auto out = report(kDeviceHoming);
  EXPECT_EQ(out[0].position_rad, 0.1);
  EXPECT_EQ(out[0].velocity_rad_per_s, 0.0);
  EXPECT_EQ(out[0].time_ns, kSamples_ms);
  EXPECT_EQ(out[1].position_rad, 0.21);
  EXPECT_NEAR(out[1].velocity_rad_per_s, 10.0, 0.01);
  EXPECT_EQ(out[1].time_ns, 2 * kSamples_ms);
  EXPECT_EQ(out[0].status, kDeviceHoming);
  EXPECT_EQ(out[1].status, kDeviceHoming);
}

TEST_F(PositionSamplesTest, AVelocityIsClampedAndStartsAgainAtZero) {
  samples_.take(0, 0.0, kSamples_ms);
  samples_.take(0, -1.0, 2 * kSamples_ms);
  EXPECT_EQ(report()[0].velocity_rad_per_s, -60.0);
  samples_.restart_velocity(0);
  samples_.take(0, 1.0, 3 * kSamples_ms);
  EXPECT_EQ(report()[0].velocity_rad_per_s, 0.0);
}

TEST_F(PositionSamplesTest, ForgottenSamplesHaveNoTime) {
  samples_.take(0, 0.5, kSamples_ms);
  samples_.forget();
  EXPECT_EQ(report()[0].time_ns, 0);
  EXPECT_EQ(report()[0].position_rad, 0.0);
}

}  // namespace
}  // namespace tactus::drivers
