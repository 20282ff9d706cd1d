#include "drivers/common/fault_latch.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

constexpr Trouble kFirstFault{.what = "the first fault", .remedy = "reset"};
constexpr Trouble kSecondFault{.what = "the second fault", .remedy = "reset", .is_heat = true};

TEST(FaultLatch, KeepsTheWordsOfTheFirstFaultAndTheBitsOfAll) {
  FaultLatch faults;
  EXPECT_FALSE(faults);
  faults.latch(kDeviceLost, kFirstFault);
  faults.latch(kDeviceDriveFault, kSecondFault);
  EXPECT_TRUE(faults);
  EXPECT_EQ(faults.status(), kDeviceLost | kDeviceDriveFault | kDeviceTooHot);
  EXPECT_EQ(faults.trouble().what, kFirstFault.what);
  faults.clear();
  EXPECT_FALSE(faults);
  EXPECT_FALSE(faults.trouble());
}

TEST(FaultLatch, AnExplanationReplacesTheWords) {
  FaultLatch faults;
  faults.latch(kDeviceDriveFault, kFirstFault);
  faults.explain(kSecondFault);
  EXPECT_EQ(faults.trouble().what, kSecondFault.what);
  EXPECT_EQ(faults.status(), kDeviceDriveFault | kDeviceTooHot);
}

TEST(FaultLatch, AHeldFaultIsHeldUntilItIsShownOrCleared) {
  FaultLatch faults;
  faults.latch(kDeviceLost, kFirstFault);
  EXPECT_FALSE(faults.is_held());
  faults.hold();
  EXPECT_TRUE(faults.is_held());
  faults.show();
  EXPECT_FALSE(faults.is_held());
  faults.hold();
  faults.clear();
  EXPECT_FALSE(faults.is_held());
}

}  // namespace
}  // namespace tactus::drivers
