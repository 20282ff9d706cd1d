// A recording of a run whose scene was changed on the way replays to its end.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/configuration/config_state.h"
#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/telemetry/record_encoder.h"
#include "firmware/linux/telemetry/run_recorder.h"
#include "host_tools/input_error.h"
#include "host_tools/replay/replay.h"
#include "host_tools/replay/what_if.h"
#include "rendering/scene/scene_world.h"
#include "tests/replay/scene_walk.h"
#include "tests/support/folder_test.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::testing {
namespace {

using firmware::Controller;
using firmware::Mode;
using firmware::Request;

class SceneChange : public FolderTest {
 protected:
  SceneChange() : path_(file("run.mcap")) {
    EXPECT_TRUE(controller_->configure(walking_config()));
    const std::size_t size = save_config(controller_->config(), config_);
    recorder_->describe({.info = info_, .joints = 3});
    recorder_->attach(
        {.name = firmware::kConfigAttachment, .bytes = std::span(config_).first(size)});
    load(first_);
    recorder_->attach({.name = firmware::kSceneAttachment, .bytes = first_});
    EXPECT_EQ(recorder_->open(path_.c_str()), 0);
  }

  static std::vector<std::byte> other_image() {
    host::BakedScene scene = small_scene();
    scene.objects.resize(1);
    return host::write_image(scene);
  }

  void load(std::span<const std::byte> image) {
    scene_.emplace(*rendering::SceneImage::open(image));
    ASSERT_TRUE(controller_->load_scene(scene_->objects(), rendering::world_of(*scene_)));
  }

  // Changes the scene as tactusd does: not while active; the image comes some ticks after the
  // event.
  void change_to(std::span<const std::byte> image, std::span<const std::byte> attached) {
    while (controller_->mode() == Mode::active) {
      tick({.request = Request::disable});
    }
    load(image);
    firmware::TelemetryEvent event{.tick = controller_->next_tick(),
                                   .kind = firmware::EventKind::scene};
    set_name(event, firmware::kSceneAttachment);
    recorder_->add(event, encoder_->encode(event));
    walk(3, 1);
    recorder_->attach({.name = firmware::kSceneAttachment, .bytes = attached});
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

  const std::vector<std::byte> first_ = host::write_image(small_scene());
  const std::vector<std::byte> second_ = other_image();
  const std::string checksum_ = hex(firmware::checksum_of(first_));
  const std::array<firmware::MetadataEntry, 1> info_{{{firmware::kSceneChecksumKey, checksum_}}};
  const std::string path_;
  std::array<std::byte, firmware::kMaxConfigBytes> config_{};
  std::optional<rendering::SceneImage> scene_;
  std::size_t contacts_ = 0;
  std::unique_ptr<Controller> controller_ = std::make_unique<Controller>();
  std::unique_ptr<firmware::RunRecorder> recorder_ = std::make_unique<firmware::RunRecorder>();
  std::unique_ptr<firmware::RecordEncoder> encoder_ = std::make_unique<firmware::RecordEncoder>();

 private:
  static std::string hex(std::uint64_t number) {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(number));
    return text.data();
  }
};

TEST_F(SceneChange, IsReplayed) {
  walk(2000, 2);
  change_to(second_, second_);
  walk(2000, 3);
  change_to(first_, first_);
  walk(2000, 4);
  ASSERT_EQ(recorder_->close(), 0);
  EXPECT_GT(contacts_, 100U);

  host::RecordedRun run(path_, {});
  const host::ReplayResult result = host::replay(run);
  ASSERT_FALSE(result.difference) << result.difference->tick << ' ' << result.difference->field;
  EXPECT_EQ(result.ticks, controller_->next_tick());
}

TEST_F(SceneChange, EndsWhatAnotherParameterWouldHaveBeen) {
  walk(500, 5);
  change_to(second_, second_);
  const std::uint64_t changed = controller_->next_tick() - 3;
  walk(500, 6);
  ASSERT_EQ(recorder_->close(), 0);

  host::RecordedRun run(path_, {});
  const std::array changes{host::parse_change("object.1.stiffness_N_per_m=100", run.scene())};
  const host::WhatIfSummary summary = host::what_if(run, changes, [](const auto&) {});
  EXPECT_EQ(summary.ticks, changed);
  EXPECT_TRUE(summary.scene_changed_s);
}

TEST_F(SceneChange, ToAnImageThatIsNotInTheRecordingIsToldOf) {
  walk(500, 7);
  change_to(second_, {});
  walk(500, 8);
  ASSERT_EQ(recorder_->close(), 0);

  host::RecordedRun run(path_, {});
  try {
    host::replay(run);
    FAIL() << "replayed without the image";
  } catch (const host::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("scene.tactus"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace tactus::testing
