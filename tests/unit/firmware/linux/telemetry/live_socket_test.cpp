#include "firmware/linux/telemetry/live_socket.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <string>

#include "firmware/linux/telemetry/record_encoder.h"
#include "host_tools/input_error.h"
#include "host_tools/recording/live_reader.h"
#include "tests/support/folder_test.h"

namespace tactus::firmware {
namespace {

using host::LiveReader;
using namespace std::chrono_literals;

constexpr std::array<MetadataEntry, 1> kRun{{{"rate_hz", "1000"}}};

class LiveSocketTest : public FolderTest {
 protected:
  void SetUp() override { ASSERT_EQ(socket_->open(path_.c_str()), 0); }

  void accept() { socket_->accept_readers(encoder_.encode(std::span(kRun)), now_ns_); }
  void publish(std::uint64_t tick) {
    RecordedTick recorded;
    recorded.record.tick = tick;
    recorded.joint_count = 3;
    socket_->publish(encoder_.encode(recorded));
  }
  void send() { socket_->send(now_ns_); }

  // The tick that is next in the stream; -1 if there is none.
  static std::int64_t next_tick(LiveReader& reader) {
    while (const auto message = reader.next(0ms)) {
      if (const auto* tick = std::get_if<RecordedTick>(&*message)) {
        return static_cast<std::int64_t>(tick->record.tick);
      }
    }
    return -1;
  }

  std::string path_ = file("telemetry.sock");
  std::unique_ptr<LiveSocket> socket_ = std::make_unique<LiveSocket>();
  RecordEncoder encoder_;
  hal::TimeNs now_ns_ = 0;
};

TEST_F(LiveSocketTest, TellsEachReaderFirstWhatTheRunIs) {
  LiveReader reader(path_);
  accept();
  send();
  const auto message = reader.next(0ms);
  ASSERT_TRUE(message.has_value());
  const auto* info = std::get_if<host::RunInfo>(&*message);
  ASSERT_NE(info, nullptr);
  EXPECT_EQ(*info, (host::RunInfo{{"rate_hz", "1000"}}));
}

TEST_F(LiveSocketTest, GivesEveryTickToEveryReader) {
  LiveReader first(path_);
  LiveReader second(path_);
  accept();
  for (std::uint64_t tick = 0; tick < 100; ++tick) {
    publish(tick);
  }
  send();
  for (std::int64_t tick = 0; tick < 100; ++tick) {
    EXPECT_EQ(next_tick(first), tick);
    EXPECT_EQ(next_tick(second), tick);
  }
  EXPECT_EQ(socket_->counts().skipped, 0U);
}

TEST_F(LiveSocketTest, GivesExplanationsToReadersThatAskForThem) {
  LiveReader told(path_);
  LiveReader other(path_);
  accept();
  EXPECT_FALSE(socket_->hear_readers().explanations);
  const auto explain = [&](std::uint64_t tick) {
    socket_->publish_explanation(encoder_.encode(Explanation{.tick = tick}));
    send();
  };
  const auto explained = [](LiveReader& reader) {
    std::uint64_t newest = 0;
    while (const auto message = reader.next(0ms)) {
      if (const auto* explanation = std::get_if<Explanation>(&*message)) {
        newest = explanation->tick;
      }
    }
    return newest;
  };
  explain(7);
  EXPECT_EQ(explained(told), 0U);
  told.ask_for_explanations(true);
  EXPECT_TRUE(socket_->hear_readers().explanations);
  explain(8);
  EXPECT_EQ(explained(told), 8U);
  EXPECT_EQ(explained(other), 0U);
  told.ask_for_explanations(false);
  EXPECT_FALSE(socket_->hear_readers().explanations);
  explain(9);
  EXPECT_EQ(explained(told), 0U);
}

TEST_F(LiveSocketTest, GivesPlacesToReadersThatAskForThem) {
  LiveReader told(path_);
  LiveReader other(path_);
  accept();
  EXPECT_FALSE(socket_->hear_readers().places);
  told.ask_for_places();
  EXPECT_TRUE(socket_->hear_readers().places);
  EXPECT_FALSE(socket_->hear_readers().explanations);
  socket_->publish_places(encoder_.encode(ObjectPlaces{.tick = 8, .count = 1}));
  publish(9);
  send();
  (void)told.next(10s);  // the information about the run
  (void)other.next(10s);
  const auto message = told.next(10s);
  ASSERT_TRUE(message.has_value());
  ASSERT_TRUE(std::holds_alternative<ObjectPlaces>(*message));
  EXPECT_EQ(std::get<ObjectPlaces>(*message).tick, 8U);
  EXPECT_EQ(next_tick(other), 9);
}

// The place of a reader that has gone is another's, who asks anew.
TEST_F(LiveSocketTest, ForgetsWhatAReaderAskedForWhenItGoes) {
  {
    LiveReader reader(path_);
    reader.ask_for_explanations(true);
    accept();
    EXPECT_TRUE(socket_->hear_readers().explanations);
  }
  publish(0);
  send();
  publish(1);
  send();
  EXPECT_FALSE(socket_->hear_readers().explanations);
  const LiveReader next(path_);
  accept();
  EXPECT_FALSE(socket_->hear_readers().explanations);
}

TEST_F(LiveSocketTest, SkipsWholeMessagesForASlowReaderAndCountsEach) {
  LiveReader slow(path_);
  LiveReader quick(path_);
  accept();
  constexpr std::int64_t kTicks = 5000;  // a few megabytes: more than all buffers hold
  std::int64_t quick_ticks = 0;
  for (std::int64_t tick = 0; tick < kTicks; ++tick) {
    publish(static_cast<std::uint64_t>(tick));
    send();
    quick_ticks += next_tick(quick) == tick ? 1 : 0;
  }
  EXPECT_EQ(quick_ticks, kTicks);
  EXPECT_GT(socket_->counts().skipped, 0U);

  std::int64_t slow_ticks = 0;
  std::int64_t last = -1;
  for (int i = 0; i < 1000; ++i) {
    for (std::int64_t tick = next_tick(slow); tick >= 0; tick = next_tick(slow)) {
      EXPECT_GT(tick, last);
      last = tick;
      ++slow_ticks;
    }
    send();
  }
  EXPECT_EQ(static_cast<std::uint64_t>(kTicks - slow_ticks), socket_->counts().skipped);
}

TEST_F(LiveSocketTest, LetsADeadReaderGo) {
  {
    const LiveReader reader(path_);
    accept();
    EXPECT_EQ(socket_->counts().readers, 1U);
  }
  publish(0);
  send();
  publish(1);
  send();
  EXPECT_EQ(socket_->counts().readers, 0U);
  EXPECT_EQ(socket_->counts().lost, 1U);
}

TEST_F(LiveSocketTest, LetsAStuckReaderGoAfterAWhile) {
  const LiveReader stuck(path_);
  accept();
  for (std::uint64_t tick = 0; tick < 5000; ++tick) {
    publish(tick);
    send();
  }
  now_ns_ = LiveSocket::kPatience_ns;
  send();
  EXPECT_EQ(socket_->counts().readers, 1U);
  now_ns_ += 1;
  send();
  EXPECT_EQ(socket_->counts().readers, 0U);
}

TEST_F(LiveSocketTest, KeepsAReaderForWhomThereIsNothing) {
  LiveReader reader(path_);
  accept();
  send();
  now_ns_ = 3600'000'000'000;
  send();
  publish(7);
  send();
  EXPECT_EQ(next_tick(reader), 7);
}

TEST_F(LiveSocketTest, RefusesReadersForWhomThereIsNoPlace) {
  std::vector<std::unique_ptr<LiveReader>> readers;
  for (std::size_t i = 0; i < LiveSocket::kMaxReaders; ++i) {
    readers.push_back(std::make_unique<LiveReader>(path_));
    accept();
  }
  LiveReader one_too_many(path_);
  accept();
  EXPECT_EQ(socket_->counts().refused, 1U);
  EXPECT_EQ(next_tick(one_too_many), -1);
  EXPECT_TRUE(one_too_many.ended());
  readers.pop_back();
  publish(0);
  send();
  publish(1);
  send();
  LiveReader now_fits(path_);
  accept();
  publish(2);
  send();
  EXPECT_EQ(next_tick(now_fits), 2);
}

TEST_F(LiveSocketTest, IsForOwnerAndGroup) {
  struct stat status{};
  ASSERT_EQ(stat(path_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0660U);
}

TEST_F(LiveSocketTest, TakesThePlaceOfADeadOneOnly) {
  const auto second = std::make_unique<LiveSocket>();
  EXPECT_EQ(second->open(path_.c_str()), EADDRINUSE);
  // A program that was killed leaves its socket behind.
  const std::string left = file("left.sock");
  socket_->close();
  std::filesystem::remove(path_);
  const auto killed = std::make_unique<LiveSocket>();
  ASSERT_EQ(killed->open(left.c_str()), 0);
  std::filesystem::create_hard_link(left, path_);
  killed->close();
  EXPECT_THROW(LiveReader{path_}, host::InputError);
  EXPECT_EQ(second->open(path_.c_str()), 0);
  EXPECT_NO_THROW(LiveReader{path_});
}

TEST_F(LiveSocketTest, IsGoneWhenItIsClosed) {
  LiveReader reader(path_);
  accept();
  socket_->close();
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_EQ(next_tick(reader), -1);
  EXPECT_TRUE(reader.ended());
}

TEST_F(LiveSocketTest, SaysThatANameIsTooLong) {
  const auto other = std::make_unique<LiveSocket>();
  EXPECT_EQ(other->open(std::string(200, 'x').c_str()), ENAMETOOLONG);
}

}  // namespace
}  // namespace tactus::firmware
