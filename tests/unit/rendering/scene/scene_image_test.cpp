#include "rendering/scene/scene_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::rendering {
namespace {

using testing::error_of;
using testing::small_scene;

bool operator==(const BvhNode& a, const BvhNode& b) {
  return a.lower == b.lower && a.first == b.first && a.upper == b.upper &&
         a.triangle_count == b.triangle_count;
}

template <class Field>
void overwrite(std::vector<std::byte>& image, std::size_t offset, Field value) {
  std::memcpy(image.data() + offset, &value, sizeof(value));
}

TEST(SceneImage, GivesBackWhatWasBaked) {
  const host::BakedScene scene = small_scene();
  const std::vector<std::byte> bytes = host::write_image(scene);
  const auto image = SceneImage::open(bytes);
  ASSERT_TRUE(image.has_value());
  EXPECT_EQ(image->version(), kFormatVersion);
  EXPECT_EQ(image->tool_radius_m(), scene.tool_radius_m);
  ASSERT_EQ(image->objects().size(), scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const host::BakedObject& baked = scene.objects[i];
    const Object& object = image->objects()[i];
    EXPECT_EQ(image->object_name(i), baked.name);
    EXPECT_EQ(object.sides, baked.sides);
    EXPECT_EQ(object.material.stiffness_N_per_m, baked.material.stiffness_N_per_m);
    EXPECT_EQ(object.material.damping_Ns_per_m, baked.material.damping_Ns_per_m);
    EXPECT_EQ(object.material.friction.static_level, baked.material.friction.static_level);
    EXPECT_EQ(object.material.friction.coulomb, baked.material.friction.coulomb);
    EXPECT_TRUE(std::ranges::equal(object.mesh.vertices, baked.mesh.vertices));
    EXPECT_TRUE(std::ranges::equal(object.mesh.triangles, baked.mesh.triangles));
    EXPECT_TRUE(std::ranges::equal(object.mesh.nodes, baked.mesh.nodes,
                                   [](const BvhNode& a, const BvhNode& b) { return a == b; }));
    EXPECT_TRUE(std::ranges::equal(image->baked_mesh(i).neighbours, baked.mesh.neighbours));
    EXPECT_TRUE(std::ranges::equal(image->baked_mesh(i).vertex_normals, baked.mesh.vertex_normals));
    EXPECT_EQ(image->counters(i), baked.mesh.counters);
  }
}

TEST(SceneImage, UsesTheBytesInPlaceWithSiblingNodesInOneCacheLine) {
  const std::vector<std::byte> bytes = host::write_image(small_scene());
  const auto image = SceneImage::open(bytes);
  ASSERT_TRUE(image.has_value());
  for (const Object& object : image->objects()) {
    const void* nodes = object.mesh.nodes.data();
    const auto offset = static_cast<const std::byte*>(nodes) - bytes.data();
    EXPECT_GE(offset, 0);
    EXPECT_LT(offset, static_cast<std::ptrdiff_t>(bytes.size()));
    EXPECT_EQ(offset % 64, 32) << "node 1 starts a cache line";
  }
}

TEST(SceneImage, GivesTheSameBytesForTheSameScene) {
  EXPECT_EQ(host::write_image(small_scene()), host::write_image(small_scene()));
}

TEST(SceneImage, RefusesEverySingleFlippedBit) {
  std::vector<std::byte> bytes = host::write_image(small_scene());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const std::byte mask{static_cast<unsigned char>(1U << (bit % 8))};
    bytes[bit / 8] ^= mask;
    ASSERT_FALSE(SceneImage::open(bytes).has_value()) << "bit " << bit;
    bytes[bit / 8] ^= mask;
  }
  EXPECT_TRUE(SceneImage::open(bytes).has_value());
}

TEST(SceneImage, RefusesEveryTruncation) {
  const std::vector<std::byte> bytes = host::write_image(small_scene());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const SceneError error = error_of(std::span(bytes).first(size));
    ASSERT_EQ(error.fault, SceneFault::truncated) << size << " bytes";
    ASSERT_EQ(error.place, size);
  }
}

TEST(SceneImage, SaysWhichByteOfTheMagicNumberDiffers) {
  std::vector<std::byte> bytes = host::write_image(small_scene());
  overwrite(bytes, 6, '\n');  // what a text-mode transfer makes of a carriage return
  const SceneError error = error_of(bytes);
  EXPECT_EQ(error.fault, SceneFault::wrong_magic);
  EXPECT_EQ(error.place, 6U);
}

TEST(SceneImage, TellsNewerFromOlderVersions) {
  std::vector<std::byte> bytes = host::write_image(small_scene());
  overwrite(bytes, offsetof(ImageHeader, version), kFormatVersion + 1);
  EXPECT_EQ(error_of(bytes).fault, SceneFault::newer_version);
  EXPECT_EQ(error_of(bytes).place, kFormatVersion + 1);
  overwrite(bytes, offsetof(ImageHeader, version), kFormatVersion - 1);
  EXPECT_EQ(error_of(bytes).fault, SceneFault::older_version);
}

TEST(SceneImage, RefusesBytesAfterTheEnd) {
  std::vector<std::byte> bytes = host::write_image(small_scene());
  const std::size_t end = bytes.size();
  bytes.push_back(std::byte{0});
  EXPECT_EQ(error_of(bytes).fault, SceneFault::trailing_bytes);
  EXPECT_EQ(error_of(bytes).place, end);
}

TEST(SceneImage, RefusesAStatedSizeBeyondTheFormat) {
  std::vector<std::byte> bytes = host::write_image(small_scene());
  overwrite(bytes, offsetof(ImageHeader, payload_bytes), ~std::uint64_t{0});
  EXPECT_EQ(error_of(bytes).fault, SceneFault::too_large);
}

TEST(SceneImage, RefusesBytesThatAreNotAligned) {
  const std::vector<std::byte> bytes = host::write_image(small_scene());
  std::vector<std::byte> room(bytes.size() + 8);
  std::ranges::copy(bytes, room.begin() + 8);
  EXPECT_EQ(error_of(std::span(room).subspan(8)).fault, SceneFault::misaligned);
}

TEST(SceneImage, ReportsAChangedPayloadAsChecksumMismatch) {
  std::vector<std::byte> bytes = host::write_image(small_scene());
  bytes.back() ^= std::byte{1};
  EXPECT_EQ(error_of(bytes).fault, SceneFault::checksum_mismatch);
}

TEST(SceneError, HasADescriptionForEveryFault) {
  for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(SceneFault::effect_law); ++i) {
    EXPECT_FALSE(describe(static_cast<SceneFault>(i)).empty());
  }
  EXPECT_EQ(place_noun(SceneFault::vertex_index), "triangle");
  EXPECT_EQ(place_noun(SceneFault::hierarchy_box), "node");
}

}  // namespace
}  // namespace tactus::rendering
