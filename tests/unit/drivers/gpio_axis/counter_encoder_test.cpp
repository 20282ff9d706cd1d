#include "drivers/gpio_axis/counter_encoder.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/hal/random.h"

namespace tactus::drivers {
namespace {

constexpr std::uint64_t kCounterCeiling = 0xFFFF;
constexpr hal::TimeNs kReading_ns = 1'000'000;

// 400 counts a turn at 100 rad/s: 6.4 counts a millisecond.
constexpr EncoderConfig kCounterEncoder{
    .counts_per_rev = 400, .max_speed_rad_per_s = 100.0, .counter_index = true};

class CounterEncoderTest : public ::testing::Test {
 protected:
  CounterEncoderTest() { restart(0); }
  void restart(std::uint64_t count) {
    raw_ = count;
    encoder_.restart({.count = raw_, .time_ns = now_ns_}, kCounterCeiling);
  }
  void move(std::int64_t steps, hal::TimeNs after_ns = kReading_ns) {
    raw_ = (raw_ + static_cast<std::uint64_t>(steps)) & kCounterCeiling;
    now_ns_ += after_ns;
    encoder_.take({.count = raw_, .time_ns = now_ns_});
  }
  EncoderFault fault() { return encoder_.reading().fault; }

  CounterEncoder encoder_{kCounterEncoder};
  std::uint64_t raw_ = 0;
  hal::TimeNs now_ns_ = 1'000'000'000;
};

TEST_F(CounterEncoderTest, FollowsTheCountOverManyWraps) {
  hal::Random random(21);
  EncoderConfig config = kCounterEncoder;
  config.counter_index = false;
  encoder_ = CounterEncoder(config);
  restart(kCounterCeiling - 2);
  std::int64_t truth = 0;
  for (int i = 0; i < 200'000; ++i) {
    const auto steps = static_cast<std::int64_t>(random.below(9)) - 3;
    truth += steps;
    move(steps);
    ASSERT_EQ(encoder_.reading().count, truth);
  }
  EXPECT_GT(truth, static_cast<std::int64_t>(2 * kCounterCeiling));
  EXPECT_EQ(fault(), EncoderFault::none);
}

TEST_F(CounterEncoderTest, AWayThatTheShaftCannotMakeEndsThePosition) {
  move(8);
  EXPECT_EQ(fault(), EncoderFault::none);
  move(9);
  EXPECT_EQ(fault(), EncoderFault::jump);
}

TEST_F(CounterEncoderTest, ATimeLongEnoughForHalfARoundEndsThePosition) {
  const double half_round_s = 0.5 * static_cast<double>(kCounterCeiling) / (100.0 * 400 / 6.2832);
  move(0, static_cast<hal::TimeNs>(0.99e9 * half_round_s));
  EXPECT_EQ(fault(), EncoderFault::none);
  move(0, static_cast<hal::TimeNs>(1.01e9 * half_round_s));
  EXPECT_EQ(fault(), EncoderFault::jump);
}

TEST_F(CounterEncoderTest, NoiseEndsThePosition) {
  encoder_.take({.count = 0, .time_ns = now_ns_ + kReading_ns, .noisy = true});
  EXPECT_EQ(fault(), EncoderFault::noise);
}

TEST_F(CounterEncoderTest, IndexIsPlacedInTheUnwrappedCountAndChecked) {
  restart(kCounterCeiling - 3);
  encoder_.take_index({.count = 1, .time_ns = now_ns_});
  move(6);
  EXPECT_TRUE(encoder_.reading().index_seen);
  EXPECT_EQ(encoder_.reading().index_count, 5);
  for (int i = 0; i < 66; ++i) {
    move(6);
  }
  encoder_.take_index({.count = 402, .time_ns = now_ns_});
  EXPECT_EQ(encoder_.index_error(), 1);
  EXPECT_EQ(fault(), EncoderFault::none) << "within the tolerance";
  encoder_.take_index({.count = 399, .time_ns = now_ns_});
  EXPECT_EQ(fault(), EncoderFault::index_moved);
}

TEST_F(CounterEncoderTest, ATurnAndAQuarterWithoutAnIndexEndsThePosition) {
  for (int i = 0; i < 100; ++i) {
    move(5);
  }
  EXPECT_EQ(fault(), EncoderFault::none);
  move(1);
  EXPECT_EQ(fault(), EncoderFault::index_missing);
}

TEST_F(CounterEncoderTest, VelocityIsThatOfTheCounts) {
  for (int i = 0; i < 20; ++i) {
    move(i % 2 == 0 ? 3 : 4);
  }
  EXPECT_NEAR(encoder_.reading().counts_per_s, 3500.0, 501.0);
}

}  // namespace
}  // namespace tactus::drivers
