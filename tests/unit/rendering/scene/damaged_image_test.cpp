// Images with random damage, whose checksum is right. The address sanitizer shows where a check is
// missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "rendering/material/surface_detail.h"
#include "rendering/scene/scene_image.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::rendering {
namespace {

// Walks through a hierarchy as the controller does, trusting everything. Returns the number of
// triangles met.
std::size_t walk(const MeshView& mesh, std::uint32_t index, std::size_t level) {
  EXPECT_LE(level, kMaxHierarchyDepth);
  const BvhNode& node = mesh.nodes[index];
  if (!node.is_leaf()) {
    return walk(mesh, node.first, level + 1) + walk(mesh, node.first + 1, level + 1);
  }
  for (const TriangleIndices& triangle : mesh.triangles.subspan(node.first, node.triangle_count)) {
    for (const std::uint32_t vertex : triangle) {
      EXPECT_LT(vertex, mesh.vertices.size());
      EXPECT_LE(node.lower.x, mesh.vertices[vertex].x);
      EXPECT_GE(node.upper.x, mesh.vertices[vertex].x);
    }
  }
  return node.triangle_count;
}

bool valid_effect(const Effect& effect) {
  return valid(effect);
}

// Feels the textures of a triangle's middle, trusting everything.
bool is_felt(const Object& object, std::uint32_t triangle) {
  const MeshView& mesh = object.mesh;
  Vec3 middle = Vec3::Zero();
  for (const std::uint32_t vertex : mesh.triangles[triangle]) {
    middle += to_vec3(mesh.vertices[vertex]) / 3.0;
  }
  const Detail felt = detail_at(object.detail, {mesh, object.neighbours, object.vertex_normals},
                                {.triangle = triangle, .point_O = middle, .travel_m = 1e-4});
  return felt.height_m <= 0.0;
}

TEST(HostileImage, OfRandomDamageIsRefusedOrSafeToWalk) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(::testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  const std::vector<std::byte> sound = host::write_image(testing::detailed_scene());
  std::uniform_int_distribution<std::size_t> place(sizeof(ImageHeader), sound.size() - 1);
  std::uniform_int_distribution<unsigned> value(0, 255);
  std::uniform_int_distribution<int> changes(1, 4);
  const int rounds = std::max(5'000, testing::share_of(50'000));
  int opened = 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::byte> bytes = sound;
    for (int i = changes(random); i > 0; --i) {
      bytes[place(random)] = static_cast<std::byte>(value(random));
    }
    testing::seal(bytes);
    const auto image = SceneImage::open(bytes);
    if (!image) {
      continue;
    }
    ++opened;
    ASSERT_TRUE(std::ranges::all_of(image->effects(), valid_effect));
    for (const Object& object : image->objects()) {
      ASSERT_EQ(walk(object.mesh, 0, 1), object.mesh.triangles.size());
      ASSERT_TRUE(is_felt(object, 0));
    }
  }
  EXPECT_GT(opened, 0) << "damage to padding and coefficients should pass";
}

}  // namespace
}  // namespace tactus::rendering
