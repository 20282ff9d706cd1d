// The messages of a scene: its triangles, and the frames of what moves.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/foxglove/scene_messages.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"

namespace tactus::host {
namespace {

using nlohmann::json;

constexpr std::uint64_t kNow_ns = 5'000'000'007;

class SceneMessages : public FolderTest {
 protected:
  // Bakes an example and returns its scene, which stays until the next one.
  const rendering::SceneImage& example(const std::string& name) {
    const std::string image = file(name + ".tactus");
    bake_file(testing::in_repository("host_tools/examples/" + name + "/scene.toml"), image);
    scene_ = std::make_unique<MappedScene>(image);
    return scene_->image();
  }

 private:
  std::unique_ptr<MappedScene> scene_;
};

TEST_F(SceneMessages, EveryObjectIsShownByTheTrianglesOfItsImage) {
  for (const std::string name : {"gem", "primitives", "shapes"}) {
    const rendering::SceneImage& scene = example(name);
    const json entities = json::parse(scene_message(scene, kNow_ns))["entities"];
    ASSERT_EQ(entities.size(), scene.objects().size());
    for (std::size_t i = 0; i < entities.size(); ++i) {
      const rendering::MeshView& mesh = scene.objects()[i].mesh;
      const json& shown = entities[i]["triangles"][0];
      EXPECT_GT(mesh.triangles.size(), 0U);
      EXPECT_EQ(shown["indices"].size(), 3 * mesh.triangles.size());
      ASSERT_EQ(shown["points"].size(), mesh.vertices.size());
      const rendering::Float3& last = mesh.vertices.back();
      EXPECT_EQ(shown["points"].back()["x"].get<float>(), last.x);
      EXPECT_EQ(shown["points"].back()["z"].get<float>(), last.z);
      EXPECT_EQ(shown["indices"].back(), mesh.triangles.back()[2]);
      EXPECT_EQ(entities[i]["metadata"][0]["value"], std::string(scene.object_name(i)));
    }
  }
}

TEST_F(SceneMessages, ASceneTakesThePlaceOfTheOneBefore) {
  const json message = json::parse(scene_message(example("gem"), kNow_ns));
  ASSERT_EQ(message["deletions"].size(), 1U);
  EXPECT_EQ(message["deletions"][0]["type"], 1);
  EXPECT_EQ(message["deletions"][0]["timestamp"], json({{"sec", 5}, {"nsec", 7}}));
  EXPECT_EQ(message["entities"][0]["timestamp"], json({{"sec", 5}, {"nsec", 8}}));
  const json none = json::parse(empty_scene_message(kNow_ns));
  EXPECT_EQ(none["deletions"], message["deletions"]);
  EXPECT_TRUE(none["entities"].empty());
}

TEST_F(SceneMessages, WhatMovesHasAFrameOfItsOwnAtItsPlace) {
  const rendering::SceneImage& scene = example("paddle");
  const std::array<firmware::ObjectPlace, 1> places = {
      {{.object = 1, .origin_W = {0.1, 0.2, 0.3}, .rotation_W = {0.6, 0.0, 0.8, 0.0}}}};
  const json frames =
      json::parse(frames_message(&scene, {.time_ns = 4, .places = places}, kNow_ns))["transforms"];
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0]["parent_frame_id"], "map");
  EXPECT_EQ(frames[0]["child_frame_id"], "W");
  EXPECT_EQ(frames[1]["child_frame_id"], object_frame(scene, 0));
  EXPECT_EQ(frames[1]["translation"], json({{"x", 0}, {"y", 0}, {"z", 0}}));
  EXPECT_EQ(frames[1]["timestamp"]["nsec"], 7);
  EXPECT_EQ(frames[2]["timestamp"]["nsec"], 4);
  EXPECT_EQ(frames[2]["parent_frame_id"], "W");
  EXPECT_EQ(frames[2]["child_frame_id"], object_frame(scene, 1));
  EXPECT_EQ(frames[2]["translation"], json({{"x", 0.1}, {"y", 0.2}, {"z", 0.3}}));
  EXPECT_EQ(frames[2]["rotation"], json({{"x", 0}, {"y", 0.8}, {"z", 0}, {"w", 0.6}}));
}

TEST_F(SceneMessages, WithoutASceneThereIsTheWorldAlone) {
  EXPECT_EQ(json::parse(frames_message(nullptr, {}, kNow_ns))["transforms"].size(), 1U);
}

}  // namespace
}  // namespace tactus::host
