#include "firmware/safety/faults.h"

#include <gtest/gtest.h>

#include <set>

namespace tactus::firmware {
namespace {

TEST(Faults, CodesAreStable) {
  EXPECT_EQ(fault_code(kFaultNotConfigured), 0);
  EXPECT_EQ(fault_code(kFaultJointNotFinite), 1);
  EXPECT_EQ(fault_code(kFaultJointLimit), 2);
  EXPECT_EQ(fault_code(kFaultStaleSamples), 3);
  EXPECT_EQ(fault_code(kFaultReferenceLost), 4);
  EXPECT_EQ(fault_code(kFaultEncoder), 5);
  EXPECT_EQ(fault_code(kFaultDrive), 6);
  EXPECT_EQ(fault_code(kFaultDeviceLost), 7);
  EXPECT_EQ(fault_code(kFaultEmergencyStop), 8);
  EXPECT_EQ(fault_code(kFaultOperatorStop), 9);
  EXPECT_EQ(fault_code(kFaultKinematicsNotConverged), 10);
  EXPECT_EQ(fault_code(kFaultKinematicsSingular), 11);
  EXPECT_EQ(fault_code(kFaultToolNotFinite), 12);
  EXPECT_EQ(fault_code(kFaultForceNotFinite), 13);
  EXPECT_EQ(fault_code(kFaultCommandNotFinite), 14);
  EXPECT_EQ(fault_code(kFaultLateTicks), 15);
  EXPECT_EQ(fault_code(kLimitSoftStart), 16);
  EXPECT_EQ(fault_code(kLimitForce), 17);
  EXPECT_EQ(fault_code(kLimitSlew), 18);
  EXPECT_EQ(fault_code(kLimitEffort), 19);
  EXPECT_EQ(fault_code(kLimitStaleSample), 20);
  EXPECT_EQ(fault_code(kLimitTouch), 21);
  EXPECT_EQ(fault_code(kLimitCompensation), 22);
  EXPECT_EQ(fault_code(kLimitGravity), 23);
  EXPECT_EQ(fault_code(kFaultTickOverrun), 32);
  EXPECT_EQ(fault_code(kFaultWatchdog), 33);
  EXPECT_EQ(fault_code(kFaultWorkspace), 34);
  EXPECT_EQ(fault_code(kFaultOverspeed), 35);
  EXPECT_EQ(fault_code(kFaultEncoderFrozen), 36);
  EXPECT_EQ(fault_code(kFaultEncoderJump), 37);
  EXPECT_EQ(fault_code(kFaultTorqueWithoutMotion), 38);
  EXPECT_EQ(fault_code(kFaultMotionWithoutTorque), 39);
  EXPECT_EQ(fault_code(kFaultOverTemperature), 40);
  EXPECT_EQ(fault_code(kFaultNotPassive), 41);
  EXPECT_EQ(fault_code(kFaultHelperCrashed), 42);
  EXPECT_EQ(fault_code(kFaultLineLost), 46);
  EXPECT_EQ(fault_code(kLimitLateTick), 48);
  EXPECT_EQ(fault_code(kLimitWorkspace), 49);
  EXPECT_EQ(fault_code(kLimitSpeed), 50);
  EXPECT_EQ(fault_code(kLimitPassivity), 51);
  EXPECT_EQ(fault_code(kLimitGuardsOff), 52);
}

TEST(Faults, EveryBitHasItsOwnNameAndAMeaning) {
  std::set<std::string_view> names;
  for (const FaultText& text : kFaultTexts) {
    EXPECT_TRUE(names.insert(text.name).second) << text.name;
    EXPECT_EQ(fault_name(text.bit), text.name);
    EXPECT_FALSE(text.meaning.empty());
    EXPECT_FALSE(text.reaction.empty());
    EXPECT_FALSE(text.recovery.empty());
    EXPECT_EQ((text.bit & kFaultMask) != 0, text.reaction.starts_with("stop")) << text.name;
  }
  EXPECT_EQ(fault_name(static_cast<FaultBits>(1ULL << 63)), "unknown");
}

}  // namespace
}  // namespace tactus::firmware
