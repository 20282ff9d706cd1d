#include "firmware/commands/injection.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace tactus::firmware {
namespace {

constexpr double kRate_Hz = 1000.0;

drivers::JointSample sample_at(double position) {
  drivers::JointSample sample;
  sample.position[0] = position;
  sample.age_us = 100;
  return sample;
}

drivers::JointSample changed(Injector& injector, double position) {
  drivers::JointSample sample = sample_at(position);
  injector.change(sample, kRate_Hz);
  return sample;
}

TEST(Injector, ChangesNothingUntilItIsAsked) {
  Injector injector;
  EXPECT_EQ(changed(injector, 1.0).position, sample_at(1.0).position);
  EXPECT_EQ(changed(injector, 1.0).status, drivers::kDeviceOk);
  EXPECT_EQ(injector.take_delay(), 0U);
}

TEST(Injector, ADroppedSampleIsTheLastOneGrowingOld) {
  Injector injector;
  changed(injector, 1.0);
  injector.start({.injection = Injection::drop, .ticks = 2});
  const drivers::JointSample first = changed(injector, 2.0);
  const drivers::JointSample second = changed(injector, 3.0);
  EXPECT_EQ(first.position[0], 1.0);
  EXPECT_EQ(first.age_us, 1100U);
  EXPECT_EQ(first.status, drivers::kDeviceStale);
  EXPECT_EQ(second.position[0], 1.0);
  EXPECT_EQ(second.age_us, 2100U);
  EXPECT_EQ(changed(injector, 4.0).position[0], 4.0);
}

TEST(Injector, AStuckEncoderSaysNothingOfIt) {
  Injector injector;
  changed(injector, 1.0);
  injector.start({.injection = Injection::stuck, .ticks = 1});
  const drivers::JointSample stuck = changed(injector, 2.0);
  EXPECT_EQ(stuck.position[0], 1.0);
  EXPECT_EQ(stuck.age_us, 100U);
  EXPECT_EQ(stuck.status, drivers::kDeviceOk);
  EXPECT_EQ(changed(injector, 3.0).position[0], 3.0);
}

TEST(Injector, ReportsWhatADeviceWouldReport) {
  constexpr auto kRows = std::to_array<std::pair<Injection, std::uint32_t>>(
      {{Injection::encoder, drivers::kDeviceEncoderFault},
       {Injection::drive, drivers::kDeviceDriveFault},
       {Injection::estop_line, drivers::kDeviceEmergencyStop},
       {Injection::lost, drivers::kDeviceLost},
       {Injection::not_ready, drivers::kDeviceNotReady}});
  for (const auto& [injection, status] : kRows) {
    Injector injector;
    injector.start({.injection = injection, .ticks = 1});
    EXPECT_EQ(changed(injector, 0.0).status, status);
    EXPECT_EQ(changed(injector, 0.0).status, drivers::kDeviceOk);
  }
}

TEST(Injector, ValuesJumpOrAreNone) {
  Injector injector;
  injector.start({.injection = Injection::jump, .ticks = 1});
  EXPECT_DOUBLE_EQ(changed(injector, 1.0).position[0], 1.0 + kInjectedJump);
  injector.start({.injection = Injection::nan, .ticks = 1});
  EXPECT_TRUE(std::isnan(changed(injector, 1.0).position[0]));
  EXPECT_EQ(changed(injector, 1.0).position[0], 1.0);
}

TEST(Injector, ADelayIsOfOneTickAndBounded) {
  Injector injector;
  injector.start({.injection = Injection::delay, .ticks = 1'000'000});
  EXPECT_EQ(injector.take_delay(), kMaxInjectedDelay);
  EXPECT_EQ(injector.take_delay(), 0U);
}

}  // namespace
}  // namespace tactus::firmware
