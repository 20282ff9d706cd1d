// Motors and encoders that are wired or scaled wrong, on every preset, in every hand: the fault
// that ends it, and the force and displacement that the hand feels until then. The tables are
// printed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/safety/faults.h"
#include "host_tools/simulation/simulation.h"
#include "tests/support/rows.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

constexpr unsigned kAll = 0b111;
constexpr std::array<std::string_view, 4> kHands = {"finger", "pen", "firm", "none"};

// The factors by which a joint's motor or encoder differs from the configuration; 1 is right.
struct Wrong {
  double torque = 1.0;
  double counts = 1.0;
};

// A device on which some joints are wrong.
struct WrongDevice {
  host::SimulatedDevice& device;
  unsigned joints;
  Wrong wrong;
  const std::array<double, drivers::kMaxJoints>& homed;  // positions that are right all the same
  [[nodiscard]] std::size_t joint_count() const { return device.joint_count(); }
  [[nodiscard]] bool is_wrong(std::size_t joint) const { return (joints >> joint & 1U) != 0; }
  void read(drivers::JointSample& sample) const {
    device.read(sample);
    for (std::size_t joint = 0; joint < joint_count(); ++joint) {
      const double moved = sample.position[joint] - homed[joint];
      sample.position[joint] = homed[joint] + moved * (is_wrong(joint) ? wrong.counts : 1.0);
      sample.velocity[joint] *= is_wrong(joint) ? wrong.counts : 1.0;
    }
  }
  std::uint32_t write(const drivers::JointCommand& command) const {
    drivers::JointCommand turned = command;
    for (std::size_t joint = 0; joint < joint_count(); ++joint) {
      turned.effort[joint] *= is_wrong(joint) ? wrong.torque : 1.0;
    }
    return device.write(turned);
  }
  void clear_faults() const { device.clear_faults(); }
};

struct Press {
  std::string_view preset;
  std::string_view hand;
  unsigned joints = 0;  // that are wrong, a bit each
  Wrong wrong{.torque = -1.0};
  double stiffness_N_per_m = 1000.0;
  double press_s = 1.0;
  double depth_m = 0.003;
  bool begins_in_touch = false;
};

struct PressOutcome {
  double peak_N = 0.0;
  double above_2_N_s = 0.0;
  double displaced_m = 0.0;  // from where the hand wants to be, in contact
  std::uint64_t faults = 0;
  std::uint32_t joint = 0;
  double commanded_N = 0.0;  // the largest that was rendered
  double unchecked_s = 0.0;  // with power, before all motors had answered
};

// A direction in which the preset's handle can move.
Vec3 way_in(std::string_view preset) {
  if (preset == "hapkit") {
    return Vec3::UnitX();
  }
  return preset == "haply_pantograph" ? Vec3::UnitZ() : Vec3::UnitY();
}

PressOutcome outcome_of(const Press& press) {
  const Vec3 out = way_in(press.preset);
  const Vec3 far = (press.begins_in_touch ? -press.depth_m : 0.006) * out;
  const Vec3 deep = -press.depth_m * out;
  const double touched_s = 1.5 + press.press_s;
  host::SimulationConfig config{
      .path = host::WishPath({{0.0, far}, {1.5, far}, {touched_s, deep}, {4.0, deep}})};
  config.device = *host::device_preset(press.preset);
  config.controller = *firmware::preset_config(press.preset);
  config.controller.safety.moving_mass_kg = config.device.device.plant.moving_mass_kg;
  config.hand = press.hand == "none" ? host::HandParameters{} : *host::hand_preset(press.hand);
  // Its face through the origin is the surface; the box lies behind it.
  const Solid wall(
      moved(box(Vec3::Constant(0.5)), -0.25 * out), rendering::Sides::one,
      rendering::Material{
          .stiffness_N_per_m = press.stiffness_N_per_m, .damping_Ns_per_m = 0.0, .friction = {}});
  const std::array objects = {wall.object()};
  host::Simulation simulation(config, objects, 0.001);
  drivers::JointSample homed;
  PressOutcome outcome;
  for (int tick = 0; tick < 4000 && outcome.faults == 0; ++tick) {
    const firmware::Mode mode = simulation.controller().mode();
    if (mode != firmware::Mode::active) {
      host::SimulatedDevice(simulation.device()).read(homed);
    }
    const firmware::Request request = firmware::request_toward_active(mode);
    simulation.tick({&request, 1}, [&](host::SimulatedDevice& device, std::size_t /*number*/) {
      return WrongDevice{device, press.joints, press.wrong, homed.position};
    });
    const double force_N = simulation.device().motor_force_B().norm();
    outcome.peak_N = std::max(outcome.peak_N, force_N);
    outcome.above_2_N_s += force_N > 2.0 ? 0.001 : 0.0;
    if (simulation.record().contact != rendering::ContactKind::none) {
      outcome.displaced_m =
          std::max(outcome.displaced_m, (simulation.handle_W() - simulation.wish_W()).norm());
    }
    outcome.commanded_N =
        std::max(outcome.commanded_N, Vec3(simulation.record().force_commanded_W.data()).norm());
    outcome.unchecked_s +=
        (simulation.record().limits & firmware::kLimitSignCheck) != 0 ? 0.001 : 0.0;
    outcome.faults = simulation.record().faults;
    outcome.joint = simulation.record().fault_joint;
  }
  return outcome;
}

std::string fault_of(const PressOutcome& outcome) {
  for (const firmware::FaultText& text : firmware::kFaultTexts) {
    if ((outcome.faults & text.bit) != 0) {
      return std::string(text.name);
    }
  }
  return "none";
}

std::string named(const Press& press) {
  std::string joints;
  for (unsigned joint = 0; joint < 3; ++joint) {
    if ((press.joints >> joint & 1U) != 0) {
      joints += std::to_string(joint + 1);
    }
  }
  return std::string(press.preset) + " joints " + joints + " " + std::string(press.hand) +
         (press.begins_in_touch ? " in touch" : "");
}

void print(const Press& press, const PressOutcome& outcome) {
  std::printf(
      "torque x %5.2f, counts x %2.0f, %-44s: %5.2f N, above 2 N %4.0f ms, %4.1f mm, %s, "
      "joint %u\n",
      press.wrong.torque, press.wrong.counts, named(press).c_str(), outcome.peak_N,
      1000.0 * outcome.above_2_N_s, 1000.0 * outcome.displaced_m, fault_of(outcome).c_str(),
      outcome.joint);
}

// Each joint of the preset alone, and all of them.
std::vector<unsigned> joint_sets(std::string_view preset) {
  const std::size_t count = firmware::joint_count(firmware::preset_config(preset)->mechanism);
  std::vector<unsigned> sets;
  sets.reserve(count + 1);
  for (std::size_t joint = 0; joint < count; ++joint) {
    sets.push_back(1U << joint);
  }
  if (count > 1) {
    sets.push_back((1U << count) - 1U);
  }
  return sets;
}

template <class Check>
void for_every_press(const Wrong& wrong, const Check& check) {
  for (const std::string_view preset : firmware::kPresetNames) {
    for (const unsigned joints : joint_sets(preset)) {
      for (const std::string_view hand : kHands) {
        for (const bool begins_in_touch : {false, true}) {
          if (!is_taken()) {
            continue;
          }
          const Press press{.preset = preset,
                            .hand = hand,
                            .joints = joints,
                            .wrong = wrong,
                            .begins_in_touch = begins_in_touch};
          const PressOutcome outcome = outcome_of(press);
          print(press, outcome);
          SCOPED_TRACE(named(press));
          check(press, outcome);
        }
      }
    }
  }
}

// The bounds of a wrong sign: a fault that names a wrong joint before the hand is pushed hard or
// far.
void expect_found(const Press& press, const PressOutcome& outcome) {
  EXPECT_EQ(outcome.faults, firmware::kFaultMotorReversed);
  EXPECT_NE(outcome.joint, 0U);
  EXPECT_EQ(press.joints >> (outcome.joint - 1U) & 1U, 1U) << outcome.joint;
  EXPECT_LE(outcome.above_2_N_s, 0.050);
  EXPECT_LE(outcome.displaced_m, 0.010);
}

// An arm with weights that nobody holds lies on its stops, and a motor that pushes it against them
// cannot be told from a right one whose arm is too heavy for the push.
bool lies_on_its_stops(const Press& press) {
  return press.preset == "woodenhaptics" && press.hand == "none";
}

TEST(WrongJoint, AReversedMotorIsFoundOnEveryPresetInEveryHand) {
  for_every_press(Wrong{.torque = -1.0}, [](const Press& press, const PressOutcome& outcome) {
    if (!lies_on_its_stops(press)) {
      expect_found(press, outcome);
    }
  });
}

TEST(WrongJoint, AReversedEncoderIsFoundOnEveryPresetInEveryHand) {
  for_every_press(Wrong{.counts = -1.0}, [](const Press& press, const PressOutcome& outcome) {
    if (!lies_on_its_stops(press)) {
      expect_found(press, outcome);
    }
  });
}

// With a hand on it a device that is too strong may answer like a right one without.
TEST(WrongJoint, ThreeTimesTheTorqueIsFoundWithoutAHand) {
  for_every_press(Wrong{.torque = 3.0}, [](const Press& press, const PressOutcome& outcome) {
    if (press.hand == "none" && !lies_on_its_stops(press)) {
      EXPECT_EQ(outcome.faults, firmware::kFaultEffortMismatch);
      EXPECT_EQ(press.joints >> (outcome.joint - 1U) & 1U, 1U) << outcome.joint;
    }
  });
}

TEST(WrongJoint, FourTimesTheCountsAreFoundWithoutAHand) {
  for_every_press(Wrong{.counts = 4.0}, [](const Press& press, const PressOutcome& outcome) {
    if (press.hand == "none" && !lies_on_its_stops(press)) {
      EXPECT_EQ(outcome.faults, firmware::kFaultEffortMismatch);
      EXPECT_EQ(press.joints >> (outcome.joint - 1U) & 1U, 1U) << outcome.joint;
    }
  });
}

TEST(WrongJoint, AThirdOfTheTorqueHurtsNobody) {
  for_every_press(Wrong{.torque = 1.0 / 3.0}, [](const Press& press, const PressOutcome& outcome) {
    EXPECT_EQ(outcome.faults & firmware::kFaultMotorReversed, 0U) << outcome.joint << press.hand;
  });
}

// A motor without power answers nothing, however hard the hand presses.
TEST(WrongJoint, TheForceIsSmallUntilAllHaveAnswered) {
  for (const std::string_view preset : {"cartesian", "falcon", "phantom_premium"}) {
    const Press press{.preset = preset,
                      .hand = "firm",
                      .joints = 1,
                      .wrong = {.torque = 0.0},
                      .stiffness_N_per_m = 2000.0,
                      .depth_m = 0.008};
    const PressOutcome outcome = outcome_of(press);
    EXPECT_EQ(outcome.faults, firmware::kNoFault) << preset;
    EXPECT_LE(outcome.commanded_N, 1.05) << preset;
  }
}

// The device is in a hand, so that nobody notices that the force was held back: it is still rising.
TEST(WrongJoint, RightMotorsAnswerWithinTheSoftStart) {
  for (const std::string_view preset : firmware::kPresetNames) {
    for (const std::string_view hand : {"finger", "pen", "firm"}) {
      for (const bool begins_in_touch : {false, true}) {
        if (!is_taken()) {
          continue;
        }
        const Press press{.preset = preset, .hand = hand, .begins_in_touch = begins_in_touch};
        const double unchecked_s = outcome_of(press).unchecked_s;
        EXPECT_LE(unchecked_s, firmware::SafetyConfig{}.soft_start_s) << named(press);
        std::printf("%-40s: %3.0f ms\n", named(press).c_str(), 1000.0 * unchecked_s);
      }
    }
  }
}

TEST(WrongJoint, NoneIsSeenWhereAllAreRight) {
  constexpr std::uint64_t kFound = firmware::kFaultMotorReversed | firmware::kFaultEffortMismatch;
  for (const std::string_view preset : firmware::kPresetNames) {
    for (const std::string_view hand : kHands) {
      for (const double stiffness_N_per_m : {300.0, 1000.0, 4000.0}) {
        for (const double press_s : {0.15, 0.4, 1.0}) {
          for (const bool begins_in_touch : {false, true}) {
            if (!is_taken(25)) {
              continue;
            }
            const Press press{.preset = preset,
                              .hand = hand,
                              .joints = 0,
                              .stiffness_N_per_m = stiffness_N_per_m,
                              .press_s = press_s,
                              .depth_m = 0.008,
                              .begins_in_touch = begins_in_touch};
            EXPECT_EQ(outcome_of(press).faults & kFound, 0U)
                << named(press) << ' ' << stiffness_N_per_m << ' ' << press_s;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace tactus::testing
