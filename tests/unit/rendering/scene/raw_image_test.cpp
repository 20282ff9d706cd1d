// Images that the writer cannot be made to write.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/scene/scene_generated.h"
#include "rendering/scene/scene_image.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::rendering {
namespace {

// A law by its name and numbers; there is none without a name.
struct RawLaw {
  const char* name = nullptr;
  std::vector<double> numbers;
};

// Returns an image of triangles, one an object, with these numbers in it.
std::vector<std::byte> raw_image(std::size_t objects, image::Sides sides, std::uint8_t model,
                                 const RawLaw& law = {}) {
  flatbuffers::FlatBufferBuilder builder;
  const std::vector<image::Float3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<image::Triple> triangles{{0, 1, 2}};
  const std::vector<image::Triple> neighbours{{kNoNeighbour, kNoNeighbour, kNoNeighbour}};
  const std::vector<image::Node> nodes{{{0, 0, 0}, 0, {1, 1, 0}, 1}};
  const image::BakeCounters counters;
  std::vector<flatbuffers::Offset<image::Object>> list;
  for (std::size_t i = 0; i < objects; ++i) {
    const auto mesh = image::CreateMeshDirect(builder, &vertices, &triangles, &neighbours, &nodes,
                                              &vertices, &counters);
    const image::Friction friction(model, 0.5, 0.5, 0.0, 1e-3, 2.0, 0.0, 0.0, 0.0, 1e-3, 0.7);
    const auto material = image::CreateMaterial(builder, 1.0, 0.0, &friction);
    list.push_back(image::CreateObjectDirect(builder, "raw", sides, material, mesh));
  }
  std::vector<flatbuffers::Offset<image::Effect>> effects;
  if (law.name != nullptr) {
    const auto named = image::CreateNamedLawDirect(builder, law.name, &law.numbers).Union();
    effects.push_back(image::CreateEffect(builder, image::Law::NamedLaw, named, 1.0));
  }
  image::FinishSceneBuffer(builder, image::CreateSceneDirect(builder, 0.0, &list, 1, &effects));
  ImageHeader header;
  header.payload_bytes = builder.GetSize();
  std::vector<std::byte> bytes(sizeof(header) + builder.GetSize());
  std::memcpy(bytes.data(), &header, sizeof(header));
  std::memcpy(bytes.data() + sizeof(header), builder.GetBufferPointer(), builder.GetSize());
  testing::seal(bytes);
  return bytes;
}

void expect_refused(const std::vector<std::byte>& bytes, SceneFault fault, std::uint64_t place) {
  const auto image = SceneImage::open(bytes);
  ASSERT_FALSE(image.has_value());
  EXPECT_EQ(image.error().fault, fault);
  EXPECT_EQ(image.error().place, place);
}

TEST(HostileImage, WithUnknownSidesOrFrictionIsRefused) {
  constexpr auto kCone = std::uint8_t{std::to_underlying(FrictionKind::cone)};
  EXPECT_TRUE(SceneImage::open(raw_image(1, image::Sides::two, kCone)).has_value());
  expect_refused(raw_image(1, static_cast<image::Sides>(2), kCone), SceneFault::sides, 2);
  expect_refused(raw_image(1, image::Sides::two, 9), SceneFault::friction_model, 9);
}

std::vector<std::byte> image_with(const RawLaw& law) {
  return raw_image(1, image::Sides::two, 0, law);
}

TEST(HostileImage, MayStoreALawByItsNameAndNumbers) {
  const std::vector<std::byte> bytes =
      image_with({.name = "magnet", .numbers = {0.1, 0.2, 0.3, -2.0, 0.02}});
  const auto image = SceneImage::open(bytes);
  ASSERT_TRUE(image.has_value());
  const auto& magnet = std::get<Magnet>(image->effects()[0].law);
  EXPECT_EQ(magnet.pole_W, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(magnet.strength_N, -2.0);
  EXPECT_EQ(magnet.core_m, 0.02);
}

TEST(HostileImage, WithAnUnknownLawIsRefusedWithItsName) {
  const auto image = SceneImage::open(image_with({.name = "tractor\nbeam", .numbers = {1.0}}));
  ASSERT_FALSE(image.has_value());
  EXPECT_EQ(image.error().fault, SceneFault::effect_law);
  EXPECT_EQ(host::explain(image.error()),
            "effect 0: \"tractor?beam\": effect has a law that this program does not know; update "
            "the program");
}

TEST(HostileImage, WithTheWrongNumbersOfALawIsRefused) {
  expect_refused(image_with({.name = "magnet", .numbers = {0, 0, 0, 2.0}}), SceneFault::effect, 0);
  expect_refused(image_with({.name = "magnet", .numbers = {0, 0, 0, 2.0, 0.0}}), SceneFault::effect,
                 0);
  expect_refused(image_with({.name = "spring", .numbers = std::vector<double>(1000, 1.0)}),
                 SceneFault::effect, 0);
}

TEST(HostileImage, WithNoneOrTooManyObjectsIsRefused) {
  constexpr auto kCone = std::uint8_t{std::to_underlying(FrictionKind::cone)};
  EXPECT_TRUE(SceneImage::open(raw_image(kMaxObjects, image::Sides::two, kCone)).has_value());
  expect_refused(raw_image(0, image::Sides::two, kCone), SceneFault::object_count, 0);
  const auto crowded = SceneImage::open(raw_image(kMaxObjects + 1, image::Sides::two, kCone));
  ASSERT_FALSE(crowded.has_value());
  EXPECT_TRUE(host::explain(crowded.error())
                  .starts_with(std::to_string(kMaxObjects + 1) + " objects, where " +
                               std::to_string(kMaxObjects) + " fit (profile " +
                               std::string(kProfile.name) + "); leave some out, or "))
      << host::explain(crowded.error());
}

TEST(HostileImage, OfNoiseIsMalformed) {
  std::vector<std::byte> bytes = host::write_image(testing::small_scene());
  std::fill(bytes.begin() + sizeof(ImageHeader), bytes.end(), std::byte{0xa5});
  testing::seal(bytes);
  expect_refused(bytes, SceneFault::malformed, 0);
}

}  // namespace
}  // namespace tactus::rendering
