#include "firmware/linux/telemetry/telemetry_writer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "host_tools/recording/live_reader.h"
#include "host_tools/recording/recording.h"
#include "tests/support/folder_test.h"

namespace tactus::firmware {
namespace {

using namespace std::chrono_literals;

constexpr std::array<MetadataEntry, 1> kRun{{{"rate_hz", "1000"}}};

class TelemetryWriterTest : public FolderTest {
 protected:
  void SetUp() override { writer_->describe({.info = kRun, .joints = 3}); }

  void publish(std::uint64_t tick) {
    RecordedTick recorded;
    recorded.record.tick = tick;
    recorded.joint_count = 3;
    writer_->publish(recorded);
  }
  // No faster than the writer can be, however slow the machine.
  void publish_in_time(std::uint64_t ticks) {
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
      publish(tick);
      if (tick % 1000 == 999) {
        std::this_thread::sleep_for(20ms);
      }
    }
  }

  std::unique_ptr<TelemetryWriter> writer_ = std::make_unique<TelemetryWriter>();
};

// Ticks in order; how many, and how many the last of them says were dropped before it.
struct Contents {
  std::uint64_t ticks = 0;
  std::uint64_t missing = 0;
  std::uint64_t dropped = 0;
};

Contents contents_of(const std::string& file) {
  host::Recording recording(file);
  Contents contents;
  std::uint64_t expected = 0;
  while (const auto tick = recording.next()) {
    EXPECT_GE(tick->record.tick, expected);
    contents.missing += tick->record.tick - expected;
    EXPECT_EQ(tick->dropped, contents.missing);
    contents.dropped = tick->dropped;
    expected = tick->record.tick + 1;
    ++contents.ticks;
  }
  return contents;
}

TEST_F(TelemetryWriterTest, RecordsWhatIsPublished) {
  const std::string path = file("run.mcap");
  ASSERT_EQ(writer_->record(path.c_str()), 0);
  ASSERT_EQ(writer_->start(), 0);
  publish_in_time(5000);
  EXPECT_EQ(writer_->stop(), 0);
  const Contents contents = contents_of(path);
  EXPECT_EQ(contents.ticks + writer_->dropped_ticks(), 5000U);
}

TEST_F(TelemetryWriterTest, CountsEveryTickThatItWasTooSlowFor) {
  const std::string path = file("run.mcap");
  ASSERT_EQ(writer_->record(path.c_str()), 0);
  ASSERT_EQ(writer_->start(), 0);
  constexpr std::uint64_t kTicks = 50'000;  // at once: twelve times what the ring holds
  for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
    publish(tick);
  }
  std::this_thread::sleep_for(50ms);
  publish(kTicks);
  EXPECT_EQ(writer_->stop(), 0);
  const Contents contents = contents_of(path);
  EXPECT_EQ(contents.ticks + writer_->dropped_ticks(), kTicks + 1);
  EXPECT_LE(contents.dropped, writer_->dropped_ticks());
}

TEST_F(TelemetryWriterTest, BeginsAndEndsRecordingsWhileItRuns) {
  ASSERT_EQ(writer_->start(), 0);
  std::jthread loop([&](const std::stop_token& stop) {
    for (std::uint64_t tick = 0; !stop.stop_requested(); ++tick) {
      publish(tick);
      std::this_thread::sleep_for(100us);
    }
  });
  for (const char* name : {"first.mcap", "second.mcap"}) {
    ASSERT_EQ(writer_->record(file(name).c_str()), 0);
    std::this_thread::sleep_for(50ms);
    ASSERT_EQ(writer_->end_recording(), 0);
    host::Recording recording(file(name));
    EXPECT_TRUE(recording.next().has_value());
    EXPECT_FALSE(recording.cut());
  }
  EXPECT_NE(writer_->record(file("no/such/folder.mcap").c_str()), 0);
  loop.request_stop();
  loop.join();
  EXPECT_EQ(writer_->stop(), 0);
}

TEST_F(TelemetryWriterTest, PutsEventsAndAttachmentsIntoTheRecording) {
  const std::string path = file("run.mcap");
  const std::array<char, 3> image{'a', 'b', 'c'};
  ASSERT_TRUE(writer_->attach({.name = "device.tactus", .bytes = std::as_bytes(std::span(image))}));
  ASSERT_EQ(writer_->record(path.c_str()), 0);
  ASSERT_EQ(writer_->start(), 0);
  TelemetryEvent event{.tick = 3, .kind = EventKind::request};
  set_name(event, "enable");
  writer_->publish(event);
  publish(3);
  ASSERT_TRUE(writer_->attach({.name = "scene.2", .bytes = std::as_bytes(std::span(image))}));
  EXPECT_EQ(writer_->stop(), 0);
  const host::Recording recording(path);
  ASSERT_EQ(recording.events().size(), 1U);
  EXPECT_EQ(name_of(recording.events()[0]), "enable");
  EXPECT_EQ(recording.attachment("device.tactus").size(), image.size());
  EXPECT_EQ(recording.attachment("scene.2").size(), image.size());
}

TEST_F(TelemetryWriterTest, ServesAReaderWhileItRecords) {
  const std::string socket = file("telemetry.sock");
  ASSERT_EQ(writer_->open_live_socket(socket.c_str()), 0);
  ASSERT_EQ(writer_->start(), 0);
  host::LiveReader reader(socket);
  const auto first = reader.next(10s);
  ASSERT_TRUE(first.has_value());
  EXPECT_TRUE(std::holds_alternative<host::RunInfo>(*first));
  publish(11);
  const auto second = reader.next(10s);
  ASSERT_TRUE(second.has_value());
  const auto* tick = std::get_if<RecordedTick>(&*second);
  ASSERT_NE(tick, nullptr);
  EXPECT_EQ(tick->record.tick, 11U);
  writer_->stop();
  EXPECT_FALSE(reader.next(10s).has_value());
  EXPECT_TRUE(reader.ended());
}

TEST_F(TelemetryWriterTest, WantsExplanationsWhileAReaderDoes) {
  const auto until = [&](bool wanted) {
    for (int i = 0; i < 2000 && writer_->wants_explanations() != wanted; ++i) {
      publish(static_cast<std::uint64_t>(i));  // a reader that has gone is found by writing to it
      std::this_thread::sleep_for(5ms);
    }
    return writer_->wants_explanations() == wanted;
  };
  const std::string path = file("run.mcap");
  ASSERT_EQ(writer_->record(path.c_str()), 0);
  const std::string socket = file("telemetry.sock");
  ASSERT_EQ(writer_->open_live_socket(socket.c_str()), 0);
  ASSERT_EQ(writer_->start(), 0);
  EXPECT_FALSE(writer_->wants_explanations());
  {
    host::LiveReader reader(socket);
    reader.ask_for_explanations(true);
    EXPECT_TRUE(until(true));
    writer_->publish(Explanation{.tick = 11, .moves = 3});
    std::optional<host::LiveMessage> message = reader.next(10s);
    while (message && !std::holds_alternative<Explanation>(*message)) {
      message = reader.next(10s);
    }
    ASSERT_TRUE(message.has_value());
    EXPECT_EQ(std::get<Explanation>(*message).tick, 11U);
  }
  EXPECT_TRUE(until(false));
  EXPECT_EQ(writer_->stop(), 0);
  host::Recording recording(path);
  const auto recorded = recording.next_explanation();
  ASSERT_TRUE(recorded.has_value());
  EXPECT_EQ(recorded->moves, 3U);
  EXPECT_FALSE(recording.next_explanation().has_value());
}

TEST_F(TelemetryWriterTest, TellsThatTheDiskWasFull) {
  EXPECT_EQ(writer_->record("/dev/full"), ENOSPC);
  EXPECT_EQ(writer_->start(), 0);
  publish(0);
  EXPECT_EQ(writer_->stop(), 0);
}

}  // namespace
}  // namespace tactus::firmware
