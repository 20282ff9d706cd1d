#include "firmware/safety/sample_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

class SampleCheckTest : public ::testing::Test {
 protected:
  SampleCheckTest() {
    ControllerConfig config = cartesian_config();
    config.safety.max_sample_age_us = 2000;
    config.safety.stale_ticks_to_fault = 3;
    check_.configure(config);
  }

  SampleCheck check_;
  drivers::JointSample sample_;
};

TEST_F(SampleCheckTest, AGoodSampleHasNoBits) {
  EXPECT_EQ(check_.check(sample_), kNoFault);
}

TEST_F(SampleCheckTest, AnyNonFiniteJointIsAFault) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
      drivers::JointSample sample;
      sample.position[joint] = bad;
      EXPECT_EQ(check_.check(sample), kFaultJointNotFinite);
      sample = {};
      sample.velocity[joint] = bad;
      EXPECT_EQ(check_.check(sample), kFaultJointNotFinite);
    }
  }
}

TEST_F(SampleCheckTest, JointsThatTheMechanismLacksAreNotLookedAt) {
  sample_.position[kJointCount] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check_.check(sample_), kNoFault);
}

TEST_F(SampleCheckTest, AJointOnItsLimitIsGoodAndBeyondItAFault) {
  sample_.position[1] = 0.25;
  EXPECT_EQ(check_.check(sample_), kNoFault);
  sample_.position[1] = std::nextafter(0.25, 1.0);
  EXPECT_EQ(check_.check(sample_), kFaultJointLimit);
  sample_.position[1] = -0.2501;
  EXPECT_EQ(check_.check(sample_), kFaultJointLimit);
}

TEST_F(SampleCheckTest, LimitsMeanNothingBeforeTheDeviceIsReferenced) {
  sample_.position[0] = 5.0;
  for (const std::uint32_t status : {drivers::kDeviceNotReady, drivers::kDeviceHoming}) {
    sample_.status = status;
    EXPECT_EQ(check_.check(sample_), kNoFault);
    EXPECT_FALSE(is_referenced(status));
  }
  sample_.status = drivers::kDeviceReferenceLost;
  EXPECT_EQ(check_.check(sample_), kFaultReferenceLost) << "and no limit beside it";
  EXPECT_FALSE(is_referenced(sample_.status));
}

TEST_F(SampleCheckTest, EachDeviceTroubleIsItsOwnFault) {
  EXPECT_EQ(device_faults(drivers::kDeviceOk), kNoFault);
  EXPECT_EQ(device_faults(drivers::kDeviceEncoderFault), kFaultEncoder);
  EXPECT_EQ(device_faults(drivers::kDeviceDriveFault), kFaultDrive);
  EXPECT_EQ(device_faults(drivers::kDeviceEmergencyStop), kFaultEmergencyStop);
  EXPECT_EQ(device_faults(drivers::kDeviceLost), kFaultDeviceLost);
  EXPECT_EQ(device_faults(drivers::kDeviceTooHot), kFaultOverTemperature);
  EXPECT_EQ(device_faults(drivers::kDeviceReferenceLost), kFaultReferenceLost);
  EXPECT_EQ(device_faults(~0U), kFaultReferenceLost | kFaultEncoder | kFaultDrive |
                                    kFaultEmergencyStop | kFaultDeviceLost | kFaultOverTemperature);
}

TEST_F(SampleCheckTest, TheDifferenceOfTwoJointsMayHaveALimit) {
  ControllerConfig config = cartesian_config();
  config.coupled_limits[0] = {.joint = 0, .minus = 2, .lower = -0.1, .upper = 0.2};
  check_.configure(config);
  const auto faults_at = [&](double first, double third) {
    sample_.position = {first, 0.24, third};
    return check_.check(sample_);
  };
  EXPECT_EQ(faults_at(0.0, 0.09), kNoFault);
  EXPECT_EQ(faults_at(0.0, 0.11), kFaultJointLimit);
  EXPECT_EQ(faults_at(0.09, -0.1), kNoFault);
  EXPECT_EQ(faults_at(0.11, -0.1), kFaultJointLimit);
}

TEST_F(SampleCheckTest, LooksAtTheJointsThatTheMechanismHas) {
  check_.configure(hapkit_config());
  sample_.position = {0.1, 99.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(check_.check(sample_), kNoFault);
  check_.configure(haply_pantograph_config());
  sample_.position = {2.0, 99.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(check_.check(sample_), kFaultJointLimit);
}

TEST_F(SampleCheckTest, TheThirdStaleSampleInARowIsAFault) {
  sample_.status = drivers::kDeviceStale;
  EXPECT_EQ(check_.check(sample_), kLimitStaleSample);
  EXPECT_EQ(check_.check(sample_), kLimitStaleSample);
  EXPECT_EQ(check_.check(sample_), kLimitStaleSample | kFaultStaleSamples);
  EXPECT_EQ(check_.check(sample_), kLimitStaleSample | kFaultStaleSamples);
  EXPECT_EQ(check_.stale_count(), 4U);
}

TEST_F(SampleCheckTest, AFreshSampleForgivesStaleOnes) {
  sample_.age_us = 2001;
  EXPECT_EQ(check_.check(sample_), kLimitStaleSample);
  EXPECT_EQ(check_.check(sample_), kLimitStaleSample);
  sample_.age_us = 2000;
  EXPECT_EQ(check_.check(sample_), kNoFault);
  sample_.age_us = 2001;
  EXPECT_EQ(check_.check(sample_), kLimitStaleSample);
}

}  // namespace
}  // namespace tactus::firmware
