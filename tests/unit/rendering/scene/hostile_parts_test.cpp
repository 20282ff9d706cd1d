// Bodies of several parts in images whose checksum is right and whose content is not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "rendering/scene/scene_image.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::rendering {
namespace {

// Returns the hull of a tetrahedron.
host::BakedHull corner_hull() {
  const Vec3 slanted = Vec3::Constant(std::sqrt(1.0 / 3.0));
  return {.vertices = {Vec3::Zero(), 0.1 * Vec3::UnitX(), 0.1 * Vec3::UnitY(), 0.1 * Vec3::UnitZ()},
          .faces = {{.normal_O = -Vec3::UnitZ(), .first = 0, .count = 3},
                    {.normal_O = -Vec3::UnitY(), .first = 3, .count = 3},
                    {.normal_O = -Vec3::UnitX(), .first = 6, .count = 3},
                    {.normal_O = slanted, .first = 9, .count = 3}},
          .corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3},
          .edges = {{.from = 0, .to = 1, .left = 1, .right = 0},
                    {.from = 0, .to = 2, .left = 0, .right = 2},
                    {.from = 0, .to = 3, .left = 2, .right = 1},
                    {.from = 1, .to = 2, .left = 3, .right = 0},
                    {.from = 1, .to = 3, .left = 1, .right = 3},
                    {.from = 2, .to = 3, .left = 3, .right = 2}}};
}

// Returns a scene whose two objects are bodies; the second one has a ball and a hull for parts.
host::BakedScene scene_of_parts() {
  host::BakedScene scene = testing::small_scene();
  for (host::BakedObject& object : scene.objects) {
    object.motion.moves = true;
    object.body = host::BakedBody{};
    object.body->parts = {
        {.primitive = Primitive{.kind = PrimitiveKind::sphere, .dimensions_m = {0.01}},
         .hull = {}}};
  }
  scene.objects[1].body->parts.push_back({.primitive = std::nullopt, .hull = corner_hull()});
  return scene;
}

// Returns the error after a change to the second part of the second body.
SceneError error_of_part(const std::function<void(host::BakedPart&)>& change) {
  host::BakedScene scene = scene_of_parts();
  change(scene.objects[1].body->parts[1]);
  return testing::error_of(scene);
}

TEST(HostileParts, ThatAreSoundAreRead) {
  const std::vector<std::byte> bytes = host::write_image(scene_of_parts());
  const auto image = SceneImage::open(bytes);
  ASSERT_TRUE(image.has_value());
  ASSERT_EQ(image->body_parts().size(), 3U);
  EXPECT_EQ(image->bodies()[0].part_count, 1U);
  EXPECT_EQ(image->bodies()[1].first_part, 1U);
  EXPECT_EQ(image->bodies()[1].part_count, 2U);
  EXPECT_EQ(image->body_parts()[1].primitive.dimensions_m[0], 0.01);
  EXPECT_EQ(image->body_parts()[2].hull.vertices_O.size(), 4U);
  EXPECT_EQ(image->body_parts()[2].hull.corners[11], 3U);
}

TEST(HostileParts, WithANumberOutOfRangeAreRefused) {
  const std::vector<std::function<void(host::BakedPart&)>> changes{
      [](host::BakedPart& part) { part.hull = {}; },
      [](host::BakedPart& part) { part.hull.vertices[2].y() = std::nan(""); },
      [](host::BakedPart& part) { part.hull.vertices[2].y() = 1e6; },
      [](host::BakedPart& part) { part.hull.vertices.resize(65, Vec3::Zero()); },
      [](host::BakedPart& part) { part.hull.vertices.resize(2); },
      [](host::BakedPart& part) { part.hull.faces[1].normal_O *= 2.0; },
      [](host::BakedPart& part) { part.hull.faces[3].first = 10; },
      [](host::BakedPart& part) { part.hull.faces[3].first = 0xffffffff; },
      [](host::BakedPart& part) { part.hull.faces[3].count = 2; },
      [](host::BakedPart& part) { part.hull.corners[4] = 4; },
      [](host::BakedPart& part) { part.hull.edges[4].to = 4; },
      [](host::BakedPart& part) { part.hull.edges[4].left = 4; },
      [](host::BakedPart& part) {
        part.primitive = Primitive{.kind = PrimitiveKind::sphere, .dimensions_m = {-0.01}};
      },
      [](host::BakedPart& part) {
        part.primitive = Primitive{.kind = PrimitiveKind::torus, .dimensions_m = {0.03, 0.01}};
      },
      [](host::BakedPart& part) { part.primitive = Primitive{.kind = PrimitiveKind::plane}; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const SceneError error = error_of_part(changes[i]);
    EXPECT_EQ(error.fault, SceneFault::body_part) << i;
    EXPECT_EQ(error.object, 1U) << i;
    EXPECT_EQ(error.place, 1U) << i;
  }
}

TEST(HostileParts, MoreThanFitAreRefused) {
  host::BakedScene scene = scene_of_parts();
  const host::BakedPart ball = scene.objects[0].body->parts[0];
  scene.objects[1].body->parts.assign(kMaxPartsOfBody + 1, ball);
  const auto error_of_scene = [](const host::BakedScene& of) {
    const std::vector<std::byte> bytes = host::write_image(of);
    const auto image = SceneImage::open(bytes);
    EXPECT_FALSE(image.has_value());
    return image ? SceneError{} : image.error();
  };
  const SceneError of_body = error_of_scene(scene);
  EXPECT_EQ(of_body.fault, SceneFault::capacity);
  EXPECT_EQ(of_body.exceeded.name, "parts_of_body");
  EXPECT_EQ(of_body.exceeded.count, kMaxPartsOfBody + 1);
  constexpr std::size_t kFull = kMaxBodyParts / kMaxPartsOfBody;
  scene.objects[1].body->parts.assign(kMaxPartsOfBody, ball);
  while (scene.objects.size() <= kFull) {
    scene.objects.push_back(scene.objects[1]);
  }
  const SceneError of_scene = error_of_scene(scene);
  EXPECT_EQ(of_scene.fault, SceneFault::capacity);
  EXPECT_EQ(of_scene.exceeded.name, "body_parts");
  EXPECT_EQ(of_scene.exceeded.count, kFull * kMaxPartsOfBody + 1);
}

}  // namespace
}  // namespace tactus::rendering
