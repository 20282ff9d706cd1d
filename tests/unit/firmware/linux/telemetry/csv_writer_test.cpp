#include "firmware/linux/telemetry/csv_writer.h"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "host_tools/csv/csv_table.h"
#include "tests/support/folder_test.h"
#include "tests/unit/firmware/linux/telemetry/random_tick.h"

namespace tactus::firmware {
namespace {

class CsvWriterTest : public FolderTest {
 protected:
  void write(std::span<const RecordedTick> ticks) const {
    const auto writer = std::make_unique<CsvWriter>();
    ASSERT_EQ(writer->open(path_.c_str(), 2), 0);
    for (const RecordedTick& tick : ticks) {
      writer->add(tick);
    }
    ASSERT_EQ(writer->close(), 0);
  }
  [[nodiscard]] std::vector<std::vector<std::string>> cells() const {
    std::ifstream in(path_);
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(in, line);) {
      std::istringstream parts(line);
      std::vector<std::string>& row = rows.emplace_back();
      for (std::string cell; std::getline(parts, cell, ',');) {
        row.push_back(cell);
      }
    }
    return rows;
  }

  std::string path_ = file("run.csv");
};

TEST_F(CsvWriterTest, NamesAColumnForEveryNumber) {
  write({});
  const auto rows = cells();
  ASSERT_EQ(rows.size(), 1U);
  const std::vector<std::string>& names = rows[0];
  for (const char* name :
       {"tick", "time_s", "mode", "sample_age_us", "tool_x_m", "force_z_N", "tool_v_y_m_per_s",
        "energy_contact_J", "energy_delay_J", "joint1", "joint2", "shaft2_rad", "torque1_Nm",
        "scheduled_ns", "woke_ns", "done_ns", "sample_ns", "state_hash", "dropped"}) {
    EXPECT_EQ(std::ranges::count(names, name), 1) << name;
  }
  EXPECT_EQ(std::ranges::count(names, "joint3"), 0);
}

TEST_F(CsvWriterTest, WritesNumbersThatReadBackAsTheyWere) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  std::vector<RecordedTick> ticks;
  for (int i = 0; i < 500; ++i) {
    RecordedTick& tick = ticks.emplace_back(random_tick(random));
    tick.record.faults = static_cast<std::uint32_t>(i);
  }
  write(ticks);
  const auto table = host::CsvTable::read(
      path_, std::array<std::string_view, 4>{"depth_m", "tool_y_m", "joint2", "faults"});
  ASSERT_EQ(table.rows(), ticks.size());
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_EQ(table.column("depth_m")[i], ticks[i].record.depth_m);
    EXPECT_EQ(table.column("tool_y_m")[i], ticks[i].record.tool_p_W[1]);
    EXPECT_EQ(table.column("joint2")[i], ticks[i].record.joint_position[1]);
    EXPECT_EQ(table.column("faults")[i], static_cast<double>(i));
  }
}

TEST_F(CsvWriterTest, WritesModesAsWordsAndTheHashInHexadecimal) {
  RecordedTick tick;
  tick.record.mode = Mode::active;
  tick.record.request = Request::enable;
  tick.record.state_hash = 0xabcU;
  write(std::array{tick});
  const auto rows = cells();
  ASSERT_EQ(rows.size(), 2U);
  ASSERT_EQ(rows[0].size(), rows[1].size());
  const auto cell = [&](const char* name) {
    return rows[1][static_cast<std::size_t>(std::ranges::find(rows[0], name) - rows[0].begin())];
  };
  EXPECT_EQ(cell("mode"), "active");
  EXPECT_EQ(cell("request"), "enable");
  EXPECT_EQ(cell("state_hash"), "0000000000000abc");
}

TEST_F(CsvWriterTest, SaysThatItCannotWrite) {
  const auto writer = std::make_unique<CsvWriter>();
  EXPECT_EQ(writer->open("/dev/full", 3), ENOSPC);
  EXPECT_EQ(writer->open(file("no/such/folder.csv").c_str(), 3), ENOENT);
}

}  // namespace
}  // namespace tactus::firmware
