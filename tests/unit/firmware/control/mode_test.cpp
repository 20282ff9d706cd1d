#include "firmware/control/mode.h"

#include <gtest/gtest.h>

#include "tests/unit/firmware/readme_table.h"

namespace tactus::firmware {
namespace {

TEST(ModeTable, EveryCellIsAsSpecified) {
  struct Cell {
    std::string_view from;
    std::string_view event;
    std::string_view to;
  };
  const std::vector<Cell> cells = {
      {"init", "device_ready", "init"},
      {"init", "device_not_ready", "init"},
      {"init", "home", "homing"},
      {"init", "enable", "init"},
      {"init", "disable", "init"},
      {"init", "reset", "init"},
      {"init", "fault", "fault"},
      {"homing", "device_ready", "ready"},
      {"homing", "device_not_ready", "homing"},
      {"homing", "home", "homing"},
      {"homing", "enable", "homing"},
      {"homing", "disable", "init"},
      {"homing", "reset", "homing"},
      {"homing", "fault", "fault"},
      {"ready", "device_ready", "ready"},
      {"ready", "device_not_ready", "init"},
      {"ready", "home", "homing"},
      {"ready", "enable", "active"},
      {"ready", "disable", "ready"},
      {"ready", "reset", "ready"},
      {"ready", "fault", "fault"},
      {"active", "device_ready", "active"},
      {"active", "device_not_ready", "fault"},
      {"active", "home", "active"},
      {"active", "enable", "active"},
      {"active", "disable", "ready"},
      {"active", "reset", "active"},
      {"active", "fault", "fault"},
      {"fault", "device_ready", "fault"},
      {"fault", "device_not_ready", "fault"},
      {"fault", "home", "fault"},
      {"fault", "enable", "fault"},
      {"fault", "disable", "fault"},
      {"fault", "reset", "init"},
      {"fault", "fault", "fault"},
  };
  ASSERT_EQ(cells.size(), kModeCount * kEventCount);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t mode = i / kEventCount;
    const std::size_t event = i % kEventCount;
    EXPECT_EQ(kModeNames[mode], cells[i].from);
    EXPECT_EQ(kEventNames[event], cells[i].event);
    EXPECT_EQ(mode_name(next_mode(static_cast<Mode>(mode), static_cast<Event>(event))), cells[i].to)
        << cells[i].from << " on " << cells[i].event;
  }
}

TEST(ModeTable, ActiveIsEnteredOnlyFromReadyByEnable) {
  for (std::size_t mode = 0; mode < kModeCount; ++mode) {
    for (std::size_t event = 0; event < kEventCount; ++event) {
      const auto from = static_cast<Mode>(mode);
      if (from == Mode::active || next_mode(from, static_cast<Event>(event)) != Mode::active) {
        continue;
      }
      EXPECT_EQ(from, Mode::ready);
      EXPECT_EQ(static_cast<Event>(event), Event::enable);
    }
  }
}

TEST(ModeTable, TheReadmeShowsTheSameTable) {
  const std::vector<TableRow> rows = readme_table("mode");
  ASSERT_EQ(rows.size(), kModeCount + 1);
  for (std::size_t event = 0; event < kEventCount; ++event) {
    EXPECT_EQ(rows[0].at(event + 1), kEventNames[event]);
  }
  for (std::size_t mode = 0; mode < kModeCount; ++mode) {
    EXPECT_EQ(rows[mode + 1].at(0), kModeNames[mode]);
    for (std::size_t event = 0; event < kEventCount; ++event) {
      EXPECT_EQ(rows[mode + 1].at(event + 1),
                mode_name(next_mode(static_cast<Mode>(mode), static_cast<Event>(event))))
          << kModeNames[mode] << " on " << kEventNames[event];
    }
  }
}

}  // namespace
}  // namespace tactus::firmware
