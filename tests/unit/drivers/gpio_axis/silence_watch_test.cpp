#include "drivers/gpio_axis/silence_watch.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

TEST(SilenceWatch, CountsTheTimeForWhichTheMotorPushesAndTheCountStands) {
  SilenceWatch watch;
  watch.restart(100);
  EXPECT_EQ(watch.take(true, 0, 150), 50);
  EXPECT_EQ(watch.take(true, 0, 160), 60);
}

TEST(SilenceWatch, ANewCountOrAMotorWithoutTorqueStartsAgain) {
  SilenceWatch watch;
  watch.restart(100);
  EXPECT_EQ(watch.take(true, 1, 150), 0);
  EXPECT_EQ(watch.take(true, 1, 170), 20);
  EXPECT_EQ(watch.take(false, 1, 180), 0);
  EXPECT_EQ(watch.take(true, 1, 190), 10);
}

}  // namespace
}  // namespace tactus::drivers
