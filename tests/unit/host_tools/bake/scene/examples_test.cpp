// Every example that needs no foreign file can be baked and touched.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/scene/scene_world.h"
#include "rendering/world/world.h"
#include "tests/support/example_scenes.h"
#include "tests/support/paths.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::testing {
namespace {

host::MappedScene baked(const TemporaryFolder& folder, const char* example) {
  const std::filesystem::path image = folder.path() / "scene.tactus";
  host::bake_file(in_repository("host_tools/examples/" + std::string(example) + "/scene.toml"),
                  image);
  return host::MappedScene(image);
}

class Examples : public ::testing::TestWithParam<const char*> {};

TEST_P(Examples, AreBakedAndFelt) {
  const TemporaryFolder folder;
  const host::MappedScene scene = baked(folder, GetParam());
  // The tool goes from above each object down through its middle and must feel it on the way.
  for (std::uint32_t i = 0; i < scene.image().objects().size(); ++i) {
    const auto world = std::make_unique<rendering::WorldOf<rendering::kMaxTools>>();
    rendering::WorldConfig config = rendering::world_of(scene.image());
    config.tool_count = scene.image().tool_count();
    ASSERT_TRUE(world->set_scene(scene.image().objects(), config));
    const rendering::BvhNode& box = scene.image().objects()[i].mesh.nodes.front();
    const double x = 0.5 * static_cast<double>(box.lower.x + box.upper.x) + 1e-4;
    const double z = 0.5 * static_cast<double>(box.lower.z + box.upper.z) + 2e-4;
    const auto top = static_cast<double>(box.upper.y) + 0.01;
    const auto bottom = static_cast<double>(box.lower.y);
    double hardest = 0.0;
    for (double y = top; y > bottom; y -= 2e-4) {
      const rendering::Touch touch = world->touch({.p_W = {x, y, z}});
      ASSERT_TRUE(touch.force_W.allFinite());
      if (touch.contact != rendering::ContactKind::none && touch.object == i) {
        hardest = std::max(hardest, touch.force_W.norm());
      }
    }
    // The ring of the primitives is met beside its hole only.
    EXPECT_TRUE(hardest > 0.01 || scene.image().object_name(i) == "ring")
        << scene.image().object_name(i);
  }
}

TEST(ExamplesTogether, HaveEveryContactMethodPrimitiveAndDetail) {
  const TemporaryFolder folder;
  std::set<rendering::ContactMethod> methods;
  std::set<rendering::PrimitiveKind> primitives;
  std::set<rendering::TextureUse> textures;
  bool shaded = false;
  for (const char* name : kExampleScenes) {
    const host::MappedScene scene = baked(folder, name);
    for (const rendering::Object& object : scene.image().objects()) {
      methods.insert(object.method);
      if (object.surface == rendering::SurfaceKind::primitive) {
        primitives.insert(object.primitive.kind);
      }
      for (const rendering::TextureLayer& layer : object.detail.layers) {
        textures.insert(layer.use);
      }
      shaded = shaded || !object.detail.corner_normals.empty();
    }
  }
  EXPECT_EQ(methods.size(), 5U);
  EXPECT_EQ(primitives.size(), 7U);
  EXPECT_EQ(textures.size(), rendering::kTextureUses);
  EXPECT_TRUE(shaded);
}

INSTANTIATE_TEST_SUITE_P(OfTheRepository, Examples, ::testing::ValuesIn(kExampleScenes),
                         [](const auto& example) { return std::string(example.param); });

}  // namespace
}  // namespace tactus::testing
