#include "host_tools/serial/line_gateway.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <variant>

#include "firmware/linux/flight/attachments.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/cache_folder.h"
#include "host_tools/input_error.h"
#include "host_tools/recording/live_reader.h"
#include "host_tools/recording/recording.h"
#include "host_tools/remote/remote.h"
#include "host_tools/remote/reply_fields.h"
#include "host_tools/replay/replay.h"
#include "host_tools/serial/line_session.h"
#include "tests/support/folder_test.h"
#include "tests/unit/host_tools/serial/line_board.h"

namespace tactus::host {
namespace {

using namespace std::chrono_literals;

// The text of the exception of that type that `work` throws; empty if it throws none.
template <class Exception, class Work>
std::string thrown_text(Work&& work) {
  try {
    work();
  } catch (const Exception& error) {
    return error.what();
  }
  return "";
}

// Waits for a condition that another thread brings about.
template <class Condition>
bool comes_true(Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + 10s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

class LineGatewayTest : public FolderTest {
 protected:
  LineGatewayTest() : images_(bake_line_images()) {
    ::setenv("XDG_CACHE_HOME", folder(), 1);  // NOLINT(concurrency-mt-unsafe): no other thread yet
    board_ = std::make_unique<LineBoard>(images_);
  }

  [[nodiscard]] GatewayOptions options() const {
    GatewayOptions options;
    options.place = parse_serial_place(board_->path());
    options.run_dir = file("run");
    return options;
  }

  // Sends lines to the board over a session, and expects each reply to begin as given.
  static void expect_replies(
      const std::filesystem::path& folder,
      const std::vector<std::pair<std::string, std::string>>& lines_and_replies) {
    Remote remote(folder);
    for (const auto& [line, reply] : lines_and_replies) {
      const std::string text = remote.send(line).text;
      EXPECT_TRUE(text.starts_with(reply)) << line << ": " << text;
    }
  }

  // Operates the board for some ticks over a session that records to a file.
  void record_run(const std::string& recording) {
    GatewayOptions with_recording = options();
    with_recording.record = recording;
    LineSession session(std::move(with_recording));
    expect_replies(session.folder(), {{"home", "ok home "}});
    ASSERT_TRUE(comes_true(
        [&] { return field_of(Remote(session.folder()).send("status").text, "mode") == "ready"; }));
    expect_replies(session.folder(), {{"enable", "ok enable "}, {"set max_force_N 4", "ok set "}});
    ASSERT_TRUE(comes_true([&] { return board_->hash_of(600) != 0; }));
    session.finish();
  }

  LineBoardImages images_;
  std::unique_ptr<LineBoard> board_;
};

TEST_F(LineGatewayTest, EveryCommandOfTheSocketsReachesTheBoard) {
  LineSession session(options());
  expect_replies(session.folder(), {{"enable", "refused enable "},
                                    {"home", "ok home "},
                                    {"get max_force_N", "ok get "},
                                    {"set max_force_N 3", "ok set "},
                                    {"set max_force_N 1000", "refused set: the value is out of"},
                                    {"set object.ball.stiffness_N_per_m 300", "ok set "},
                                    {"get object.1.stiffness_N_per_m", "refused get: "},
                                    {"get object.cube.stiffness_N_per_m", "refused get: "},
                                    {"status", "ok status "}});
  const Reply list = Remote(session.folder()).send("list", 60s);
  EXPECT_TRUE(list.is_ok);
  EXPECT_GT(list.lines.size(), 10U);
  EXPECT_NE(list.lines.back().find(" object=ball"), std::string::npos) << list.lines.back();
  session.finish();
}

TEST_F(LineGatewayTest, ASceneAndAnInjectedFaultAreRefusedWithTheReason) {
  LineSession session(options());
  expect_replies(session.folder(),
                 {{"scene other.tactus", "refused scene: a board's scene is part of its program"},
                  {"inject lost 2", "refused inject: a board takes no faults from outside"}});
  session.finish();
}

TEST_F(LineGatewayTest, AReaderOfTheLiveSocketGetsTheBoardsTicksBitForBit) {
  LineSession session(options());
  LiveReader reader((session.folder() / kLiveSocketFile).string());
  std::uint64_t ticks = 0;
  bool has_name = false;
  while (ticks < 200) {
    const auto message = reader.next(10s);
    ASSERT_TRUE(message);
    if (const auto* info = std::get_if<RunInfo>(&*message)) {
      has_name = std::ranges::find(*info, std::pair<std::string, std::string>(
                                              "device", "test board")) != info->end();
    } else if (const auto* tick = std::get_if<firmware::RecordedTick>(&*message)) {
      EXPECT_EQ(tick->record.state_hash, board_->hash_of(tick->record.tick));
      EXPECT_EQ(tick->joint_count, 3U);
      ++ticks;
    }
  }
  EXPECT_TRUE(has_name);
  session.finish();
}

TEST_F(LineGatewayTest, TheStopIsAnsweredByTheTickThatTookItAlsoIfTheLineLosesIt) {
  board_->troubles().unheard_stops = 3;
  LineSession session(options());
  const Reply reply = send_stop(session.folder());
  EXPECT_TRUE(reply.is_ok) << reply.text;
  EXPECT_EQ(field_of(reply.text, "mode"), "fault");
  session.finish();
}

TEST_F(LineGatewayTest, TheStopGoesOverTheLineWithoutAGateway) {
  {
    LineSession(options()).finish();
  }  // the board has begun to tick
  board_->troubles().unheard_stops = 3;
  const Reply reply = send_stop_over_line(parse_serial_place(board_->path()));
  EXPECT_TRUE(reply.is_ok);
  EXPECT_EQ(field_of(reply.text, "mode"), "fault") << reply.text;
  board_->troubles().is_mute = true;
  EXPECT_NE(thrown_text<UnreachableError>([&] {
              send_stop_over_line(parse_serial_place(board_->path()));
            }).find("cut the power of the motors"),
            std::string::npos);
}

TEST_F(LineGatewayTest, ARecordingFromTheFirstTickOnReplaysToTheSameHashes) {
  const std::string recording = file("run.mcap");
  record_run(recording);
  RecordedRun run(recording, {});
  const ReplayResult result = replay(run);
  EXPECT_EQ(result.first_tick, 0U);
  EXPECT_GT(result.ticks, 600U);
  EXPECT_FALSE(result.difference) << result.difference->field;
  EXPECT_EQ(run.ticks().info("device"), "test board");
  EXPECT_EQ(run.ticks().attachment(firmware::kSceneAttachment).size(), images_.scene.size());
  // The recording was operated: the requests are in it.
  ASSERT_GE(run.ticks().events().size(), 3U);
  EXPECT_EQ(name_of(run.ticks().events().front()), "home");
}

TEST_F(LineGatewayTest, ImagesComeOverANoisyLineOnceAndFromTheCacheThen) {
  board_->troubles().broken_every = 9;
  {
    LineSession(options()).finish();
  }
  std::this_thread::sleep_for(200ms);  // until the board has heard all that was asked
  const std::uint32_t asks = board_->image_asks();
  EXPECT_GE(asks, 2U);
  {
    LineSession(options()).finish();
  }
  EXPECT_EQ(board_->image_asks(), asks);
  // A bit that has changed in the cache is found.
  for (const auto& entry : std::filesystem::directory_iterator(user_cache_folder())) {
    std::fstream stream(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(200);
    stream.put('\x55');
  }
  {
    LineSession(options()).finish();
  }
  EXPECT_GT(board_->image_asks(), asks);
}

TEST_F(LineGatewayTest, AnotherImageThanTheBoardsIsRefused) {
  for (const auto& [name, image] :
       {std::pair{"device.tactus", &images_.device}, std::pair{"scene.tactus", &images_.scene}}) {
    write_file_atomically(file(name), *image);
  }
  GatewayOptions with_images = options();
  with_images.device_image = file("device.tactus");
  with_images.scene_image = file("scene.tactus");
  {
    LineSession(with_images).finish();
  }
  EXPECT_EQ(board_->image_asks(), 0U);
  with_images.scene_image = file("device.tactus");
  EXPECT_NE(thrown_text<InputError>([&] {
              const LineSession session(with_images);
            }).find("another image than the board's"),
            std::string::npos);
}

TEST_F(LineGatewayTest, WithoutNamesNoImageIsFetched) {
  GatewayOptions without_images = options();
  without_images.wants_images = false;
  LineSession session(without_images);
  expect_replies(session.folder(), {{"home", "ok home "}, {"status", "ok status "}});
  session.finish();
  EXPECT_EQ(board_->image_asks(), 0U);
}

TEST_F(LineGatewayTest, TheBoardIsSupervisedUntilTheSessionEndsInOrder) {
  LineSession session(options());
  ASSERT_TRUE(comes_true([&] { return board_->is_supervised(); }));
  std::this_thread::sleep_for(1200ms);
  session.finish();
  EXPECT_TRUE(comes_true([&] { return !board_->is_supervised(); }));
  EXPECT_FALSE(board_->has_lost_host());
}

TEST_F(LineGatewayTest, APulledCableEndsTheSessionWithTheReason) {
  LineSession session(options());
  board_->pull_cable();
  ASSERT_TRUE(comes_true([&] { return session.has_failed(); }));
  EXPECT_NE(thrown_text<UnreachableError>([&] { session.finish(); }).find("the line is lost"),
            std::string::npos);
}

TEST_F(LineGatewayTest, ASilentBoardEndsTheSessionAfterTwoSeconds) {
  LineSession session(options());
  const auto begin = std::chrono::steady_clock::now();
  board_->troubles().is_mute = true;
  ASSERT_TRUE(comes_true([&] { return session.has_failed(); }));
  EXPECT_GT(std::chrono::steady_clock::now() - begin, 1900ms);
  EXPECT_NE(thrown_text<UnreachableError>([&] { session.finish(); }).find("for two seconds"),
            std::string::npos);
}

TEST_F(LineGatewayTest, ABoardThatDoesNotAnswerIsNoBoard) {
  board_->troubles().is_mute = true;
  EXPECT_NE(thrown_text<UnreachableError>([&] {
              const LineSession session(options());
            }).find("the board says nothing"),
            std::string::npos);
}

TEST_F(LineGatewayTest, ABoardOfAnotherVersionIsRefusedWithBothVersions) {
  board_->troubles().version = firmware::kLineVersion + 1;
  EXPECT_NE(thrown_text<UnreachableError>([&] {
              const LineSession session(options());
            }).find("speaks version 2 of the line's messages, and this program 1"),
            std::string::npos);
}

TEST_F(LineGatewayTest, OneTickInSoManyComesIfTheUserAsksForThat) {
  GatewayOptions sparse = options();
  sparse.every = 10;
  sparse.record = file("sparse.mcap");
  LineSession session(sparse);
  ASSERT_TRUE(comes_true([&] { return board_->hash_of(300) != 0; }));
  session.finish();
  Recording recording(file("sparse.mcap"));
  std::uint64_t expected = 0;
  while (const auto tick = recording.next()) {
    EXPECT_EQ(tick->record.tick, expected);
    expected += 10;
  }
  EXPECT_GE(expected, 290U);
}

TEST(TicksApart, ASlowLineCarriesFewerTicks) {
  const std::uint32_t slow = ticks_apart({.path = "/dev/ttyUSB0", .baud = 115'200}, 1000.0);
  const std::uint32_t fast = ticks_apart({.path = "/dev/ttyUSB0", .baud = 2'000'000}, 1000.0);
  // A tick has about a kilobyte, ten thousand bits.
  EXPECT_GT(slow, 70U);
  EXPECT_LT(slow, 200U);
  EXPECT_GT(fast, 3U);
  EXPECT_LT(fast, 12U);
  EXPECT_EQ(ticks_apart({.path = "board.sock", .is_socket = true}, 1000.0), 1U);
  EXPECT_EQ(ticks_apart({.path = "/dev/ttyUSB0", .baud = 115'200}, 1.0), 1U);
}

}  // namespace
}  // namespace tactus::host
