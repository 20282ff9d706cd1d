#include "firmware/linux/realtime/watchdog_output.h"

#include <gtest/gtest.h>

#include "hal/simulated/gpio_chip.h"
#include "hal/simulated/gpio_lines.h"

namespace tactus::firmware {
namespace {

class WatchdogOutputTest : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kLine = 5;

  void SetUp() override {
    ASSERT_TRUE(watchdog_.open(lines_, {.offset = kLine, .direction = hal::GpioDirection::output}));
  }

  hal::SimulatedClock clock_;
  hal::SimulatedGpioChip chip_{clock_};
  hal::SimulatedGpioLines lines_{chip_};
  WatchdogOutput watchdog_;
};

TEST_F(WatchdogOutputTest, TurnsTheLineOverWithEveryHealthyTick) {
  EXPECT_FALSE(chip_.level(kLine));
  for (const bool high : {true, false, true, false}) {
    EXPECT_TRUE(watchdog_.tick(true));
    EXPECT_EQ(chip_.level(kLine), high);
  }
}

TEST_F(WatchdogOutputTest, LeavesTheLineAloneInATickThatIsNot) {
  watchdog_.tick(true);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(watchdog_.tick(false));
    EXPECT_TRUE(chip_.level(kLine));
  }
  watchdog_.tick(true);
  EXPECT_FALSE(chip_.level(kLine));
}

TEST_F(WatchdogOutputTest, CountsTheTicksInWhichTheLineCouldNotBeSet) {
  chip_.remove();
  EXPECT_FALSE(watchdog_.tick(true));
  EXPECT_FALSE(watchdog_.tick(true));
  EXPECT_TRUE(watchdog_.tick(false));
  EXPECT_EQ(watchdog_.failed(), 2U);
}

TEST(WatchdogOutput, DoesNothingWithoutALine) {
  WatchdogOutput watchdog;
  EXPECT_TRUE(watchdog.tick(true));
  EXPECT_EQ(watchdog.failed(), 0U);
}

}  // namespace
}  // namespace tactus::firmware
