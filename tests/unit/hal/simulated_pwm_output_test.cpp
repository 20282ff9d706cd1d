#include "hal/simulated/pwm_output.h"

#include "hal/simulated/clock.h"
#include "tests/unit/hal/pwm_output_contract.h"

namespace tactus::hal {
namespace {

struct SimulatedPwmRig {
  PwmOutput& output() { return simulated; }
  SimulatedClock clock;
  SimulatedPwmOutput simulated{clock};
};

INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, PwmOutputContract, SimulatedPwmRig);

TEST(SimulatedPwmOutput, RecordsEveryWriteWithItsTime) {
  SimulatedClock clock(0);
  SimulatedPwmOutput output(clock);
  ASSERT_TRUE(output.set_period_ns(1000));
  clock.advance_to(500);
  ASSERT_TRUE(output.set_duty_ns(250));
  ASSERT_FALSE(output.set_duty_ns(2000));
  ASSERT_EQ(output.writes().size(), 2U);
  EXPECT_EQ(output.writes()[0].settings.period_ns, 1000);
  EXPECT_EQ(output.writes()[1].time_ns, 500);
  EXPECT_EQ(output.writes()[1].settings.duty_ns, 250);
}

TEST(SimulatedPwmOutput, RecordIsBoundedAndTheCountIsNot) {
  SimulatedClock clock;
  SimulatedPwmOutput output(clock);
  ASSERT_TRUE(output.set_period_ns(1000));
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(output.set_duty_ns(i));
  }
  EXPECT_EQ(output.writes().size(), SimulatedPwmOutput::kRecorded);
  EXPECT_EQ(output.write_count(), 1001U);
}

TEST(SimulatedPwmOutput, MeanLevelFollowsTheDuty) {
  SimulatedClock clock;
  SimulatedPwmOutput output(clock);
  ASSERT_TRUE(output.set_period_ns(1000));
  ASSERT_TRUE(output.set_duty_ns(250));
  EXPECT_EQ(output.mean_level(), 0.0);
  ASSERT_TRUE(output.set_enabled(true));
  EXPECT_EQ(output.mean_level(), 0.25);
}

TEST(SimulatedPwmOutput, FailedWriteChangesNothing) {
  SimulatedClock clock;
  SimulatedPwmOutput output(clock);
  ASSERT_TRUE(output.set_period_ns(1000));
  output.fail_next(2, ErrorCode::disconnected);
  const auto failed = output.set_duty_ns(10);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::disconnected);
  EXPECT_FALSE(output.set_enabled(true));
  EXPECT_EQ(output.settings().duty_ns, 0);
  EXPECT_FALSE(output.settings().enabled);
  EXPECT_TRUE(output.set_duty_ns(10));
}

}  // namespace
}  // namespace tactus::hal
