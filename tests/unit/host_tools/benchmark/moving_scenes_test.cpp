#include "host_tools/benchmark/moving_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "rendering/scene/scene_image.h"
#include "rendering/scene/scene_world.h"
#include "rendering/world/world.h"

namespace tactus::host {
namespace {

// The scene has as many moving objects as a world takes, and the tool touches them.
TEST(MovingScenes, FillTheWorldAndAreTouched) {
  constexpr std::size_t kTicks = 1000;
  for (const MovingScene& moving : {swarm("balls", 2, 1.0, kTicks), sheets(kTicks)}) {
    SCOPED_TRACE(moving.name);
    const std::vector<std::byte> bytes = write_image(moving.scene);
    const auto image = rendering::SceneImage::open(bytes);
    ASSERT_TRUE(image.has_value());
    const auto movers = std::ranges::count_if(image->objects(), rendering::is_mover);
    const auto deforming = std::ranges::count_if(image->objects(), &rendering::Object::deforms);
    EXPECT_TRUE(std::cmp_equal(movers, rendering::kMaxMovers) ||
                std::cmp_equal(deforming, rendering::kMaxDeformables));
    const auto world = std::make_unique<rendering::World>();
    ASSERT_TRUE(world->set_scene(image->objects(), {.tool_radius_m = moving.scene.tool_radius_m}));
    ASSERT_EQ(moving.path.size(), kTicks);
    std::size_t contacts = 0;
    for (const Vec3& p : moving.path) {
      contacts += world->touch({.p_W = p}).contact != rendering::ContactKind::none ? 1U : 0U;
    }
    EXPECT_GT(contacts, kTicks / 2);
  }
}

// The needle pierces all layers, comes out of them, and pierces them again.
TEST(MovingScenes, ANeedleGoesThroughFiveLayers) {
  constexpr std::size_t kTicks = 3000;
  const MovingScene moving = layers(kTicks);
  const std::vector<std::byte> bytes = write_image(moving.scene);
  const auto image = rendering::SceneImage::open(bytes);
  ASSERT_TRUE(image.has_value()) << rendering::describe(image.error().fault);
  const auto world = std::make_unique<rendering::World>();
  ASSERT_TRUE(world->set_scene(image->objects(), rendering::world_of(*image)));
  std::vector<std::ptrdiff_t> entered;
  for (const Vec3& p : moving.path) {
    EXPECT_EQ(world->touch({.p_W = p}).flags, rendering::kTouchClean);
    const std::ptrdiff_t in =
        std::ranges::count_if(world->needle().layers(), [](const rendering::NeedleLayer& layer) {
          return layer.phase == rendering::LayerPhase::pierced;
        });
    if (entered.empty() || entered.back() != in) {
      entered.push_back(in);
    }
  }
  EXPECT_EQ(std::ranges::count(entered, 5), 2);
  EXPECT_GE(std::ranges::count(entered, 0), 2);
}

// The wall has as many contact points as its figures are about, and stands.
TEST(MovingScenes, AWallOfBodiesStands) {
  constexpr std::size_t kTicks = 500;
  const MovingScene moving = wall("32 bodies", rendering::kMaxBodies, kTicks);
  const std::vector<std::byte> bytes = write_image(moving.scene);
  const auto image = rendering::SceneImage::open(bytes);
  ASSERT_TRUE(image.has_value()) << rendering::describe(image.error().fault);
  const auto world = std::make_unique<rendering::World>();
  ASSERT_TRUE(world->set_scene(image->objects(), rendering::world_of(*image)));
  std::size_t contacts = 0;
  for (const Vec3& p : moving.path) {
    contacts += world->touch({.p_W = p}).contact != rendering::ContactKind::none ? 1U : 0U;
  }
  EXPECT_GT(contacts, kTicks / 2);
  EXPECT_GT(world->bodies().point_count(), 200U);
  EXPECT_FALSE(world->bodies().has_left_out_contacts());
  for (std::size_t i = 0; i < image->objects().size(); ++i) {
    if (const auto* const brick = world->body(static_cast<std::uint32_t>(i)); brick != nullptr) {
      EXPECT_GT(brick->motion().rotation_WO(1, 1), 0.999) << i;
    }
  }
}

}  // namespace
}  // namespace tactus::host
