// A scene with bodies that a test bakes and runs.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/bake/scene/scene_description.h"
#include "rendering/scene/scene_world.h"
#include "rendering/world/world.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::testing {

// Returns the error of a scene's text, or nothing if it has none.
inline std::string body_refused(const std::string& text) {
  return input_error([&] { host::parse_scene_description(text, "folder/scene.toml"); });
}

// A scene that is baked into a folder of its own.
class BakedBodyScene : public ::testing::Test {
 protected:
  host::BakeReport bake(const std::string& text) {
    static_cast<void>(folder_.write("scene.toml", text));
    host::BakeReport report =
        host::bake_file(folder_.path() / "scene.toml", folder_.path() / "scene.tactus", {});
    scene_ = std::make_unique<host::MappedScene>(folder_.path() / "scene.tactus");
    return report;
  }
  // Runs the world for so many milliseconds with the tool far away.
  [[nodiscard]] std::unique_ptr<rendering::World> run(int ticks) const {
    auto world = std::make_unique<rendering::World>();
    EXPECT_TRUE(world->set_scene(scene_->image().objects(), rendering::world_of(scene_->image())));
    for (int i = 0; i < ticks; ++i) {
      world->touch({.p_W = Vec3(1.0, 1.0, 1.0)});
    }
    return world;
  }

  TemporaryFolder folder_;
  std::unique_ptr<host::MappedScene> scene_;
};

}  // namespace tactus::testing
