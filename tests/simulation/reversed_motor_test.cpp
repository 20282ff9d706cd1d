// Motors wired the wrong way round, on every preset, in every hand: what the guard finds, and what
// the hand feels until then. The whole table is printed; the rows that the guard can promise are
// held.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/safety/faults.h"
#include "host_tools/simulation/simulation.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

constexpr unsigned kAll = 0b111;
constexpr std::array<std::string_view, 4> kHands = {"finger", "pen", "firm", "none"};

// Turns the efforts of some motors round.
struct ReversedMotors {
  host::SimulatedDevice& device;
  unsigned reversed;
  [[nodiscard]] std::size_t joint_count() const { return device.joint_count(); }
  void read(drivers::JointSample& sample) const { device.read(sample); }
  std::uint32_t write(const drivers::JointCommand& command) const {
    drivers::JointCommand turned = command;
    for (std::size_t joint = 0; joint < joint_count(); ++joint) {
      turned.effort[joint] *= (reversed >> joint & 1U) != 0 ? -1.0 : 1.0;
    }
    return device.write(turned);
  }
  void clear_faults() const { device.clear_faults(); }
};

struct Press {
  std::string_view preset;
  std::string_view hand;
  unsigned reversed = 0;
  double stiffness_N_per_m = 1000.0;
  double press_s = 1.0;
  double depth_m = 0.003;
};

struct Felt {
  double peak_N = 0.0;
  double above_2_N_s = 0.0;
  double displaced_m = 0.0;  // from where the hand wants to be, in contact
  std::uint64_t faults = 0;
  std::uint32_t joint = 0;
};

// A direction in which the preset's handle can move.
Vec3 way_in(std::string_view preset) {
  if (preset == "hapkit") {
    return Vec3::UnitX();
  }
  return preset == "haply_pantograph" ? Vec3::UnitZ() : Vec3::UnitY();
}

Felt felt_in(const Press& press) {
  const Vec3 out = way_in(press.preset);
  const Vec3 far = 0.006 * out;
  const Vec3 deep = -press.depth_m * out;
  const double touched_s = 1.5 + press.press_s;
  host::SimulationConfig config{
      .path = host::WishPath({{0.0, far}, {1.5, far}, {touched_s, deep}, {4.0, deep}})};
  config.device = *host::device_preset(press.preset);
  config.controller = *firmware::preset_config(press.preset);
  config.hand = press.hand == "none" ? host::HandParameters{} : *host::hand_preset(press.hand);
  // Its face through the origin is the surface; the box lies behind it.
  const Solid wall(
      moved(box(Vec3::Constant(0.5)), -0.25 * out), rendering::Sides::one,
      rendering::Material{
          .stiffness_N_per_m = press.stiffness_N_per_m, .damping_Ns_per_m = 0.0, .friction = {}});
  const std::array objects = {wall.object()};
  host::Simulation simulation(config, objects, 0.001);
  Felt felt;
  for (int tick = 0; tick < 4000 && felt.faults == 0; ++tick) {
    const firmware::Mode mode = simulation.controller().mode();
    const auto request = mode == firmware::Mode::init    ? firmware::Request::home
                         : mode == firmware::Mode::ready ? firmware::Request::enable
                                                         : firmware::Request::none;
    simulation.tick(request, [&](host::SimulatedDevice& device) {
      return ReversedMotors{device, press.reversed};
    });
    const double force_N = simulation.device().motor_force_B().norm();
    felt.peak_N = std::max(felt.peak_N, force_N);
    felt.above_2_N_s += force_N > 2.0 ? 0.001 : 0.0;
    if (simulation.record().contact != rendering::ContactKind::none) {
      felt.displaced_m =
          std::max(felt.displaced_m, (simulation.handle_W() - simulation.wish_W()).norm());
    }
    felt.faults = simulation.record().faults;
    felt.joint = simulation.record().fault_joint;
  }
  return felt;
}

void print(const Press& press, const Felt& felt) {
  std::string fault = "none";
  for (const firmware::FaultText& text : firmware::kFaultTexts) {
    if ((felt.faults & text.bit) != 0) {
      fault = text.name;
    }
  }
  std::printf("%-16s motors %u %-6s: %5.2f N, above 2 N for %4.0f ms, %4.1f mm, %s, joint %u\n",
              std::string(press.preset).c_str(), press.reversed, std::string(press.hand).c_str(),
              felt.peak_N, 1000.0 * felt.above_2_N_s, 1000.0 * felt.displaced_m, fault.c_str(),
              felt.joint);
}

TEST(ReversedMotor, TheTableOfPresetsMotorsAndHands) {
  for (const std::string_view preset : firmware::kPresetNames) {
    for (const unsigned reversed : {1U, 2U, 4U, kAll}) {
      for (const std::string_view hand : kHands) {
        const Press row{.preset = preset, .hand = hand, .reversed = reversed};
        print(row, felt_in(row));
      }
    }
  }
}

// One joint takes the whole force there, and the hand yields.
TEST(ReversedMotor, BehindASurfaceIsFoundBeforeTheHandIsPushedFar) {
  for (const std::string_view hand : {"finger", "pen"}) {
    for (const unsigned reversed : {0U, kAll}) {
      for (const auto& [preset, joint] :
           {std::pair<std::string_view, unsigned>{"cartesian", 1U}, {"hapkit", 0U}}) {
        const Press row{
            .preset = preset, .hand = hand, .reversed = reversed != 0 ? reversed : 1U << joint};
        const Felt felt = felt_in(row);
        EXPECT_EQ(felt.faults, firmware::kFaultMotorReversed) << preset << ' ' << hand;
        EXPECT_EQ(felt.joint, joint + 1U) << preset << ' ' << hand;
        EXPECT_LE(felt.above_2_N_s, 0.050) << preset << ' ' << hand;
        EXPECT_LE(felt.displaced_m, 0.010) << preset << ' ' << hand;
      }
    }
  }
}

TEST(ReversedMotor, NoneIsSeenWhereMotorsAreRight) {
  for (const std::string_view preset : firmware::kPresetNames) {
    for (const std::string_view hand : kHands) {
      for (const double stiffness_N_per_m : {300.0, 1000.0}) {
        for (const double press_s : {0.15, 0.4, 1.0}) {
          const Press row{.preset = preset,
                          .hand = hand,
                          .reversed = 0,
                          .stiffness_N_per_m = stiffness_N_per_m,
                          .press_s = press_s,
                          .depth_m = 0.008};
          EXPECT_EQ(felt_in(row).faults & firmware::kFaultMotorReversed, 0U)
              << preset << ' ' << hand << ' ' << stiffness_N_per_m << ' ' << press_s;
        }
      }
    }
  }
}

}  // namespace
}  // namespace tactus::testing
