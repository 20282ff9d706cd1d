#include "firmware/bare_metal/board_loop.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "rendering/profiles/chosen_profile.h"
#include "tests/unit/firmware/bare_metal/fake_board.h"

namespace tactus::firmware {
namespace {

using hal::fake_board;
using hal::kHalted;
using hal::StopCode;
using ::testing::ExitedWithCode;

class BoardLoopTest : public ::testing::Test {
 protected:
  BoardLoopTest() { hal::power_up_fake_board(); }

  const std::string greeting_ =
      "off 'tactus on desk, profile " + std::string(rendering::kProfile.name) + "/";
};

TEST_F(BoardLoopTest, BeginsWithoutPower) {
  begin("desk");
  EXPECT_EQ(fake_board().events, greeting_);
}

TEST_F(BoardLoopTest, BeginsWhateverTheMemoryHasAfterPowerUp) {
  fake_board().latched = {.code = StopCode::bus, .complement = 0x1234, .address = 5};
  begin("desk");
  EXPECT_EQ(fake_board().events, greeting_);
}

TEST_F(BoardLoopTest, DoesNotBeginAfterAStop) {
  hal::latch(StopCode::hard_fault, 0x1234, fake_board().latched);
  EXPECT_EXIT(begin("desk"), ExitedWithCode(kHalted),
              "/stopped before: 6 hard_fault at 0000000000001234; the motors stay off "
              "until the power is cycled/' halt");
}

TEST_F(BoardLoopTest, StopsOnAnImageThatIsNone) {
  const auto loaded = std::make_unique<LoadedController>();
  EXPECT_EXIT(start_or_stop(*loaded), ExitedWithCode(kHalted),
              "off latch 10 watchdog 500000 us '~stop 10 device_image: ");
}

TEST_F(BoardLoopTest, TellsTheLoadWithTheStackInUse) {
  fake_board().stack = {hal::kStackPaint, hal::kStackPaint, 7, 7, 7};
  TickLoad load;
  load.add(1500);
  EXPECT_EQ(load_line(2000, load, 3).text(),
            "load 2000 worst_ns 1500 p99.9_ns 1500 missed 3 stack_bytes 12");
}

}  // namespace
}  // namespace tactus::firmware
