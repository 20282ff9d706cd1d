// Walls from soft to far beyond what the device holds, pressed and tapped: the plant's own ledger
// of the motors' work says what the hand was really given.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/safety/faults.h"
#include "host_tools/simulation/simulation.h"
#include "tests/support/rows.h"

namespace tactus::testing {
namespace {

using host::WishPath;

constexpr int kTicks = 8000;

// The wall's normal, along which the device's handle can move from the middle of its workspace.
Vec3 normal_of(std::string_view device) {
  return device == "hapkit" || device == "haply_pantograph" ? Vec3::UnitX() : Vec3::UnitY();
}

// Straight onto the wall through the origin, 3 mm into it, and still.
WishPath pressing(std::string_view device) {
  const Vec3 n = normal_of(device);
  return WishPath({{0.0, 0.006 * n}, {1.5, 0.006 * n}, {2.5, -0.003 * n}, {8.0, -0.003 * n}});
}

// A hand taps as fast as it can: from 10 mm above the wall to as much below and back in a fifth of
// a second.
WishPath tapping(std::string_view device) {
  const Vec3 n = normal_of(device);
  std::vector<host::Waypoint> points{{0.0, 0.01 * n}, {1.5, 0.01 * n}};
  for (int tap = 0; tap < 20; ++tap) {
    points.push_back({1.6 + 0.2 * tap, -0.01 * n});
    points.push_back({1.7 + 0.2 * tap, 0.01 * n});
  }
  points.push_back({8.0, -0.005 * n});
  return WishPath(points);
}

// No hand is a steady push by a spring that is soft beside any wall.
host::HandParameters hand_of(std::string_view name) {
  return name == "none" ? host::HandParameters{.stiffness_N_per_m = 60.0}
                        : *host::hand_preset(name);
}

host::SimulationConfig config_of(std::string_view device, std::string_view hand, WishPath path) {
  host::SimulationConfig config{.path = std::move(path)};
  config.device = *host::device_preset(device);
  config.controller = *firmware::preset_config(device);
  config.hand = hand_of(hand);
  return config;
}

struct Outcome {
  double motors_J = 0.0;       // the plant's ledger, from the end of activation on
  double account_J = 0.0;      // the record's, over the same time
  double swing_m = 0.0;        // of the handle in the last second
  double fault_after_s = 0.0;  // from when the motors had given a millijoule
  int damped_ticks = 0;
  int contact_ticks = 0;
  std::uint64_t faults = 0;
};

// Returns the motors' work, J. Energy stored in weights comes back from the motors that hold them.
double motors_work_J(const host::Simulation& simulation) {
  const host::EnergyLedger& ledger = simulation.device().plant().ledger();
  return ledger.motors_J + ledger.weight_J;
}

double account_J(const host::Simulation& simulation) {
  const firmware::EnergyLedger& ledger = simulation.record().energy_J;
  return std::accumulate(ledger.begin(), ledger.end(), 0.0);
}

// A plane through the origin: y = 0, or x = 0 where the handle cannot move along y.
rendering::Object wall_for(std::string_view device, double stiffness_N_per_m) {
  rendering::Object wall;
  wall.surface = rendering::SurfaceKind::primitive;
  wall.primitive.kind = rendering::PrimitiveKind::plane;
  if (normal_of(device) == Vec3::UnitX()) {
    wall.primitive.X_WO.rotation << 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  }
  wall.material.stiffness_N_per_m = stiffness_N_per_m;
  return wall;
}

Outcome touch_wall(const host::SimulationConfig& config, const rendering::Object& wall) {
  const auto height_m = [&wall](const host::Simulation& simulation) {
    return simulation.handle_W().dot(wall.primitive.X_WO.rotation.col(1));
  };
  host::Simulation simulation(config, {&wall, 1}, 0.001);
  Outcome outcome;
  double lowest_J = 1e9;
  double least_m = 1.0;
  double most_m = -1.0;
  double start_J = 0.0;
  double start_account_J = 0.0;
  int start_tick = kTicks;
  for (int tick = 0; tick < kTicks && outcome.faults == 0; ++tick) {
    simulation.tick();
    if (tick == 1500) {
      start_J = motors_work_J(simulation);
      start_account_J = account_J(simulation);
    }
    lowest_J = tick >= 1500 ? std::min(lowest_J, motors_work_J(simulation)) : lowest_J;
    if (motors_work_J(simulation) > lowest_J + 1e-3) {
      start_tick = std::min(start_tick, tick);
    }
    if (tick >= kTicks - 1000) {
      least_m = std::min(least_m, height_m(simulation));
      most_m = std::max(most_m, height_m(simulation));
    }
    outcome.damped_ticks += (simulation.record().limits & firmware::kLimitPassivity) != 0 ? 1 : 0;
    outcome.contact_ticks += simulation.record().contact != rendering::ContactKind::none ? 1 : 0;
    outcome.faults = simulation.record().faults;
    outcome.fault_after_s = 1e-3 * (tick - start_tick);
  }
  outcome.motors_J = motors_work_J(simulation) - start_J;
  outcome.account_J = account_J(simulation) - start_account_J;
  outcome.swing_m = most_m - least_m;
  return outcome;
}

TEST(StiffWall, TheAccountIsWhatTheMotorsGave) {
  for (const char* device : {"cartesian", "falcon", "woodenhaptics"}) {
    for (const char* hand : {"finger", "pen"}) {
      for (const double stiffness : {1e4, 1e5, 1e6}) {
        if (!is_taken(5)) {
          continue;
        }
        host::SimulationConfig config = config_of(device, hand, pressing(device));
        config.controller.safety.passivity_damping_Ns_per_m = 0.0;
        config.controller.safety.guards_off = firmware::kFaultNotPassive;
        const Outcome outcome = touch_wall(config, wall_for(device, stiffness));
        EXPECT_GT(outcome.motors_J, 0.05);
        EXPECT_NEAR(outcome.account_J, outcome.motors_J, 0.05 * outcome.motors_J)
            << device << ", " << hand << ", " << stiffness << " N/m";
      }
    }
  }
}

void expect_no_lasting_buzz(std::string_view device, const char* hand, double stiffness_N_per_m,
                            double longest_s) {
  const Outcome outcome =
      touch_wall(config_of(device, hand, pressing(device)), wall_for(device, stiffness_N_per_m));
  const std::string what = fmt::format("{}, {}, {:.0f} N/m", device, hand, stiffness_N_per_m);
  EXPECT_GT(outcome.contact_ticks, 0) << what;
  if (outcome.faults == 0) {
    EXPECT_LT(outcome.swing_m, 0.0002) << what;
  } else {
    EXPECT_EQ(outcome.faults, firmware::kFaultNotPassive) << what;
    EXPECT_LT(outcome.fault_after_s, longest_s) << what;
  }
}

TEST(StiffWall, FarBeyondTheLimitItBuzzesForAMomentAtMost) {
  for (const char* hand : {"none", "finger", "pen"}) {
    // A tool that nobody holds bounces too slowly for the detector, and its debt has to grow.
    const double longest_s = std::string_view(hand) == "none" ? 0.6 : 0.3;
    for (const double stiffness : {3e3, 1e4, 3e4, 1e5, 3e5, 1e6}) {
      if (!is_taken(5)) {
        continue;
      }
      expect_no_lasting_buzz("cartesian", hand, stiffness, longest_s);
    }
  }
}

// The force answers by the device's delay late and is held for half a tick more in the mean: the
// wall K takes K (T / 2 + d) of the damping that device and hand have.
TEST(StiffWall, LittleBeyondTheLimitItDoesNotBuzz) {
  for (const std::string_view device : firmware::kPresetNames) {
    for (const char* hand : {"none", "finger", "pen", "firm"}) {
      const double held_Ns_per_m = host::device_preset(device)->device.plant.viscous_Ns_per_m +
                                   hand_of(hand).damping_Ns_per_m;
      const double late_s = 0.0005 + firmware::preset_config(device)->safety.device_delay_s;
      for (const double times : {1.1, 1.5, 2.0, 3.0}) {
        if (is_taken()) {
          expect_no_lasting_buzz(device, hand, times * held_Ns_per_m / late_s, 0.3);
        }
      }
    }
  }
}

TEST(StiffWall, BelowWhatTheBareDeviceHoldsNothingIsDamped) {
  for (const char* hand : {"none", "finger", "pen", "firm"}) {
    const Outcome outcome = touch_wall(config_of("cartesian", hand, pressing("cartesian")),
                                       wall_for("cartesian", 150.0));
    EXPECT_EQ(outcome.damped_ticks, 0) << hand;
    EXPECT_EQ(outcome.faults, 0U) << hand;
  }
}

TEST(StiffWall, PressingAndTappingWhatTheHandHoldsIsNoFault) {
  for (const std::string_view device : firmware::kPresetNames) {
    for (const char* hand : {"finger", "pen", "firm"}) {
      for (const double stiffness : {300.0, 800.0, 1500.0}) {
        if (!is_taken()) {
          continue;
        }
        const rendering::Object wall = wall_for(device, stiffness);
        EXPECT_EQ(touch_wall(config_of(device, hand, pressing(device)), wall).faults, 0U)
            << device << ", " << hand << ", " << stiffness << " N/m";
        EXPECT_EQ(touch_wall(config_of(device, hand, tapping(device)), wall).faults, 0U)
            << "tapping, " << device << ", " << hand << ", " << stiffness << " N/m";
      }
    }
  }
}

// The simulated devices' delays are those that their controllers expect.
TEST(StiffWall, ThePresetsKnowTheDelayOfTheirDevices) {
  for (const std::string_view name : firmware::kPresetNames) {
    const host::DeviceParameters device = host::device_preset(name)->device;
    const double delay_s =
        0.001 * static_cast<double>(device.delay_ticks) + device.motor_time_constant_s;
    EXPECT_DOUBLE_EQ(firmware::preset_config(name)->safety.device_delay_s, delay_s) << name;
    EXPECT_LE(firmware::preset_config(name)->safety.device_damping_Ns_per_m,
              device.plant.viscous_Ns_per_m)
        << name;
  }
}

}  // namespace
}  // namespace tactus::testing
