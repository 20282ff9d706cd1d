#include "firmware/safety/faults.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/unit/firmware/readme_table.h"

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
  EXPECT_EQ(fault_code(kLimitSoftStart), 16);
  EXPECT_EQ(fault_code(kLimitForce), 17);
  EXPECT_EQ(fault_code(kLimitSlew), 18);
  EXPECT_EQ(fault_code(kLimitEffort), 19);
  EXPECT_EQ(fault_code(kLimitStaleSample), 20);
  EXPECT_EQ(fault_code(kLimitTouch), 21);
  EXPECT_EQ(fault_code(kLimitCompensation), 22);
  EXPECT_EQ(fault_code(kLimitGravity), 23);
}

TEST(Faults, EveryBitHasItsOwnNameAndAMeaning) {
  std::set<std::string_view> names;
  for (const FaultText& text : kFaultTexts) {
    EXPECT_TRUE(names.insert(text.name).second) << text.name;
    EXPECT_EQ(fault_name(text.bit), text.name);
    EXPECT_FALSE(text.meaning.empty());
  }
  EXPECT_EQ(fault_name(static_cast<FaultBits>(1U << 31)), "unknown");
}

TEST(Faults, TheReadmeListsEveryCodeNameAndMeaningInOrder) {
  const std::vector<TableRow> rows = readme_table("code");
  ASSERT_EQ(rows.size(), kFaultTexts.size() + 1);
  for (std::size_t i = 0; i < kFaultTexts.size(); ++i) {
    const TableRow& row = rows[i + 1];
    ASSERT_GE(row.size(), 5U);
    EXPECT_EQ(row[0], std::to_string(fault_code(kFaultTexts[i].bit)));
    EXPECT_EQ(row[1], kFaultTexts[i].name);
    EXPECT_EQ(row[2], kFaultTexts[i].meaning);
    EXPECT_FALSE(row[3].empty()) << row[1] << " has no reaction";
    EXPECT_FALSE(row[4].empty()) << row[1] << " has no recovery";
  }
}

}  // namespace
}  // namespace tactus::firmware
