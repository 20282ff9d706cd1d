// One healthy axis that delivers torque, to make something go wrong with.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "drivers/axis.h"
#include "host_tools/emulators/can_emulator.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {

template <class Driver, class Emulator>
class DriveFaults : public ::testing::Test {
 protected:
  static constexpr double kTorque_Nm = 0.1;

  // Simulated time from now to the motor's last torque, and to the tick that tells of the fault;
  // -1: not yet.
  struct Reaction {
    hal::TimeNs torque_gone_ns = -1;
    hal::TimeNs latched_ns = -1;
  };

  template <class DriverConfig, class EmulatorConfig>
  DriveFaults(const CanRigConfig& config, const DriverConfig& driver,
              const EmulatorConfig& emulator)
      : rig_(config, std::vector{driver}, std::vector{emulator}) {
    rig_.rotor(0) = {.inertia_kg_m2 = 0.05, .damping_Nm_s = 0.01};
    rig_.start();
    rig_.command_all(kTorque_Nm);
    EXPECT_GT(rig_.run_until_well(1500 * kMs), 0) << trouble().what;
    rig_.run(20 * kMs);
    EXPECT_NEAR(torque_Nm(), kTorque_Nm, 1e-6);
  }

  Reaction react(hal::TimeNs at_most_ns) {
    Reaction reaction;
    const hal::TimeNs begin_ns = rig_.clock().now_ns();
    while (rig_.clock().now_ns() < begin_ns + at_most_ns) {
      rig_.run(kMs);
      const hal::TimeNs passed_ns = rig_.clock().now_ns() - begin_ns;
      if (reaction.latched_ns < 0 && (status() & ~std::uint32_t{kDeviceStale}) != 0) {
        reaction.latched_ns = passed_ns;
      }
    }
    if (torque_Nm() == 0.0) {
      reaction.torque_gone_ns = rig_.last_torque_ns(0) - begin_ns;
    }
    return reaction;
  }
  void expect_latched(std::uint32_t bits) {
    EXPECT_NE(status() & bits, 0U) << status() << ' ' << trouble().what;
    EXPECT_EQ(torque_Nm(), 0.0);
    EXPECT_FALSE(trouble().what.empty());
    EXPECT_FALSE(trouble().remedy.empty());
  }
  // The device is well again: nothing happens by itself, but after clear_faults all is as before.
  void expect_recovery() {
    rig_.emulator(0).set_fault(host::EmulatorFault::none);
    rig_.run(200 * kMs);
    EXPECT_NE(status(), kDeviceOk) << "not latched";
    EXPECT_EQ(torque_Nm(), 0.0);
    rig_.board().clear_faults();
    EXPECT_GT(rig_.run_until_well(1500 * kMs), 0) << trouble().what;
    rig_.run(3 * kMs);
    EXPECT_NEAR(torque_Nm(), kTorque_Nm, 1e-6);
  }

  [[nodiscard]] std::uint32_t status() const { return rig_.sample(0).status; }
  double torque_Nm() { return rig_.emulator(0).shaft().torque_Nm; }
  Trouble trouble() { return rig_.board().trouble(0); }

  CanRig<Driver, Emulator> rig_;
};

}  // namespace tactus::drivers
