#include "firmware/linux/tactusd/mode_log.h"

#include <gtest/gtest.h>

namespace tactus::firmware {
namespace {

TEST(ModeLog, GivesEachChangeOnceAndInOrder) {
  ModeLog log;
  for (const Mode mode : {Mode::init, Mode::init, Mode::homing, Mode::homing, Mode::ready}) {
    log.note(mode);
  }
  EXPECT_EQ(log.next(), Mode::homing);
  EXPECT_EQ(log.next(), Mode::ready);
  EXPECT_EQ(log.next(), std::nullopt);
  log.note(Mode::fault);
  EXPECT_EQ(log.next(), Mode::fault);
}

TEST(ModeLog, LosesTheOldestOfTooManyChanges) {
  ModeLog log;
  for (std::uint32_t i = 0; i < 2 * ModeLog::kModesKept; ++i) {
    log.note(i % 2 == 0 ? Mode::ready : Mode::active);
  }
  log.note(Mode::fault);
  std::uint32_t read = 0;
  Mode last = Mode::init;
  while (const auto mode = log.next()) {
    last = *mode;
    ++read;
  }
  EXPECT_EQ(read, ModeLog::kModesKept);
  EXPECT_EQ(last, Mode::fault);
}

}  // namespace
}  // namespace tactus::firmware
