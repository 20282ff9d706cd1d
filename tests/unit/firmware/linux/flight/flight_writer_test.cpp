// A fault is written to a file that replays to the same hashes, up to what followed it.
#include "firmware/linux/flight/flight_writer.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "firmware/configuration/config_state.h"
#include "firmware/linux/flight/attachments.h"
#include "host_tools/input_error.h"
#include "host_tools/recording/recording.h"
#include "host_tools/replay/replay.h"
#include "tests/replay/scene_walk.h"
#include "tests/support/folder_test.h"

namespace tactus::firmware {
namespace {

using testing::SceneWalk;
using testing::TickInput;

class FlightWriterTest : public FolderTest {
 protected:
  FlightWriterTest() {
    EXPECT_TRUE(controller_->configure(testing::walking_config()));
    config_size_ = save_config(controller_->config(), config_);
    images_[0] = {.name = kConfigAttachment, .bytes = std::span(config_).first(config_size_)};
  }

  void start() { ASSERT_EQ(writer_->start({.folder = folder(), .images = images_}), 0); }

  void tick(Request request) {
    TickInput input;
    input.request = request;
    give(*controller_, input);
    writer_->add({.record = controller_->record()}, *controller_);
  }

  void become_active() {
    tick(Request::home);
    tick(Request::none);
    tick(Request::enable);
    ASSERT_EQ(controller_->mode(), Mode::active);
  }

  std::unique_ptr<Controller> controller_ = std::make_unique<Controller>();
  std::unique_ptr<FlightWriter> writer_ = std::make_unique<FlightWriter>();
  std::array<std::byte, kMaxConfigBytes> config_{};
  std::size_t config_size_ = 0;
  std::array<Attachment, 1> images_{};
};

TEST_F(FlightWriterTest, WritesAFaultThatReplays) {
  start();
  become_active();
  for (int i = 0; i < 500; ++i) {
    tick(Request::none);
  }
  tick(Request::estop);
  ASSERT_EQ(controller_->mode(), Mode::fault);
  for (int i = 0; i < 50; ++i) {
    tick(Request::none);
  }
  writer_->stop();
  ASSERT_EQ(writer_->files(), 1U);
  host::RecordedRun run(writer_->path(), {});
  bool faulted = false;
  const host::ReplayResult result = host::replay(run, [&](const RecordedTick& recorded) {
    faulted = faulted || recorded.record.mode == Mode::fault;
  });
  EXPECT_FALSE(result.difference);
  EXPECT_TRUE(faulted);
  EXPECT_EQ(result.first_tick + result.ticks, controller_->next_tick());
}

TEST_F(FlightWriterTest, WritesWhenAskedAndOnlyThen) {
  start();
  become_active();
  tick(Request::disable);
  writer_->stop();
  EXPECT_EQ(writer_->files(), 0U);

  auto asked = std::make_unique<FlightWriter>();
  ASSERT_EQ(asked->start({.folder = folder(), .images = images_}), 0);
  for (int i = 0; i < 10; ++i) {
    testing::give(*controller_, {});
    asked->add({.record = controller_->record()}, *controller_);
  }
  asked->ask();
  asked->stop();
  EXPECT_EQ(asked->files(), 1U);
  host::RecordedRun run(asked->path(), {});
  EXPECT_EQ(host::replay(run).ticks, 9U);
}

TEST_F(FlightWriterTest, SaysWhatItCannotWrite) {
  ASSERT_EQ(writer_->start({.folder = "/nowhere/at/all", .images = images_}), 0);
  become_active();
  tick(Request::estop);
  writer_->stop();
  EXPECT_EQ(writer_->files(), 0U);
}

}  // namespace
}  // namespace tactus::firmware
