// Every way in which a CiA 402 drive or a moteus may lose its encoder's zero unseen, and the proof
// of the moteus's watchdog.
#include <gtest/gtest.h>

#include <string_view>

#include "drivers/cia402_can/cia402_can.h"
#include "drivers/moteus_canfd/moteus_canfd.h"
#include "host_tools/emulators/cia402_emulator.h"
#include "host_tools/emulators/moteus_emulator.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {
namespace {

using LostMoteusRig = CanRig<MoteusCanFd, host::MoteusEmulator>;
using LostCia402Rig = CanRig<Cia402Can, host::Cia402Emulator>;

LostMoteusRig lost_moteus(const MoteusConfig& config = {},
                          const host::MoteusEmulatorConfig& servo = {}) {
  return LostMoteusRig({.network = {.fd = true, .bit_rate = 1'000'000, .data_bit_rate = 5'000'000}},
                       std::vector{config}, std::vector{servo});
}

template <class Rig>
bool says_lost(Rig& rig, hal::TimeNs within_ns) {
  bool is_lost = false;
  rig.run(within_ns, [&](auto& samples, auto&) {
    is_lost = is_lost || (samples[0].status & kDeviceReferenceLost) != 0;
  });
  return is_lost;
}

TEST(LostMoteus, EveryLossIsToldAlsoAfterAnotherFault) {
  for (const int first_fault : {0, 37}) {
    for (const host::EmulatorFault fault :
         {host::EmulatorFault::silent, host::EmulatorFault::unplugged,
          host::EmulatorFault::power_cycled}) {
      LostMoteusRig rig = lost_moteus();
      rig.start();
      ASSERT_GT(rig.run_until_well(1000 * kMs), 0) << rig.board().trouble(0).what;
      if (first_fault != 0) {
        rig.emulator(0).raise_fault(first_fault);
        ASSERT_FALSE(says_lost(rig, 50 * kMs));
        ASSERT_NE(rig.sample(0).status & kDeviceDriveFault, 0U);
      }
      rig.emulator(0).set_fault(fault);
      EXPECT_TRUE(says_lost(rig, 10 * kMs)) << static_cast<int>(fault) << ' ' << first_fault;
    }
  }
}

TEST(LostMoteus, FaultOfTheSupplyLosesTheReferenceAndOthersDoNot) {
  for (const auto& [code, loses] : {std::pair{40, true}, {33, true}, {37, false}, {38, false}}) {
    LostMoteusRig rig = lost_moteus();
    rig.start();
    ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
    rig.emulator(0).raise_fault(code);
    EXPECT_EQ(says_lost(rig, 20 * kMs), loses) << code;
  }
}

TEST(LostMoteus, LossBetweenTheFaultAndTheEndOfTheBringUpIsTold) {
  LostMoteusRig rig = lost_moteus();
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.emulator(0).raise_fault(37);
  ASSERT_FALSE(says_lost(rig, 20 * kMs));
  rig.board().clear_faults();
  ASSERT_FALSE(says_lost(rig, 3 * kMs));
  rig.emulator(0).set_fault(host::EmulatorFault::power_cycled);
  EXPECT_TRUE(says_lost(rig, 10 * kMs));
}

// The servo restarts into mode position, at rest at zero, with home state 0, so soon that no reply
// is missing.
TEST(LostMoteus, ServoThatKnowsLessOfItsPositionThanBeforeHasRestarted) {
  LostMoteusRig rig = lost_moteus();
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  ASSERT_NEAR(rig.sample(0).position_rad, 0.0, 1e-9);
  hal::SimulatedCanBus restarted(rig.network());
  ASSERT_TRUE(
      restarted.send(frame_of("00000100##1 24 04 00 0A 00 00 00 00 00 00 00 21 0C 00 50 50")));
  EXPECT_TRUE(says_lost(rig, 2 * kMs));
}

TEST(LostMoteus, AbsoluteJointWithoutAnOutputEncoderDoesNotComeUp) {
  LostMoteusRig rig = lost_moteus({.absolute_output = true});
  rig.start();
  EXPECT_LT(rig.run_until_well(1000 * kMs), 0);
  EXPECT_NE(rig.sample(0).status & kDeviceDriveFault, 0U);
  EXPECT_NE(rig.board().trouble(0).remedy.find("home the joint"), std::string_view::npos);
  LostMoteusRig with = lost_moteus({.absolute_output = true}, {.output_encoder = true});
  with.start();
  EXPECT_GT(with.run_until_well(1000 * kMs), 0) << with.board().trouble(0).what;
}

TEST(LostMoteus, WatchdogThatDoesNotTripIsRefusedUnlessTheOwnerAcceptsIt) {
  for (const bool accepted : {false, true}) {
    LostMoteusRig rig = lost_moteus({.unproven_watchdog = accepted}, {.has_watchdog = false});
    rig.start();
    EXPECT_EQ(rig.run_until_well(1000 * kMs) > 0, accepted);
    EXPECT_EQ(rig.sample(0).status, accepted ? kDeviceOk : kDeviceDriveFault);
    EXPECT_EQ(rig.board().trouble(0).what.find("watchdog") != std::string_view::npos, !accepted);
  }
}

TEST(LostMoteus, PowerOffStopsTheServoAndItComesBack) {
  LostMoteusRig rig = lost_moteus();
  rig.start();
  rig.command_all(0.1);
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.run(20 * kMs, [](auto&, auto& commands) { commands[0] = {.power_off = true}; });
  EXPECT_EQ(rig.emulator(0).mode(), 0);
  EXPECT_EQ(rig.sample(0).status, kDeviceOk);
  rig.command_all(0.1);
  rig.run(2 * kMs);
  EXPECT_GT(rig.run_until_well(200 * kMs), 0) << rig.board().trouble(0).what;
}

TEST(LostCia402, EveryLossIsToldAlsoAfterAnotherFault) {
  for (const bool has_failed : {false, true}) {
    for (const host::EmulatorFault fault :
         {host::EmulatorFault::silent, host::EmulatorFault::unplugged,
          host::EmulatorFault::power_cycled}) {
      LostCia402Rig rig({}, std::vector<Cia402Config>{{.max_torque_Nm = 0.5}},
                        std::vector<host::Cia402EmulatorConfig>{{}});
      rig.start();
      ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
      if (has_failed) {
        rig.emulator(0).raise_fault(rig.clock().now_ns(), 0x2310);
        ASSERT_FALSE(says_lost(rig, 50 * kMs));
        ASSERT_NE(rig.sample(0).status & kDeviceDriveFault, 0U);
      }
      rig.emulator(0).set_fault(fault);
      EXPECT_TRUE(says_lost(rig, 70 * kMs)) << static_cast<int>(fault) << ' ' << has_failed;
    }
  }
}

// The restart is so soon that neither a heartbeat nor a sample is missing.
TEST(LostCia402, BootUpMessageAloneLosesTheReference) {
  LostCia402Rig rig({}, std::vector<Cia402Config>{{.max_torque_Nm = 0.5}},
                    std::vector<host::Cia402EmulatorConfig>{{}});
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  hal::SimulatedCanBus restarted(rig.network());
  ASSERT_TRUE(restarted.send(frame_of("701#00")));
  EXPECT_TRUE(says_lost(rig, 2 * kMs));
}

TEST(LostCia402, ErrorsOfSupplyAndEncoderLoseTheReferenceAndOthersDoNot) {
  for (const auto& [code, loses] :
       {std::pair<std::uint16_t, bool>{0x3220, true}, {0x7305, true}, {0x2310, false}}) {
    for (const bool tells : {true, false}) {
      LostCia402Rig rig({}, std::vector<Cia402Config>{{.max_torque_Nm = 0.5}},
                        std::vector<host::Cia402EmulatorConfig>{{}});
      rig.start();
      ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
      rig.emulator(0).raise_fault(rig.clock().now_ns(), code, tells);
      EXPECT_EQ(says_lost(rig, 50 * kMs), loses) << code << ' ' << tells;
    }
  }
}

TEST(LostCia402, RestartBetweenTheFaultAndTheEndOfTheBringUpIsTold) {
  LostCia402Rig rig({}, std::vector<Cia402Config>{{.max_torque_Nm = 0.5}},
                    std::vector<host::Cia402EmulatorConfig>{{}});
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.emulator(0).raise_fault(rig.clock().now_ns(), 0x2310);
  ASSERT_FALSE(says_lost(rig, 50 * kMs));
  rig.board().clear_faults();
  ASSERT_FALSE(says_lost(rig, 5 * kMs));
  rig.emulator(0).set_fault(host::EmulatorFault::power_cycled);
  EXPECT_TRUE(says_lost(rig, 70 * kMs));
}

TEST(LostCia402, TorqueOffsetIsZeroAfterTheBringUp) {
  LostCia402Rig rig({}, std::vector<Cia402Config>{{.max_torque_Nm = 0.5}},
                    std::vector<host::Cia402EmulatorConfig>{{.torque_offset = 100}});
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.command_all(0.0);
  rig.run(30 * kMs);
  EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
  EXPECT_TRUE(rig.sample(0).has_torque);
}

}  // namespace
}  // namespace tactus::drivers
