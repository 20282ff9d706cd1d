// A controller of several devices against as many controllers of one.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "firmware/control/controller.h"
#include "firmware/limits.h"
#include "firmware/safety/faults.h"
#include "tests/unit/firmware/control/controller_fixture.h"

namespace tactus::firmware {
namespace {

constexpr std::size_t kThreeDevices = 3;
constexpr int kWalkTicks = 3000;

// Returns where a device is at a tick: it goes into the floor and out, each at a speed of its own.
// One has a fault in between.
drivers::JointSample sample_at(std::size_t device, int tick) {
  const double phase = 0.002 * tick * (1.0 + 0.3 * static_cast<double>(device));
  drivers::JointSample sample = at(0.02 * static_cast<double>(device) + 0.005 * std::sin(phase),
                                   0.004 * std::cos(2.0 * phase), 0.001 * std::sin(3.0 * phase));
  if (device == 2 && tick == 1500) {
    sample.status = drivers::kDeviceEmergencyStop;
  }
  return sample;
}

// Returns the request of a device at a tick. They start one after the other, one is disabled in
// between, and the one with the fault is started again.
Request request_at(std::size_t device, int tick) {
  const int begin = 50 * static_cast<int>(device);
  if (tick == begin) {
    return Request::home;
  }
  if (tick == begin + 2) {
    return Request::enable;
  }
  if (device == 1) {
    return tick == 1000 ? Request::disable : tick == 1200 ? Request::enable : Request::none;
  }
  if (device == 2) {
    switch (tick) {
      case 1700:
        return Request::reset;
      case 1702:
        return Request::home;
      case 1704:
        return Request::enable;
      default:
        break;
    }
  }
  return Request::none;
}

ControllerConfig config_of(std::size_t device) {
  ControllerConfig config = teleporting_config();
  config.on_fault = OnFault::own;
  config.safety.max_force_N = 1.5 + 0.2 * static_cast<double>(device);
  config.tick_instructions = 2e8;  // so that no touch is cut, however many share it
  return config;
}

// A controller of all devices over the floor.
class SeveralDevices : public ::testing::Test {
 protected:
  static std::unique_ptr<ControllerOf<kThreeDevices>> started(const Floor& floor) {
    auto all = std::make_unique<ControllerOf<kThreeDevices>>();
    for (std::size_t i = 0; i < kThreeDevices; ++i) {
      EXPECT_TRUE(all->configure(config_of(i), i));
    }
    EXPECT_TRUE(all->load_scene(floor.objects(), {}));
    return all;
  }

  static std::array<drivers::JointCommand, kThreeDevices> tick(Controller& all, int tick) {
    std::array<drivers::JointSample, kThreeDevices> samples;
    std::array<Request, kThreeDevices> requests{};
    std::array<drivers::JointCommand, kThreeDevices> commands;
    for (std::size_t i = 0; i < kThreeDevices; ++i) {
      samples[i] = sample_at(i, tick);
      requests[i] = request_at(i, tick);
    }
    all.tick(samples, requests, commands);
    return commands;
  }

  Floor floor_{kRubber};
};

TEST_F(SeveralDevices, AreEachLikeAControllerOfItsOwn) {
  const auto all = started(floor_);
  std::vector<std::unique_ptr<Controller>> alone;
  for (std::size_t i = 0; i < kThreeDevices; ++i) {
    alone.push_back(std::make_unique<Controller>());
    ASSERT_TRUE(alone[i]->configure(config_of(i)));
    ASSERT_TRUE(alone[i]->load_scene(floor_.objects(), {}));
  }
  int pressed = 0;
  for (int now = 0; now < kWalkTicks; ++now) {
    const auto commands = tick(*all, now);
    for (std::size_t i = 0; i < kThreeDevices; ++i) {
      const drivers::JointCommand command = alone[i]->tick(sample_at(i, now), request_at(i, now));
      ASSERT_EQ(commands[i].effort, command.effort) << now << " device " << i;
      ASSERT_EQ(commands[i].enable, command.enable) << now << " device " << i;
      ASSERT_EQ(all->record(i).state_hash, alone[i]->record().state_hash) << now << " " << i;
      pressed += command.effort[1] > 0.5 ? 1 : 0;
    }
  }
  EXPECT_GT(pressed, kWalkTicks / 2);
}

TEST_F(SeveralDevices, GoOnFromASavedState) {
  const auto first = started(floor_);
  std::vector<std::byte> state(kThreeDevices * kMaxCheckpointBytes);
  int now = 0;
  for (; now < 1600; ++now) {
    tick(*first, now);
  }
  const std::size_t size = first->save(state);
  ASSERT_GT(size, 0U);
  const auto second = started(floor_);
  ASSERT_TRUE(second->restore(std::span(state).first(size)));
  for (; now < kWalkTicks; ++now) {
    tick(*first, now);
    tick(*second, now);
    for (std::size_t i = 0; i < kThreeDevices; ++i) {
      ASSERT_EQ(first->record(i).state_hash, second->record(i).state_hash) << now << " " << i;
    }
  }
  // A controller of another number of devices does not take it.
  const auto one = std::make_unique<Controller>();
  ASSERT_TRUE(one->configure(config_of(0)));
  ASSERT_TRUE(one->load_scene(floor_.objects(), {}));
  EXPECT_FALSE(one->restore(std::span(state).first(size)));
}

TEST_F(SeveralDevices, HaveOneRate) {
  const auto all = started(floor_);
  ControllerConfig faster = config_of(1);
  faster.rate_hz = 2000.0;
  const auto refused = all->configure(faster, 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "rate_hz");
}

TEST_F(SeveralDevices, AreAllAskedBeforeASceneBecomesStiffer) {
  const auto all = started(floor_);
  ControllerConfig soft = config_of(2);
  soft.certificate.points[0] = {.damping_Ns_per_m = 0.0, .stiffness_N_per_m = 600.0};
  soft.certificate.count = 1;
  ASSERT_TRUE(all->configure(soft, 2));
  const ParameterChange stiff{.place = {.parameter = Parameter::stiffness, .object = 0},
                              .value = 800.0};
  const auto refused = all->set_parameter(stiff);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), ParameterRefusal::uncertified);
  const Floor stiffer({.stiffness_N_per_m = 700.0});
  const auto loaded = all->load_scene(stiffer.objects(), {});
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().fault, SceneFault::uncertified);
  EXPECT_EQ(loaded.error().device, 2U);
  // The device's own parameters are its own.
  const ParameterChange force{.place = {.parameter = Parameter::max_force}, .value = 1.0};
  ASSERT_TRUE(all->set_parameter(force, 1));
  EXPECT_EQ(all->config(0).safety.max_force_N, 1.5);
  EXPECT_EQ(all->config(1).safety.max_force_N, 1.0);
  tick(*all, 0);
  EXPECT_EQ(all->record(0).change.place.parameter, Parameter::none);
  EXPECT_EQ(all->record(1).change.place.parameter, Parameter::max_force);
}

TEST_F(SeveralDevices, CostTheSizeOfTheirToolsOnly) {
  EXPECT_LT(sizeof(ControllerOf<1>), 1.1 * sizeof(Controller));
  EXPECT_LT(sizeof(ControllerOf<2>),
            sizeof(Controller) + sizeof(rendering::ToolSlot) + 2 * sizeof(DeviceController));
}

}  // namespace
}  // namespace tactus::firmware
