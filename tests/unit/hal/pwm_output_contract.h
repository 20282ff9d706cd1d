// The contract of every PwmOutput. A rig has: PwmOutput& output(), a channel just opened.
#pragma once

#include <gtest/gtest.h>

#include "hal/pwm_output.h"

namespace tactus::hal {

template <class Rig>
class PwmOutputContract : public ::testing::Test {
 protected:
  void expect_refused(const Result<void>& result, ErrorCode code) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
  }
  PwmOutput& output() { return rig_.output(); }
  Rig rig_;
};

TYPED_TEST_SUITE_P(PwmOutputContract);

TYPED_TEST_P(PwmOutputContract, OpensDisabledAtDutyZero) {
  EXPECT_FALSE(this->output().settings().enabled);
  EXPECT_EQ(this->output().settings().duty_ns, 0);
}

TYPED_TEST_P(PwmOutputContract, TakesWhatLiesInRange) {
  ASSERT_TRUE(this->output().set_period_ns(50'000));
  ASSERT_TRUE(this->output().set_duty_ns(50'000));
  ASSERT_TRUE(this->output().set_duty_ns(0));
  ASSERT_TRUE(this->output().set_enabled(true));
  ASSERT_TRUE(this->output().set_duty_ns(12'500));
  EXPECT_EQ(this->output().settings().period_ns, 50'000);
  EXPECT_EQ(this->output().settings().duty_ns, 12'500);
  EXPECT_TRUE(this->output().settings().enabled);
}

TYPED_TEST_P(PwmOutputContract, DutyNeverExceedsThePeriod) {
  ASSERT_TRUE(this->output().set_period_ns(50'000));
  this->expect_refused(this->output().set_duty_ns(50'001), ErrorCode::invalid_argument);
  this->expect_refused(this->output().set_duty_ns(-1), ErrorCode::invalid_argument);
  ASSERT_TRUE(this->output().set_duty_ns(40'000));
  this->expect_refused(this->output().set_period_ns(39'999), ErrorCode::invalid_argument);
  EXPECT_EQ(this->output().settings().period_ns, 50'000);
  EXPECT_EQ(this->output().settings().duty_ns, 40'000);
}

TYPED_TEST_P(PwmOutputContract, DutyBeforeAnyPeriodIsRefused) {
  this->expect_refused(this->output().set_duty_ns(1), ErrorCode::invalid_argument);
  this->expect_refused(this->output().set_period_ns(0), ErrorCode::invalid_argument);
}

TYPED_TEST_P(PwmOutputContract, EnablingNeedsAPeriod) {
  this->expect_refused(this->output().set_enabled(true), ErrorCode::invalid_state);
  EXPECT_TRUE(this->output().set_enabled(false));
}

REGISTER_TYPED_TEST_SUITE_P(PwmOutputContract, OpensDisabledAtDutyZero, TakesWhatLiesInRange,
                            DutyNeverExceedsThePeriod, DutyBeforeAnyPeriodIsRefused,
                            EnablingNeedsAPeriod);

}  // namespace tactus::hal
