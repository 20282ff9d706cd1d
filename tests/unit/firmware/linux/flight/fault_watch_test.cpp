#include "firmware/linux/flight/fault_watch.h"

#include <gtest/gtest.h>

namespace tactus::firmware {
namespace {

TEST(FaultWatch, GivesAFaultOnceItsDelayHasPassed) {
  FaultWatch watch;
  EXPECT_FALSE(watch.note(Mode::active, 3));
  EXPECT_FALSE(watch.is_waiting());
  for (int tick = 0; tick < 3; ++tick) {
    EXPECT_FALSE(watch.note(Mode::fault, 3)) << tick;
    EXPECT_TRUE(watch.is_waiting());
  }
  EXPECT_TRUE(watch.note(Mode::fault, 3));
  EXPECT_FALSE(watch.is_waiting());
  EXPECT_FALSE(watch.note(Mode::fault, 3)) << "a fault counts when it is entered";
}

TEST(FaultWatch, AResetDoesNotTakeTheFaultAway) {
  FaultWatch watch;
  EXPECT_FALSE(watch.note(Mode::fault, 1));
  EXPECT_TRUE(watch.note(Mode::init, 1));
}

TEST(FaultWatch, ASecondFaultBeginsTheDelayAnew) {
  FaultWatch watch;
  EXPECT_FALSE(watch.note(Mode::fault, 2));
  EXPECT_FALSE(watch.note(Mode::init, 2));
  EXPECT_FALSE(watch.note(Mode::fault, 2));
  EXPECT_FALSE(watch.note(Mode::fault, 2));
  EXPECT_TRUE(watch.note(Mode::fault, 2));
}

}  // namespace
}  // namespace tactus::firmware
