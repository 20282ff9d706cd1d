#include "host_tools/emulators/fault_plan.h"

#include <gtest/gtest.h>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

TEST(FaultPlan, NamesOneAxisOrAll) {
  const PlannedFault one = parse_planned_fault("2:corrupted@0.25");
  EXPECT_EQ(one.joint, 2U);
  EXPECT_EQ(one.fault, EmulatorFault::corrupted);
  EXPECT_EQ(one.at_s, 0.25);
  const PlannedFault all = parse_planned_fault("all:none@12");
  EXPECT_FALSE(all.joint);
  EXPECT_EQ(all.fault, EmulatorFault::none);
  EXPECT_EQ(all.at_s, 12.0);
}

TEST(FaultPlan, RefusesWhatIsNoFault) {
  for (const char* const text :
       {"", ":", "@", "0:silent", "silent@3", "x:silent@3", "-1:silent@3", "0:mute@3", "0:@3",
        "0:silent@", "0:silent@x", "0:silent@-1", "0:silent@nan", "0:silent@inf", "0:silent@3s",
        "@3:silent", " 0:silent@3"}) {
    EXPECT_THROW((void)parse_planned_fault(text), InputError) << text;
  }
}

}  // namespace
}  // namespace tactus::host
