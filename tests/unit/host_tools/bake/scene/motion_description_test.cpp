// Objects that move and deform, from the text of a scene to the touch.
#include <gtest/gtest.h>

#include <memory>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/bake/scene/scene_description.h"
#include "rendering/world/world.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::testing {
namespace {

using rendering::Touch;
using rendering::World;

const std::string kStillBall = "[[object]]\nprimitive = \"sphere\"\nradius_m = 0.03\n";
const std::string kMesh = "[[object]]\nmesh = \"a.off\"\n";

host::MotionDescription motion_of(const std::string& text) {
  return host::parse_scene_description(text, "folder/scene.toml").objects.front().motion;
}

std::string error_of(const std::string& text) {
  return input_error([&] { host::parse_scene_description(text, "folder/scene.toml"); });
}

TEST(MotionDescription, StandsStillUnlessToldToMove) {
  EXPECT_FALSE(motion_of(kStillBall).moves);
  EXPECT_FALSE(motion_of(kStillBall).deforms);
  EXPECT_FALSE(motion_of(kStillBall).motion.has_value());
  EXPECT_TRUE(motion_of(kStillBall + "moves = true\n").moves);
  EXPECT_TRUE(motion_of(kMesh + "deforms = true\n").deforms);
}

TEST(MotionDescription, TakesEveryKey) {
  const host::MotionDescription moving = motion_of(
      kMesh +
      "position_m = [0.1, 0.2, 0.3]\ndeforms = true\nmotion = { velocity_m_per_s = [1.0, 2.0, "
      "3.0], "
      "sway_m = [0.01, 0.0, 0.0], sway_hz = 2.0, spin_rad_per_s = [0.0, 0.0, 4.0], wave_m = 0.002, "
      "wave_hz = 1.5, waves_per_m = [10.0, 0.0, 5.0] }\n");
  ASSERT_TRUE(moving.motion.has_value());
  EXPECT_TRUE(moving.moves);
  EXPECT_EQ(moving.motion->velocity_W, Vec3(1, 2, 3));
  EXPECT_EQ(moving.motion->sway_W, Vec3(0.01, 0, 0));
  EXPECT_EQ(moving.motion->sway_Hz, 2.0);
  EXPECT_EQ(moving.motion->spin_W, Vec3(0, 0, 4));
  EXPECT_EQ(moving.motion->pivot_W, Vec3(0.1, 0.2, 0.3)) << "where the object stands";
  EXPECT_EQ(moving.motion->wave_m, 0.002);
  EXPECT_EQ(moving.motion->wave_Hz, 1.5);
  EXPECT_EQ(moving.motion->wave_per_m, Vec3(10, 0, 5));
  const auto turning =
      motion_of(kStillBall + "motion = { spin_rad_per_s = [0, 1, 0], pivot_m = [1, 0, 0] }\n");
  EXPECT_EQ(turning.motion->pivot_W, Vec3(1, 0, 0));
}

TEST(MotionDescription, RefusesWhatCannotBe) {
  EXPECT_TRUE(contains(error_of(kStillBall + "deforms = true\n"), "only a mesh"));
  EXPECT_TRUE(contains(error_of(kMesh + "contact = \"feature_walk\"\ndeforms = true\n"),
                       "folder/scene.toml:4: object 1: only a mesh with contact"));
  EXPECT_TRUE(contains(error_of(kMesh + "motion = { wave_m = 0.001 }\n"), "deforms = true"));
  EXPECT_TRUE(contains(error_of(kStillBall + "motion = { sway_m = [0.1, 0, 0] }\n"), "sway_hz"));
  EXPECT_TRUE(contains(error_of(kStillBall + "motion = { sway_m = [101, 0, 0], sway_hz = 1 }\n"),
                       "above 100 m"));
  EXPECT_TRUE(contains(
      error_of(kStillBall + "moves = false\nmotion = { sway_hz = 1, sway_m = [0, 0, 0] }\n"),
      "moves is false"));
  EXPECT_TRUE(contains(error_of(kStillBall + "motion = { spin_deg_per_s = [0, 1, 0] }\n"),
                       "spin_rad_per_s"));
}

TEST(MotionDescription, IsFeltInTheWorld) {
  const TemporaryFolder folder;
  const auto scene_file =
      folder.write("scene.toml", "[tool]\nradius_m = 0.0\n" + kStillBall +
                                     "motion = { velocity_m_per_s = [0.0, 0.1, 0.0] }\n");
  host::bake_file(scene_file, folder.path() / "scene.tactus");
  const host::MappedScene scene(folder.path() / "scene.tactus");
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene(scene.image().objects(), {}));
  Touch touch;
  for (int tick = 0; tick <= 100; ++tick) {
    touch = world->touch({.p_W = {0.0, 0.031, 0.0}});
  }
  EXPECT_NEAR(touch.proxy_W.y(), 0.04, 2e-6) << "a ball that rose by 10 mm in 100 ticks";
}

TEST(MotionDescription, SaysWhenTheMovingObjectsDoNotFit) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 65; ++i) {
    text += "[[object]]\nname = \"b" + std::to_string(i) +
            "\"\nprimitive = \"sphere\"\nradius_m = 0.001\nmoves = true\n";
  }
  const auto scene_file = folder.write("scene.toml", text);
  EXPECT_TRUE(
      contains(input_error([&] { host::bake_file(scene_file, folder.path() / "scene.tactus"); }),
               "65 objects that move or deform, where 64 fit"));
}

}  // namespace
}  // namespace tactus::testing
