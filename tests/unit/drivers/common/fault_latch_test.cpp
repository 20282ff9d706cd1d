#include "drivers/common/fault_latch.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

constexpr Trouble kFirst{.what = "the first fault", .remedy = "reset"};
constexpr Trouble kSecond{.what = "the second fault", .remedy = "reset", .is_heat = true};

TEST(FaultLatch, KeepsTheWordsOfTheFirstFaultAndTheBitsOfAll) {
  FaultLatch faults;
  EXPECT_FALSE(faults);
  faults.latch(kDeviceLost, kFirst);
  faults.latch(kDeviceDriveFault, kSecond);
  EXPECT_TRUE(faults);
  EXPECT_EQ(faults.status(), kDeviceLost | kDeviceDriveFault | kDeviceTooHot);
  EXPECT_EQ(faults.trouble().what, kFirst.what);
  faults.clear();
  EXPECT_FALSE(faults);
  EXPECT_FALSE(faults.trouble());
}

TEST(FaultLatch, AnExplanationReplacesTheWords) {
  FaultLatch faults;
  faults.latch(kDeviceDriveFault, kFirst);
  faults.explain(kSecond);
  EXPECT_EQ(faults.trouble().what, kSecond.what);
  EXPECT_EQ(faults.status(), kDeviceDriveFault | kDeviceTooHot);
}

TEST(FaultLatch, AHeldFaultIsHeldUntilItIsShownOrCleared) {
  FaultLatch faults;
  faults.latch(kDeviceLost, kFirst);
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
