// Random ticks against what must hold whatever comes in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "firmware/control/controller.h"
#include "firmware/safety/faults.h"
#include "tests/support/share.h"
#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

// Returns a random index into an array of `count` entries.
std::size_t index_below(std::size_t count, std::mt19937_64& generator) {
  return static_cast<std::size_t>(generator() % count);
}

constexpr int kRuns = 40;
constexpr int kTicks = 5000;

// These hands do what no hand does, and force is to be seen all the same.
constexpr std::uint64_t kWildMotion = kFaultEncoderJump | kFaultEncoderFrozen | kFaultOverspeed |
                                      kFaultMotionWithoutTorque | kFaultTorqueWithoutMotion |
                                      kFaultNotPassive;

struct Input {
  drivers::JointSample sample;
  Request request = Request::none;
};

// A hand that mostly wanders and sometimes teleports, on a device that sometimes fails, worked by
// an operator who mostly wants to get back to `active`.
class RandomInputs {
 public:
  RandomInputs(std::uint64_t seed, const ControllerConfig& config)
      : config_(config), generator_(seed) {}

  Input next(Mode mode) {
    Input input;
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
      const JointLimits& limits = config_.joints[joint];
      const double range = limits.upper - limits.lower;
      position_[joint] += chance(0.002) ? range * unit() : 0.005 * range * unit();
      position_[joint] =
          std::clamp(position_[joint], limits.lower + 0.3 * range, limits.upper - 0.3 * range);
      input.sample.position[joint] = position_[joint];
      input.sample.velocity[joint] = std::pow(10.0, 3.0 * unit()) * unit();
    }
    spoil(input.sample);
    input.request = request_for(mode);
    return input;
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(generator_); }
  bool chance(double share) { return std::uniform_real_distribution<double>()(generator_) < share; }

  void spoil(drivers::JointSample& sample) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const std::array<double, 5> bad = {kInfinity, -kInfinity,
                                       std::numeric_limits<double>::quiet_NaN(), 1e308, -1e308};
    const std::size_t joint = index_below(kJointCount, generator_);
    if (chance(0.001)) {
      sample.position[joint] = bad[index_below(bad.size(), generator_)];
    }
    if (chance(0.001)) {
      sample.velocity[joint] = bad[index_below(bad.size(), generator_)];
    }
    if (chance(0.002)) {
      sample.status = 1U << (generator_() % 8);
    }
    if (chance(0.02)) {
      sample.age_us = 10'000;
    }
  }

  Request request_for(Mode mode) {
    if (chance(0.01)) {
      return static_cast<Request>(generator_() % kRequestNames.size());
    }
    switch (mode) {
      case Mode::init:
        return Request::home;
      case Mode::ready:
        return Request::enable;
      case Mode::fault:
        return chance(0.3) ? Request::reset : Request::none;
      default:
        return Request::none;
    }
  }

  const ControllerConfig& config_;
  std::mt19937_64 generator_;
  std::array<double, kJointCount> position_{};
};

// The inputs of a tick as its record kept them.
Input replayed(const TelemetryRecord& record) {
  Input input;
  input.sample.position = record.joint_position;
  input.sample.velocity = record.joint_velocity;
  input.sample.status = record.device_status;
  input.sample.age_us = record.sample_age_us;
  input.request = record.request;
  return input;
}

bool any_non_finite(const drivers::JointSample& sample, std::size_t joints) {
  for (std::size_t joint = 0; joint < joints; ++joint) {
    if (!std::isfinite(sample.position[joint]) || !std::isfinite(sample.velocity[joint])) {
      return true;
    }
  }
  return false;
}

Vec3 vector_of(const Triple& triple) {
  return {triple[0], triple[1], triple[2]};
}

void expect_safe(const ControllerConfig& config, const Input& input,
                 const drivers::JointCommand& command, const TelemetryRecord& record,
                 const Vec3& last_force) {
  const bool off = !command.enable && command.effort == std::array<double, drivers::kMaxJoints>{};
  EXPECT_EQ(command.enable, record.mode == Mode::active);
  EXPECT_TRUE(record.mode == Mode::active || off);
  EXPECT_EQ(record.faults != 0, record.mode == Mode::fault);
  if (any_non_finite(input.sample, joint_count(config.mechanism))) {
    EXPECT_TRUE(off);
    EXPECT_NE(record.faults & kFaultJointNotFinite, 0U);
  }
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    EXPECT_LE(std::abs(command.effort[joint]), config.joints[joint].max_effort * (1.0 + 1e-12));
  }
  const Vec3 force = vector_of(record.force_commanded_W);
  const double step = config.safety.force_slew_N_per_s / config.rate_hz * (1.0 + 1e-12) + 1e-14;
  EXPECT_LE(force.norm(), config.safety.max_force_N * (1.0 + 1e-12));
  EXPECT_LE(force.norm(), last_force.norm() + step);
  if (record.mode == Mode::active && (record.limits & kLimitEffort) == 0) {
    EXPECT_LE((force - last_force).norm(), step);
  }
}

void run_random_ticks(const ControllerConfig& base, std::uint64_t first_seed) {
  static Controller controller;
  static Controller twin;
  const int runs = std::max(8, testing::share_of(kRuns));
  int active_ticks_in_contact = 0;
  for (int run = 0; run < runs; ++run) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(run);
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 generator(seed);
    std::uniform_real_distribution<double> unit;
    ControllerConfig config = base;
    config.safety.max_force_N *= unit(generator);
    config.safety.force_slew_N_per_s = std::pow(10.0, 1.0 + 4.0 * unit(generator));
    config.safety.soft_start_s = 0.05 * unit(generator);
    config.safety.guards_off = run % 4 == 0 ? kNoFault : kWildMotion;
    config.velocity_cutoff_hz = run % 2 == 0 ? 0.0 : 50.0;
    config.joints[1].max_effort *= unit(generator);
    const Floor floor(
        {.stiffness_N_per_m = std::pow(10.0, 5.0 * unit(generator)),
         .damping_Ns_per_m = std::pow(10.0, 3.0 * unit(generator)),
         .friction = rendering::cone_friction(unit(generator), 0.5 * unit(generator))});
    for (Controller* each : {&controller, &twin}) {
      ASSERT_TRUE(each->configure(config));
      ASSERT_TRUE(each->load_scene(floor.objects(), {.tool_radius_m = 0.002}));
    }
    RandomInputs inputs(seed, config);
    Vec3 last_force = Vec3::Zero();
    for (int tick = 0; tick < kTicks; ++tick) {
      const Input input = inputs.next(controller.mode());
      const drivers::JointCommand command = controller.tick(input.sample, input.request);
      const TelemetryRecord& record = controller.record();
      expect_safe(config, input, command, record, last_force);
      last_force = vector_of(record.force_commanded_W);
      active_ticks_in_contact +=
          record.mode == Mode::active && record.contact != rendering::ContactKind::none ? 1 : 0;
      controller.note_transfers(tick % 1777 == 1000 ? drivers::kDeviceLost : drivers::kDeviceOk, 0,
                                0);
      const Input recorded = replayed(record);
      twin.tick(recorded.sample, recorded.request);
      ASSERT_EQ(twin.record().state_hash, record.state_hash) << "tick " << tick;
      ASSERT_FALSE(::testing::Test::HasFailure()) << "tick " << tick;
    }
  }
  EXPECT_GT(active_ticks_in_contact, runs * kTicks / 20);
}

// An operator whose tool does not move: random requests, changes, scenes and faults.
class RandomOperator {
 public:
  RandomOperator(std::uint64_t seed, Controller& controller,
                 std::span<const std::unique_ptr<Floor>> floors)
      : generator_(seed), controller_(controller), floors_(floors) {}

  Request act() {
    if (chance(0.02)) {
      set_something();
    }
    if (chance(0.002)) {
      load_something();
    }
    const bool wants_back = controller_.mode() != Mode::active && chance(0.5);
    if (wants_back) {
      return controller_.mode() == Mode::fault  ? Request::reset
             : controller_.mode() == Mode::init ? Request::home
                                                : Request::enable;
    }
    return chance(0.0005) ? static_cast<Request>(generator_() % kRequestNames.size())
                          : Request::none;
  }

  [[nodiscard]] bool chance(double share) {
    return std::uniform_real_distribution<double>()(generator_) < share;
  }

 private:
  void set_something() {
    const auto& texts = kParameterTexts;
    const ParameterPlace place{.parameter = texts[index_below(texts.size(), generator_)].parameter};
    const auto range = controller_.parameter(place);
    if (!range) {
      return;
    }
    // Small values and large ones alike.
    const double share =
        std::pow(10.0, -6.0 * std::uniform_real_distribution<double>()(generator_));
    const double value = range->least + share * (range->greatest - range->least);
    static_cast<void>(controller_.set_parameter({.place = place, .value = value}));
  }

  void load_something() {
    static const std::array<rendering::Effect, 1> field = {
        {{.law = rendering::ConstantField{.force_W = {6.0, 0.0, 0.0}}, .max_force_N = 6.5}}};
    rendering::WorldConfig config{.tool_radius_m = chance(0.5) ? 0.002 : 0.0};
    if (chance(0.5)) {
      config.effects = field;
    }
    static_cast<void>(controller_.load_scene(
        floors_[index_below(floors_.size(), generator_)]->objects(), config));
  }

  std::mt19937_64 generator_;
  Controller& controller_;
  std::span<const std::unique_ptr<Floor>> floors_;
};

// Returns by how much the soft start raises the largest force in a tick, N. The same holds for a
// raised limit.
double configured_rise(const ControllerConfig& config) {
  return 2.0 * config.safety.max_force_N / (config.safety.soft_start_s * config.rate_hz);
}

// The tool goes to a random depth and stays there.
double next_height(RandomOperator& hand, double height, bool& moves) {
  moves = moves ? !hand.chance(0.02) : hand.chance(0.002);
  if (!moves) {
    return height;
  }
  return std::clamp(height + (hand.chance(0.6) ? -1e-4 : 1e-4), -0.006, 0.01);
}

TEST(ControllerProperty, NoEventRaisesTheForceOnAToolThatDoesNotMoveFasterThanActivationDoes) {
  static Controller controller;
  std::vector<std::unique_ptr<Floor>> floors;
  for (const double stiffness : {100.0, 800.0, 20'000.0}) {
    floors.push_back(std::make_unique<Floor>(
        rendering::Material{.stiffness_N_per_m = stiffness,
                            .damping_Ns_per_m = 2.0,
                            .friction = rendering::cone_friction(0.6, 0.4)}));
  }
  std::size_t pressed = 0;
  const auto runs = static_cast<std::uint64_t>(std::max(4, testing::share_of(kRuns)));
  for (std::uint64_t seed = 7000; seed < 7000 + runs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ControllerConfig config = testing::without_sign_check(cartesian_config());
    config.safety.max_force_N = seed % 2 == 0 ? 10.0 : 8.0;
    config.safety.soft_start_s = 0.2;
    config.safety.guards_off = kWildMotion;
    ASSERT_TRUE(controller.configure(config));
    ASSERT_TRUE(controller.load_scene(floors[0]->objects(), {.tool_radius_m = 0.002}));
    RandomOperator hand(seed, controller, floors);
    double height = 0.01;
    bool moves = false;
    bool followed = true;
    double last_N = 0.0;
    Mode last_mode = Mode::init;
    for (int tick = 0; tick < kTicks; ++tick) {
      const double before = height;
      height = next_height(hand, height, moves);
      drivers::JointSample sample;
      sample.position = {0.01, height, 0.02};
      sample.status = hand.chance(0.0002) ? drivers::kDeviceDriveFault : drivers::kDeviceOk;
      controller.tick(sample, hand.act());
      const TelemetryRecord& record = controller.record();
      const SafetyConfig& safety = controller.config().safety;
      const double force_N = vector_of(record.force_commanded_W).norm();
      const double slew_N = safety.force_slew_N_per_s / config.rate_hz;
      ASSERT_LE(force_N, last_N + slew_N + 1e-9) << "tick " << tick;
      if (record.mode == Mode::active && last_mode != Mode::active) {
        ASSERT_EQ(force_N, 0.0) << "tick " << tick;
      }
      const bool follows = (record.limits & kLimitSlew) == 0;
      const bool settled = height == before && follows && followed;
      followed = follows;
      // Activation and contact gains, and a change, each move it by a share of the largest force.
      const double law_N = configured_rise(config);
      if (settled && (record.limits & kLimitSoftStart) == 0) {
        ASSERT_LE(force_N, last_N + law_N + 1e-9) << "tick " << tick;
        pressed += force_N > 0.0 ? 1U : 0U;
      }
      last_N = force_N;
      last_mode = record.mode;
    }
  }
  EXPECT_GT(pressed, 50 * runs);
}

TEST(ControllerProperty, RandomTicksOfACartesianDeviceStaySafeAndReplayToTheBit) {
  run_random_ticks(testing::without_sign_check(cartesian_config()), 1000);
}

TEST(ControllerProperty, RandomTicksOfAFalconStaySafeAndReplayToTheBit) {
  run_random_ticks(testing::without_sign_check(falcon_config()), 2000);
}

// The handle begins 5 mm over the floor, and goes lower on its arc.
TEST(ControllerProperty, RandomTicksOfAHapkitStaySafeAndReplayToTheBit) {
  ControllerConfig config = testing::without_sign_check(hapkit_config());
  config.workspace_origin_D.y() -= 0.005;
  run_random_ticks(config, 4000);
}

TEST(ControllerProperty, RandomTicksOfAPhantomStaySafeAndReplayToTheBit) {
  ControllerConfig config = testing::without_sign_check(phantom_premium_config());
  for (JointLimits& joint : config.joints) {  // about the pose with the tool at the floor
    joint.lower = -1.0;
    joint.upper = 1.0;
  }
  run_random_ticks(config, 5000);
}

TEST(ControllerProperty, RandomTicksOfAWeightedArmStaySafeAndReplayToTheBit) {
  run_random_ticks(testing::without_sign_check(woodenhaptics_config()), 6000);
}

TEST(ControllerProperty, RandomTicksWithFrictionCompensationStaySafeAndReplayToTheBit) {
  ControllerConfig config = testing::without_sign_check(falcon_config());
  config.friction.fill({.model = {.kind = rendering::FrictionKind::coulomb_viscous,
                                  .coulomb = 0.006,
                                  .viscous_s_per_m = 0.001},
                        .compensated_share = 0.9,
                        .turn_length = 0.002});
  run_random_ticks(config, 3000);
}

}  // namespace
}  // namespace tactus::firmware
