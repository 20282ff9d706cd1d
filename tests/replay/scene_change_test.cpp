// A recording of a run whose scene was changed on the way replays to its end.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "host_tools/input_error.h"
#include "host_tools/replay/replay.h"
#include "host_tools/replay/what_if.h"
#include "tests/replay/recorded_walk.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::testing {
namespace {

using firmware::Mode;
using firmware::Request;

class SceneChange : public RecordedWalk {
 protected:
  SceneChange() : RecordedWalk(host::write_image(small_scene())) {}

  static std::vector<std::byte> other_image() {
    host::BakedScene scene = small_scene();
    scene.objects.resize(1);
    return host::write_image(scene);
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

  const std::vector<std::byte> second_ = other_image();
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
