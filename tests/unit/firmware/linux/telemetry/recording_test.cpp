#include "host_tools/recording/recording.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>

#include "firmware/linux/telemetry/mcap_writer.h"
#include "host_tools/input_error.h"
#include "tests/unit/firmware/linux/telemetry/random_tick.h"

namespace tactus::host {
namespace {

using firmware::McapWriter;
using firmware::RecordedTick;
using firmware::TelemetryEvent;

constexpr std::array<firmware::MetadataEntry, 2> kInfo{
    {{"rate_hz", "1000"}, {"device.file", "falcon.tactus"}}};

class RecordingTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) / (std::string(info->name()) + ".mcap");
  }
  void TearDown() override { std::filesystem::remove(path_); }

  static RecordedTick tick(std::uint64_t number) {
    std::mt19937_64 random(number);
    RecordedTick tick = firmware::random_tick(random);
    tick.record.tick = number;
    tick.loop.scheduled_ns = static_cast<std::int64_t>(number) * 1'000'000;
    return tick;
  }

  void write(std::uint64_t ticks, bool close = true) const {
    const auto writer = std::make_unique<McapWriter>();
    ASSERT_EQ(writer->open(path_.c_str(), 1'700'000'000'000'000'000, kInfo), 0);
    writer->attach({.name = "device.tactus", .bytes = std::as_bytes(std::span(kDevice))});
    for (std::uint64_t i = 0; i < ticks; ++i) {
      if (i % 100 == 50) {
        TelemetryEvent event{.tick = i, .value = static_cast<double>(i)};
        set_name(event, "note");
        writer->add(event);
      }
      writer->add(tick(i));
    }
    if (close) {
      ASSERT_EQ(writer->close(), 0);
    }
  }

  // Reads to the end and holds every tick against what was written; how many.
  static std::uint64_t count_ticks(Recording& recording) {
    std::uint64_t count = 0;
    while (const auto read = recording.next()) {
      firmware::expect_equal(tick(count), *read);
      ++count;
    }
    return count;
  }

  [[nodiscard]] std::string message_of_failure() const {
    try {
      Recording recording(path_.string());
      while (recording.next()) {
      }
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  void damage(std::uintmax_t offset) const {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(offset));
    const int byte = file.get();
    file.seekp(static_cast<std::streamoff>(offset));
    file.put(static_cast<char>(byte ^ 1));
  }

  static constexpr std::array<char, 5> kDevice{'i', 'm', 'a', 'g', 'e'};
  std::filesystem::path path_;
};

TEST_F(RecordingTest, GivesBackEveryTickInOrder) {
  write(3000);
  Recording recording(path_.string());
  EXPECT_EQ(count_ticks(recording), 3000U);
  EXPECT_FALSE(recording.cut());
  recording.rewind();
  EXPECT_EQ(count_ticks(recording), 3000U);
}

TEST_F(RecordingTest, GivesBackEventsInformationAndAttachments) {
  write(1000);
  const Recording recording(path_.string());
  ASSERT_EQ(recording.events().size(), 10U);
  EXPECT_EQ(recording.events()[3].tick, 350U);
  EXPECT_EQ(recording.info("rate_hz"), "1000");
  EXPECT_EQ(recording.info("nothing"), "");
  const auto device = recording.attachment("device.tactus");
  EXPECT_TRUE(std::ranges::equal(device, std::as_bytes(std::span(kDevice))));
  EXPECT_TRUE(recording.attachment("scene.tactus").empty());
}

TEST_F(RecordingTest, OfNoTicksIsWhole) {
  write(0);
  Recording recording(path_.string());
  EXPECT_FALSE(recording.next().has_value());
  EXPECT_FALSE(recording.cut());
}

TEST_F(RecordingTest, CutAnywhereGivesWhatIsWhole) {
  write(2000);
  const auto size = std::filesystem::file_size(path_);
  std::uint64_t least = 3000;
  for (const double share : {0.99, 0.9, 0.7, 0.5, 0.3}) {
    std::filesystem::resize_file(path_,
                                 static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    Recording recording(path_.string());
    const std::uint64_t ticks = count_ticks(recording);
    EXPECT_TRUE(recording.cut() || share > 0.98);
    EXPECT_LE(ticks, least);
    EXPECT_GT(static_cast<double>(ticks), 2000 * share - 500);  // a chunk is about 250 ticks
    least = ticks;
  }
}

TEST_F(RecordingTest, WithoutItsEndIsReadToTheLastChunk) {
  write(2000, false);
  Recording recording(path_.string());
  EXPECT_TRUE(recording.cut());
  EXPECT_GT(count_ticks(recording), 1500U);
}

TEST_F(RecordingTest, WithADamagedChunkSaysWhere) {
  write(2000);
  damage(std::filesystem::file_size(path_) / 2);
  EXPECT_NE(message_of_failure().find("a chunk is damaged"), std::string::npos)
      << message_of_failure();
  EXPECT_NE(message_of_failure().find(path_.string()), std::string::npos);
}

TEST_F(RecordingTest, IsNotAnyFile) {
  std::ofstream(path_) << "tick,time_s\n";
  EXPECT_NE(message_of_failure().find("not an MCAP file"), std::string::npos);
  std::filesystem::remove(path_);
  EXPECT_NE(message_of_failure().find("cannot read"), std::string::npos);
}

// Explanations may begin at any tick. They do not disturb the ticks, and a recording without them
// has no channel for them.
TEST_F(RecordingTest, GivesBackExplanationsBesideTheTicks) {
  const auto writer = std::make_unique<McapWriter>();
  ASSERT_EQ(writer->open(path_.c_str(), 0, kInfo), 0);
  for (std::uint64_t i = 0; i < 300; ++i) {
    writer->add(tick(i));
    if (i >= 100 && i % 2 == 0) {
      writer->add(firmware::Explanation{.tick = i, .moves = 4});
    }
  }
  ASSERT_EQ(writer->close(), 0);
  Recording recording(path_.string());
  for (int pass = 0; pass < 2; ++pass) {
    EXPECT_EQ(count_ticks(recording), 300U);
    std::uint64_t expected = 100;
    while (const auto explanation = recording.next_explanation()) {
      EXPECT_EQ(*explanation, (firmware::Explanation{.tick = expected, .moves = 4}));
      expected += 2;
    }
    EXPECT_EQ(expected, 300U);
    recording.rewind();
  }
}

TEST_F(RecordingTest, HasNoChannelOfExplanationsWithoutThem) {
  write(100);
  std::ostringstream bytes;
  bytes << std::ifstream(path_, std::ios::binary).rdbuf();
  EXPECT_EQ(bytes.str().find(firmware::kExplanationTopic), std::string::npos);
  Recording recording(path_.string());
  EXPECT_FALSE(recording.next_explanation().has_value());
}

TEST_F(RecordingTest, EndsWhereTheDiskIsFull) {
  const auto writer = std::make_unique<McapWriter>();
  ASSERT_EQ(writer->open("/dev/full", 0, kInfo), ENOSPC);
  writer->add(tick(0));
  EXPECT_EQ(writer->close(), ENOSPC);
}

}  // namespace
}  // namespace tactus::host
