// A controller that is given inputs, and the recording of its ticks.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/configuration/config_state.h"
#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/telemetry/record_encoder.h"
#include "firmware/linux/telemetry/run_recorder.h"
#include "rendering/scene/image_format.h"
#include "rendering/scene/scene_world.h"
#include "tests/replay/scene_walk.h"
#include "tests/support/folder_test.h"

namespace tactus::testing {

class RecordedWalk : public FolderTest {
 protected:
  // Begins a recording of a run in the scene of that image.
  explicit RecordedWalk(std::vector<std::byte> image)
      : first_(std::move(image)), path_(file("run.mcap")) {
    EXPECT_TRUE(controller_->configure(walking_config()));
    const std::size_t size = save_config(controller_->config(), config_);
    recorder_->describe({.info = info_, .joints = 3});
    recorder_->attach(
        {.name = firmware::kConfigAttachment, .bytes = std::span(config_).first(size)});
    load(first_);
    recorder_->attach({.name = firmware::kSceneAttachment, .bytes = first_});
    EXPECT_EQ(recorder_->open(path_.c_str()), 0);
  }

  void load(std::span<const std::byte> image) {
    scene_.emplace(*rendering::SceneImage::open(image));
    ASSERT_TRUE(controller_->load_scene(scene_->objects(), rendering::world_of(*scene_)));
  }

  void tick(const TickInput& input) {
    give(*controller_, input);
    contacts_ += controller_->record().contact != rendering::ContactKind::none ? 1U : 0U;
    const firmware::RecordedTick tick{.record = controller_->record(), .joint_count = 3};
    recorder_->add(tick, encoder_->encode(tick));
  }

  void walk(int ticks, std::uint64_t seed) {
    SceneWalk walk(scene_->objects(), seed);
    for (int i = 0; i < ticks; ++i) {
      tick(walk.next(controller_->mode()));
    }
  }

  const std::vector<std::byte> first_;
  const std::string checksum_ = hex(rendering::header_checksum(first_));
  const std::array<firmware::MetadataEntry, 1> info_{{{firmware::kSceneChecksumKey, checksum_}}};
  const std::string path_;
  std::array<std::byte, firmware::kMaxConfigBytes> config_{};
  std::optional<rendering::SceneImage> scene_;
  std::size_t contacts_ = 0;
  std::unique_ptr<firmware::Controller> controller_ = std::make_unique<firmware::Controller>();
  std::unique_ptr<firmware::RunRecorder> recorder_ = std::make_unique<firmware::RunRecorder>();
  std::unique_ptr<firmware::RecordEncoder> encoder_ = std::make_unique<firmware::RecordEncoder>();

 private:
  static std::string hex(std::uint64_t number) {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(number));
    return text.data();
  }
};

}  // namespace tactus::testing
