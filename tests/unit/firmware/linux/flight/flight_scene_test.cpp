// The flight recorder of a run whose scene is changed: what it writes is of the new one, and
// replays.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "firmware/configuration/config_state.h"
#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/flight/flight_writer.h"
#include "host_tools/replay/replay.h"
#include "tests/support/folder_test.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::firmware {
namespace {

class FlightScene : public FolderTest {
 protected:
  FlightScene() {
    EXPECT_TRUE(controller_->configure(cartesian_config()));
    const std::size_t size = save_config(controller_->config(), config_);
    first_ = host::write_image(testing::small_scene());
    load(first_);
    const std::array<Attachment, 2> images{
        Attachment{.name = kConfigAttachment, .bytes = std::span(config_).first(size)},
        Attachment{.name = kSceneAttachment, .bytes = first_}};
    const std::array<MetadataEntry, 3> info{MetadataEntry{"program", "test"},
                                            MetadataEntry{kSceneFileKey, "first.tactus"},
                                            MetadataEntry{kSceneChecksumKey, "0123456789abcdef"}};
    EXPECT_EQ(
        writer_->start({.folder = folder(), .run = {.info = info, .joints = 3}, .images = images}),
        0);
    run(Request::home, 1);
    run(Request::none, 200);
  }

  static std::vector<std::byte> other_image() {
    host::BakedScene scene = testing::small_scene();
    scene.objects.resize(1);
    return host::write_image(scene);
  }

  void load(std::span<const std::byte> image) {
    scene_.emplace(*rendering::SceneImage::open(image));
    ASSERT_TRUE(controller_->load_scene(scene_->objects(), {.tool_radius_m = 0.002}));
  }

  void run(Request request, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      drivers::JointSample sample;
      sample.position = {0.01, 0.02 + 1e-5 * static_cast<double>(controller_->next_tick()), 0.03};
      controller_->tick(sample, request);
      writer_->add({.record = controller_->record(), .joint_count = 3}, *controller_);
    }
  }

  std::vector<std::byte> first_;
  std::optional<rendering::SceneImage> scene_;
  std::array<std::byte, kMaxConfigBytes> config_{};
  std::unique_ptr<Controller> controller_ = std::make_unique<Controller>();
  std::unique_ptr<FlightWriter> writer_ = std::make_unique<FlightWriter>();
};

TEST_F(FlightScene, WhatFollowsAChangeOfTheSceneReplays) {
  const std::vector<std::byte> second = other_image();
  const std::uint64_t changed = controller_->next_tick();
  load(second);
  writer_->leave_scene();
  run(Request::none, 1);
  writer_->use_scene(second);
  first_ = {};  // nobody looks at it any more
  run(Request::none, 100);
  run(Request::estop, 1);
  run(Request::none, 300);
  writer_->stop();
  ASSERT_EQ(writer_->files(), 1U);

  host::RecordedRun recorded(writer_->path(), {});
  const host::ReplayResult result = host::replay(recorded);
  EXPECT_FALSE(result.difference) << result.difference->tick << ' ' << result.difference->field
                                  << ' ' << result.difference->recorded << ' '
                                  << result.difference->replayed;
  EXPECT_EQ(result.first_tick, changed + 1);
  EXPECT_GT(result.ticks, 100U);
}

TEST_F(FlightScene, NothingIsWrittenWhileTheImageIsNotKnown) {
  const std::vector<std::byte> second = other_image();
  load(second);
  writer_->leave_scene();
  run(Request::none, 10);
  writer_->ask();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(writer_->files(), 0U);
  writer_->use_scene(second);
  writer_->stop();
  EXPECT_EQ(writer_->files(), 1U);
}

}  // namespace
}  // namespace tactus::firmware
