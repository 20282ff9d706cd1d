#include "firmware/bare_metal/stop.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/firmware/bare_metal/fake_board.h"

namespace tactus::firmware {
namespace {

using hal::fake_board;
using hal::kHalted;
using hal::StopCode;
using ::testing::ExitedWithCode;

class BareMetalStop : public ::testing::Test {
 protected:
  BareMetalStop() { hal::power_up_fake_board(); }
};

TEST_F(BareMetalStop, TakesThePowerThenLatchesThenTells) {
  EXPECT_EXIT(stop(StopCode::stack_overflow), ExitedWithCode(kHalted),
              "^off latch 2 watchdog 500000 us '~stop 2 stack_overflow/' halt");
}

TEST_F(BareMetalStop, TellsTheInterruptedInstructionAndTheWords) {
  EXPECT_EXIT(stop(StopCode::watchdog, 0x9e8), ExitedWithCode(kHalted),
              "'~stop 1 watchdog at 00000000000009e8/' halt");
  EXPECT_EXIT(stop(StopCode::scene_image, 0, "bits have changed"), ExitedWithCode(kHalted),
              "'~stop 9 scene_image: bits have changed/' halt");
}

// The watchdog interrupts the telling of a stop.
TEST_F(BareMetalStop, WithinAStopTakesThePowerAndTellsNothing) {
  const auto stop_within_a_stop = [] {
    hal::latch(StopCode::bus, 0, fake_board().latched);
    stop(StopCode::watchdog);
  };
  EXPECT_EXIT(stop_within_a_stop(), ExitedWithCode(kHalted), "^latch 4 off halt");
}

TEST_F(BareMetalStop, TellsEveryCharacterToASlowUart) {
  fake_board().offers_per_char = 10'000;
  EXPECT_EXIT(stop(StopCode::bus), ExitedWithCode(kHalted), "'~stop 4 bus/' halt");
}

TEST_F(BareMetalStop, GivesUpAUartThatTakesNothing) {
  fake_board().offers_per_char = 0;
  EXPECT_EXIT(stop(StopCode::bus), ExitedWithCode(kHalted), "^off latch 4 watchdog 500000 us halt");
}

}  // namespace
}  // namespace tactus::firmware
