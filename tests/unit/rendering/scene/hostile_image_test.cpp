// Images whose checksum is right and whose content is not: only our own limits stand between them
// and the controller.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "rendering/scene/scene_image.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::rendering {
namespace {

constexpr float kNoFloat = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t kFarAway = 0x7fffffff;

using testing::error_of;

// Returns the error after a change to the second object's mesh.
template <class Change>
SceneError error_after(Change change) {
  host::BakedScene scene = testing::small_scene();
  change(scene.objects[1].mesh);
  const SceneError error = error_of(scene);
  EXPECT_EQ(error.object, 1U);
  return error;
}

TEST(HostileImage, WithAVertexThatIsNotFiniteIsRefused) {
  const SceneError error =
      error_after([](host::BakedMesh& mesh) { mesh.vertices[2].y = kNoFloat; });
  EXPECT_EQ(error.fault, SceneFault::vertex_not_finite);
  EXPECT_EQ(error.place, 2U);
}

TEST(HostileImage, WithANormalThatIsNotFiniteIsRefused) {
  const SceneError error =
      error_after([](host::BakedMesh& mesh) { mesh.vertex_normals[3].z = INFINITY; });
  EXPECT_EQ(error.fault, SceneFault::normal_not_finite);
  EXPECT_EQ(error.place, 3U);
}

TEST(HostileImage, WithAVertexIndexOutOfRangeIsRefused) {
  const SceneError error = error_after([](host::BakedMesh& mesh) { mesh.triangles[1][2] = 4; });
  EXPECT_EQ(error.fault, SceneFault::vertex_index);
  EXPECT_EQ(error.place, 1U);
}

TEST(HostileImage, WithANeighbourOutOfRangeIsRefused) {
  const SceneError error = error_after([](host::BakedMesh& mesh) { mesh.neighbours[0][1] = 4; });
  EXPECT_EQ(error.fault, SceneFault::neighbour_index);
  EXPECT_EQ(error.place, 0U);
}

TEST(HostileImage, WithANeighbourThatDoesNotKnowItIsRefused) {
  const SceneError error = error_after([](host::BakedMesh& mesh) {
    mesh.neighbours[2] = {kNoNeighbour, kNoNeighbour, kNoNeighbour};
  });
  EXPECT_EQ(error.fault, SceneFault::neighbour_index);
}

TEST(HostileImage, WithoutTrianglesIsRefused) {
  const SceneError error = error_after([](host::BakedMesh& mesh) {
    mesh.triangles.clear();
    mesh.neighbours.clear();
  });
  EXPECT_EQ(error.fault, SceneFault::empty_mesh);
}

TEST(HostileImage, WithoutNodesIsRefused) {
  EXPECT_EQ(error_after([](host::BakedMesh& mesh) { mesh.nodes.clear(); }).fault,
            SceneFault::empty_mesh);
}

TEST(HostileImage, WithTooFewNormalsOrNeighboursIsRefused) {
  EXPECT_EQ(error_after([](host::BakedMesh& mesh) { mesh.vertex_normals.pop_back(); }).fault,
            SceneFault::array_sizes);
  EXPECT_EQ(error_after([](host::BakedMesh& mesh) { mesh.neighbours.pop_back(); }).fault,
            SceneFault::array_sizes);
}

TEST(HostileImage, WithALeafBeyondTheTrianglesIsRefused) {
  EXPECT_EQ(error_after([](host::BakedMesh& mesh) { mesh.nodes[0].triangle_count = 5; }).fault,
            SceneFault::hierarchy_cover);
  EXPECT_EQ(error_after([](host::BakedMesh& mesh) { mesh.nodes[0].first = kFarAway; }).fault,
            SceneFault::hierarchy_cover);
}

TEST(HostileImage, WithABoxThatIsTooSmallOrNotFiniteIsRefused) {
  EXPECT_EQ(error_after([](host::BakedMesh& mesh) {
              mesh.nodes[0].upper.x = std::nextafter(mesh.nodes[0].upper.x, 0.0F);
            }).fault,
            SceneFault::hierarchy_box);
  EXPECT_EQ(error_after([](host::BakedMesh& mesh) { mesh.nodes[0].lower.z = kNoFloat; }).fault,
            SceneFault::hierarchy_box);
  EXPECT_EQ(error_after([](host::BakedMesh& mesh) { mesh.nodes[0].lower.y = -INFINITY; }).fault,
            SceneFault::hierarchy_box);
}

TEST(HostileImage, WithABadMaterialIsRefused) {
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) {
    for (double Material::* field : {&Material::stiffness_N_per_m, &Material::damping_Ns_per_m}) {
      host::BakedScene scene = testing::small_scene();
      scene.objects[0].material.*field = bad;
      EXPECT_EQ(error_of(scene).fault, SceneFault::material);
    }
    host::BakedScene scene = testing::small_scene();
    scene.objects[0].material.friction.coulomb = bad;
    EXPECT_EQ(error_of(scene).fault, SceneFault::material);
  }
  host::BakedScene scene = testing::small_scene();
  scene.objects[0].material.friction = cone_friction(0.2, 0.3);
  EXPECT_EQ(error_of(scene).fault, SceneFault::material) << "dynamic above static";
}

TEST(HostileImage, WithABadToolRadiusIsRefused) {
  for (const double bad : {-0.001, 1.001, 1e165, std::nan(""), HUGE_VAL}) {
    host::BakedScene scene = testing::small_scene();
    scene.tool_radius_m = bad;
    EXPECT_EQ(error_of(scene).fault, SceneFault::tool_radius);
  }
}

TEST(HostileImage, WithABadToolCountIsRefused) {
  host::BakedScene scene = testing::small_scene();
  scene.tool_count = 0;
  EXPECT_EQ(error_of(scene).fault, SceneFault::tool_count);
  scene.tool_count = kMaxTools + 1;
  const SceneError error = error_of(scene);
  EXPECT_EQ(error.fault, SceneFault::capacity);
  EXPECT_EQ(error.exceeded.name, "tools");
  EXPECT_EQ(error.exceeded.count, kMaxTools + 1);
}

TEST(HostileImage, WithTooFewCornerNormalsOrPlacesIsRefused) {
  EXPECT_EQ(error_after([](host::BakedMesh& mesh) { mesh.corner_normals.resize(3); }).fault,
            SceneFault::corner_normals);
  EXPECT_EQ(error_after([](host::BakedMesh& mesh) { mesh.corner_places.resize(5); }).fault,
            SceneFault::corner_places);
}

TEST(HostileImage, WithATexturePlaceOutOfRangeIsRefused) {
  for (const float bad : {kNoFloat, INFINITY, -2e6F}) {
    const SceneError error = error_after([&](host::BakedMesh& mesh) {
      mesh.corner_places.resize(mesh.triangles.size());
      mesh.corner_places[2][1][0] = bad;
    });
    EXPECT_EQ(error.fault, SceneFault::corner_places);
    EXPECT_EQ(error.place, 2U);
  }
}

// Returns the error after a change to a good texture of 2 x 2 texels on the second object.
template <class Change>
SceneError texture_error(Change change) {
  host::BakedScene scene = testing::small_scene();
  host::BakedTextures& textures = scene.objects[1].textures;
  textures.layers = {{.width = 2, .height = 2, .tile_m = 0.01}};
  textures.texels.resize(5);
  EXPECT_TRUE(SceneImage::open(host::write_image(scene)).has_value());
  change(textures);
  return error_of(scene);
}

TEST(HostileImage, WithABadTextureIsRefused) {
  const auto refused = [](const std::function<void(TextureLayer&)>& change) {
    const SceneError error =
        texture_error([&](host::BakedTextures& textures) { change(textures.layers.front()); });
    EXPECT_EQ(error.fault, SceneFault::texture);
    EXPECT_EQ(error.object, 1U);
    EXPECT_EQ(error.place, 0U);
  };
  refused([](TextureLayer& layer) { layer.use = static_cast<TextureUse>(4); });
  refused([](TextureLayer& layer) { layer.projection = static_cast<TextureProjection>(5); });
  refused([](TextureLayer& layer) { layer.projection = TextureProjection::uv; });
  refused([](TextureLayer& layer) { layer.format = static_cast<TextureFormat>(2); });
  refused([](TextureLayer& layer) { layer.format = TextureFormat::rgb; });
  refused([](TextureLayer& layer) { layer.width = 0; });
  refused([](TextureLayer& layer) { layer.height = 0xffffffff; });
  refused([](TextureLayer& layer) { layer.first_byte = 1; });
  refused([](TextureLayer& layer) { layer.first_byte = 0xffffffff; });
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    refused([bad](TextureLayer& layer) { layer.tile_m = bad; });
  }
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) {
    refused([bad](TextureLayer& layer) { layer.low = bad; });
    refused([bad](TextureLayer& layer) { layer.high = bad; });
  }
}

TEST(HostileImage, WithTwoTexturesOfOneKindIsRefused) {
  const SceneError error = texture_error(
      [](host::BakedTextures& textures) { textures.layers.push_back(textures.layers.front()); });
  EXPECT_EQ(error.fault, SceneFault::texture);
  EXPECT_EQ(error.place, 1U);
}

TEST(HostileImage, WithABadEffectIsRefused) {
  const Effect good{.law = Spring{.stiffness_N_per_m = 1.0}, .max_force_N = 1.0};
  const auto refused = [&](const Effect& bad) {
    host::BakedScene scene = testing::small_scene();
    scene.effects = {good, bad};
    const SceneError error = error_of(scene);
    EXPECT_EQ(error.fault, SceneFault::effect);
    EXPECT_EQ(error.place, 1U);
  };
  refused({.law = good.law, .max_force_N = std::nan("")});
  refused({.law = Spring{.stiffness_N_per_m = -1.0}, .max_force_N = 1.0});
  refused({.law = Vibration{.direction_W = {1.0, 1.0, 0.0}}, .max_force_N = 1.0});
  refused({.law = FluidDrag{.volume = {.dimensions_m = {-1.0}}}, .max_force_N = 1.0});
  host::BakedScene scene = testing::small_scene();
  scene.effects.assign(kMaxEffects + 1, good);
  EXPECT_EQ(error_of(scene).fault, SceneFault::capacity);
  EXPECT_EQ(error_of(scene).exceeded.name, "effects");
}

TEST(HostileImage, WithABadNeedleOrTissueIsRefused) {
  host::BakedScene scene = testing::small_scene();
  scene.needle = Needle{.length_m = 0.1};
  scene.objects[1].tissue = Tissue{.cutting_force_N = 1.0};
  EXPECT_TRUE(SceneImage::open(host::write_image(scene)).has_value());
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) {
    scene.needle->length_m = bad;
    EXPECT_EQ(error_of(scene).fault, SceneFault::needle);
  }
  scene.needle = Needle{.axis_W = Vec3::Ones(), .length_m = 0.1};
  EXPECT_EQ(error_of(scene).fault, SceneFault::needle);
  scene.needle = Needle{.length_m = 0.1};
  const auto refused = [&](const Tissue& bad) {
    scene.objects[1].tissue = bad;
    const SceneError error = error_of(scene);
    EXPECT_EQ(error.fault, SceneFault::tissue);
    EXPECT_EQ(error.object, 1U);
  };
  refused({.puncture_force_N = 1.0});
  refused({.cutting_force_N = std::nan("")});
  refused({.cutting_force_N = 0.1, .toughness_J_per_m2 = 200.0});
  refused({.in = {.static_N_per_m = 1.0, .dynamic_N_per_m = 2.0}});
  refused({.shaft_stiffness_N_per_m2 = 0.0});
  refused({.residual_m = 1e-3});
}

}  // namespace
}  // namespace tactus::rendering
