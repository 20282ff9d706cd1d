// Images whose checksum is right and whose content is not: only our own limits stand between them
// and the controller.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/scene/scene_generated.h"
#include "rendering/scene/scene_image.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::rendering {
namespace {

constexpr float kNoFloat = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t kFarAway = 0x7fffffff;

SceneError error_of(const host::BakedScene& scene) {
  const std::vector<std::byte> bytes = host::write_image(scene);
  const auto image = SceneImage::open(bytes);
  EXPECT_FALSE(image.has_value());
  return image ? SceneError{} : image.error();
}

// The error after a change to the second object's mesh.
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
  for (const std::size_t bad : {std::size_t{0}, kMaxTools + 1}) {
    host::BakedScene scene = testing::small_scene();
    scene.tool_count = bad;
    const SceneError error = error_of(scene);
    EXPECT_EQ(error.fault, SceneFault::tool_count);
    EXPECT_EQ(error.place, bad);
  }
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

// The error after a change to a good texture of 2 x 2 texels on the second object.
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
  EXPECT_EQ(error_of(scene).fault, SceneFault::effect_count);
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

// A law by its name and numbers; none without a name.
struct RawLaw {
  const char* name = nullptr;
  std::vector<double> numbers;
};

// One triangle, with what the writer cannot be made to write.
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
  expect_refused(raw_image(kMaxObjects + 1, image::Sides::two, kCone), SceneFault::object_count,
                 kMaxObjects + 1);
}

TEST(HostileImage, OfNoiseIsMalformed) {
  std::vector<std::byte> bytes = host::write_image(testing::small_scene());
  std::fill(bytes.begin() + sizeof(ImageHeader), bytes.end(), std::byte{0xa5});
  testing::seal(bytes);
  expect_refused(bytes, SceneFault::malformed, 0);
}

// Walks the way the controller does, trusting everything; counts the triangles met.
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

// The address sanitizer shows here if a check is missing.
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
