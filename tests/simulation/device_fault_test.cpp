// The device fails while the hand presses: the controller lets go within two ticks and comes back
// on request.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "firmware/safety/faults.h"
#include "tests/simulation/slab_press.h"

namespace tactus::testing {
namespace {

using firmware::Mode;
using host::DeviceFault;

struct Expectation {
  DeviceFault fault;
  std::uint32_t ticks;
  std::uint32_t bit;
};

TEST(DeviceFault, TakesTheEffortAwayWithinTwoTicksOfTheFirstBadSample) {
  constexpr std::array<Expectation, 3> kExpectations = {{
      {DeviceFault::encoder_nan, 1, firmware::kFaultJointNotFinite},
      {DeviceFault::emergency_stop, 1, firmware::kFaultEmergencyStop},
      {DeviceFault::lost, 5, firmware::kFaultDeviceLost},
  }};
  for (const Expectation& expected : kExpectations) {
    const Solid wall = slab(0.6, 0.4);
    host::SimulationConfig config{.path = press(0.008)};
    config.faults = {{.at_s = 2.0, .fault = expected.fault, .ticks = expected.ticks}};
    host::Simulation simulation(config, {&wall.object(), 1}, kToolRadius_m);
    run_for(simulation, 2.001);  // injected at the start of its last tick: the next sample is bad
    ASSERT_GT(std::abs(simulation.record().joint_effort[2]), 1.0);
    run_for(simulation, 0.002);
    EXPECT_EQ(simulation.record().mode, Mode::fault);
    EXPECT_NE(simulation.record().faults & expected.bit, 0U);
    for (int i = 0; i < 100; ++i) {
      for (const double effort : simulation.record().joint_effort) {
        ASSERT_EQ(effort, 0.0);
      }
      simulation.tick();
    }
    EXPECT_NEAR(simulation.device().motor_effort()[2], 0.0, 1e-9) << "the motors have let go";
  }
}

TEST(DeviceFault, OneStaleSampleIsUsedOnceMoreAndManyAreAFault) {
  const Solid wall = slab(0.6, 0.4);
  host::SimulationConfig config{.path = press(0.008)};
  config.faults = {{.at_s = 2.0, .fault = DeviceFault::stale_sample, .ticks = 1},
                   {.at_s = 2.5, .fault = DeviceFault::stale_sample, .ticks = 20}};
  host::Simulation simulation(config, {&wall.object(), 1}, kToolRadius_m);
  run_for(simulation, 2.4);
  EXPECT_EQ(simulation.record().mode, Mode::active);
  EXPECT_EQ(simulation.record().counters.stale_samples, 1U);
  run_for(simulation, 0.2);
  EXPECT_EQ(simulation.record().mode, Mode::fault);
  EXPECT_NE(simulation.record().faults & firmware::kFaultStaleSamples, 0U);
}

// The hand lifts off while the device is down; after the reset it presses again.
TEST(DeviceFault, AResetAfterAnEmergencyStopBringsTheForceBackSoftly) {
  const Solid wall = slab(0.6, 0.4);
  host::SimulationConfig config{
      .path = host::WishPath({at_depth(0.0, 0.0, -0.01), at_depth(0.8, 0.0, -0.01),
                              at_depth(1.5, 0.0, 0.008), at_depth(2.1, 0.0, 0.008),
                              at_depth(2.5, 0.0, -0.01), at_depth(3.2, 0.0, 0.008)})};
  config.faults = {{.at_s = 2.0, .fault = DeviceFault::emergency_stop, .ticks = 10}};
  config.requests = {{.at_s = 2.6, .request = firmware::Request::reset},
                     {.at_s = 2.602, .request = firmware::Request::reset}};
  host::Simulation simulation(config, {&wall.object(), 1}, kToolRadius_m);
  run_for(simulation, 2.5);
  ASSERT_EQ(simulation.record().mode, Mode::fault);
  bool soft_start = false;
  for (int i = 0; i < 1500; ++i) {
    simulation.tick();
    soft_start = soft_start || (simulation.record().limits & firmware::kLimitSoftStart) != 0;
  }
  EXPECT_EQ(simulation.record().mode, Mode::active);
  EXPECT_TRUE(soft_start);
  EXPECT_GT(simulation.record().force_commanded_W[2], 1.0);
}

}  // namespace
}  // namespace tactus::testing
