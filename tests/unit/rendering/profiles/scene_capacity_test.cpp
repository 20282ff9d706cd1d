// Scenes that fill one capacity of the build's profile, and scenes that exceed it by one.
#include "rendering/profiles/scene_capacity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/limits.h"
#include "rendering/world/world.h"
#include "tests/support/shapes.h"
#include "tests/support/solid.h"
#include "tests/unit/rendering/needle/needle_bench.h"

namespace tactus::rendering {
namespace {

// A scene with the storage of its parts.
struct CrowdedScene {
  std::vector<Object> objects;
  std::vector<ObjectBody> bodies;
  std::vector<BodyPart> parts;
  std::vector<Effect> effects;
  std::vector<Tissue> tissues;
  std::vector<Float3> vertices;
  std::vector<BvhNode> nodes;
  std::size_t tools = 1;

  [[nodiscard]] WorldConfig config() const {
    return {.tool_count = tools,
            .effects = effects,
            .bodies = bodies,
            .body_parts = parts,
            .needle = {.needle = {.length_m = 0.1}, .tissues = tissues}};
  }
};

Object crowd_ball() {
  Object ball;
  ball.surface = SurfaceKind::primitive;
  ball.primitive = {.kind = PrimitiveKind::sphere, .dimensions_m = {0.01}};
  return ball;
}

Object moving_ball() {
  Object ball = crowd_ball();
  ball.moves = true;
  return ball;
}

// Adds a body with so many parts.
void add_body(CrowdedScene& scene, std::size_t parts) {
  scene.objects.push_back(moving_ball());
  scene.objects.back().body = static_cast<std::uint8_t>(scene.bodies.size());
  scene.bodies.push_back({.first_part = static_cast<std::uint32_t>(scene.parts.size()),
                          .part_count = static_cast<std::uint32_t>(parts)});
  scene.parts.resize(scene.parts.size() + parts, {.hull = {}, .primitive = crowd_ball().primitive});
}

const testing::Solid& small_mesh() {
  static const testing::Solid mesh(testing::box({0.01, 0.01, 0.01}), Sides::two, Material{});
  return mesh;
}

Object deforming_mesh() {
  Object mesh = small_mesh().object();
  mesh.deforms = true;
  return mesh;
}

// The makers of scenes that have `count` of one capacity, and of the others as few as it takes.
struct CrowdMaker {
  std::string_view capacity;
  CrowdedScene (*make)(std::size_t count);
};

constexpr std::array kCrowdMakers{
    CrowdMaker{"objects",
               [](std::size_t count) {
                 return CrowdedScene{.objects = std::vector(count, crowd_ball())};
               }},
    CrowdMaker{
        "tools",
        [](std::size_t count) { return CrowdedScene{.objects = {crowd_ball()}, .tools = count}; }},
    CrowdMaker{"effects",
               [](std::size_t count) {
                 const Effect spring{.law = Spring{.stiffness_N_per_m = 1.0}, .max_force_N = 1.0};
                 return CrowdedScene{.objects = {crowd_ball()},
                                     .effects = std::vector(count, spring)};
               }},
    CrowdMaker{"bodies",
               [](std::size_t count) {
                 CrowdedScene scene;
                 for (std::size_t i = 0; i < count; ++i) {
                   add_body(scene, 0);
                 }
                 return scene;
               }},
    CrowdMaker{"parts_of_body",
               [](std::size_t count) {
                 CrowdedScene scene;
                 add_body(scene, count);
                 return scene;
               }},
    CrowdMaker{"body_parts",
               [](std::size_t count) {
                 CrowdedScene scene;
                 while (scene.parts.size() < count) {
                   add_body(scene, std::min(kMaxPartsOfBody, count - scene.parts.size()));
                 }
                 return scene;
               }},
    CrowdMaker{"tissues",
               [](std::size_t count) {
                 CrowdedScene scene{.tissues = std::vector(count, balanced_tissue())};
                 for (std::size_t i = 0; i < count; ++i) {
                   scene.objects.push_back(tissue_block(0.0, i));
                 }
                 return scene;
               }},
    CrowdMaker{"movers",
               [](std::size_t count) {
                 return CrowdedScene{.objects = std::vector(count, moving_ball())};
               }},
    CrowdMaker{"independent_objects",
               [](std::size_t count) {
                 Object field = crowd_ball();
                 field.method = ContactMethod::potential_field;
                 return CrowdedScene{.objects = std::vector(count, field)};
               }},
    CrowdMaker{"deformables",
               [](std::size_t count) {
                 return CrowdedScene{.objects = std::vector(count, deforming_mesh())};
               }},
    CrowdMaker{"deformable_vertices",
               [](std::size_t count) {
                 CrowdedScene scene{.objects = {deforming_mesh()}};
                 MeshView& mesh = scene.objects.front().mesh;
                 scene.vertices.assign(mesh.vertices.begin(), mesh.vertices.end());
                 scene.vertices.resize(count, mesh.vertices.back());
                 mesh.vertices = scene.vertices;
                 return scene;
               }},
    CrowdMaker{"deformable_nodes",
               [](std::size_t count) {
                 CrowdedScene scene{.objects = {deforming_mesh()}};
                 MeshView& mesh = scene.objects.front().mesh;
                 scene.nodes.assign(mesh.nodes.begin(), mesh.nodes.end());
                 scene.nodes.resize(count, mesh.nodes.back());
                 mesh.nodes = scene.nodes;
                 return scene;
               }},
    CrowdMaker{"obstacles",
               [](std::size_t count) {
                 CrowdedScene scene{.objects = std::vector(count, crowd_ball())};
                 add_body(scene, 0);
                 return scene;
               }},
};

class CapacityTest : public ::testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] static const SceneCapacity& capacity() { return kSceneCapacities.at(GetParam()); }
  // Returns a scene with so many more than the profile has room for.
  [[nodiscard]] static CrowdedScene scene_with(std::size_t more) {
    const auto* const maker =
        std::ranges::find(kCrowdMakers, capacity().name, &CrowdMaker::capacity);
    EXPECT_NE(maker, kCrowdMakers.end());
    return maker->make(kProfile.*capacity().limit + more);
  }

  std::unique_ptr<WorldOf<kMaxTools>> world_ = std::make_unique<WorldOf<kMaxTools>>();
};

TEST_P(CapacityTest, ThatIsFullIsEnough) {
  const CrowdedScene scene = scene_with(0);
  const SceneCounts counts = scene_counts(scene.objects, scene.config());
  EXPECT_EQ(counts.*capacity().count, kProfile.*capacity().limit);
  EXPECT_FALSE(first_exceeded(counts, kProfile).has_value());
  EXPECT_TRUE(world_->set_scene(scene.objects, scene.config()));
}

TEST_P(CapacityTest, ThatIsExceededByOneIsNamedAloneAndTheSceneRefused) {
  const CrowdedScene scene = scene_with(1);
  const SceneCounts counts = scene_counts(scene.objects, scene.config());
  for (const SceneCapacity& other : kSceneCapacities) {
    EXPECT_EQ(exceeded(other, counts, kProfile).has_value(), other.name == capacity().name)
        << other.name;
  }
  const ExceededCapacity found = first_exceeded(counts, kProfile).value_or(ExceededCapacity{});
  EXPECT_EQ(found.name, capacity().name);
  EXPECT_EQ(found.noun, capacity().noun);
  EXPECT_EQ(found.limit, kProfile.*capacity().limit);
  EXPECT_EQ(found.count, found.limit + 1);
  EXPECT_FALSE(world_->set_scene(scene.objects, scene.config()));
  EXPECT_EQ(world_->object_count(), 0U);
}

INSTANTIATE_TEST_SUITE_P(OfAScene, CapacityTest,
                         ::testing::Range(std::size_t{0}, kSceneCapacities.size()),
                         [](const auto& at) {
                           return std::string(kSceneCapacities.at(at.param).name);
                         });

TEST(ExceededWords, NameTheNumbersTheProfileAndTheSmallestThatHasRoom) {
  std::array<char, 256> room{};
  const auto words_for = [&](std::size_t count) {
    return std::string(
        exceeded_words({.name = "objects", .noun = "objects", .count = count, .limit = 16}, room));
  };
  const std::string fit = " objects, where 16 fit (profile " + std::string(kProfile.name) + ")";
  EXPECT_EQ(words_for(17), "17" + fit +
                               "; leave some out, or build this program with "
                               "-D TACTUS_PROFILE=board");
  EXPECT_EQ(words_for(1024), "1024" + fit +
                                 "; leave some out, or build this program with "
                                 "-D TACTUS_PROFILE=desktop");
  EXPECT_EQ(words_for(1025), "1025" + fit +
                                 "; leave some out, or raise objects in a header of "
                                 "rendering/profiles and build again");
  EXPECT_EQ(exceeded_words({.name = "tools", .noun = "tools", .count = 2, .limit = 1},
                           std::span(room).first(21)),
            "2 tools, where 1 fits");
}

TEST(Profiles, HaveRoomForEverySceneOfASmallerOne) {
  for (std::size_t i = 1; i < kProfiles.size(); ++i) {
    for (const SceneCapacity& capacity : kSceneCapacities) {
      EXPECT_LE(kProfiles.at(i).*capacity.limit, kProfiles.at(i - 1).*capacity.limit)
          << kProfiles.at(i).name << ": " << capacity.name;
    }
  }
}

// A recording of a board is then replayed to the same bits on a desktop.
TEST(Profiles, OfABoardAndADesktopDifferInWhatTheyRefuseAlone) {
  EXPECT_EQ(kBoardProfile.candidates, kDesktopProfile.candidates);
  EXPECT_EQ(kBoardProfile.body_contacts, kDesktopProfile.body_contacts);
  EXPECT_EQ(kBoardProfile.near_triangles, kDesktopProfile.near_triangles);
}

TEST(Profiles, WithASizeLeftOutOrOutOfItsBoundsAreNotSound) {
  EXPECT_TRUE(is_sound(kDesktopProfile));
  EXPECT_FALSE(is_sound({.name = "empty"}));
  const auto is_sound_with = [](std::size_t CapacityProfile::* size, std::size_t value) {
    CapacityProfile profile = kDesktopProfile;
    profile.*size = value;
    return is_sound(profile);
  };
  EXPECT_FALSE(is_sound_with(&CapacityProfile::movers, 255));
  EXPECT_FALSE(is_sound_with(&CapacityProfile::bodies, 255));
  EXPECT_FALSE(is_sound_with(&CapacityProfile::candidates, 510));
  EXPECT_FALSE(is_sound_with(&CapacityProfile::flight_ticks, 1000));
  EXPECT_FALSE(is_sound_with(&CapacityProfile::waiting_commands, 0));
  EXPECT_FALSE(is_sound_with(&CapacityProfile::waiting_answers, 60));
  EXPECT_FALSE(is_sound_with(&CapacityProfile::waiting_answers, 16));
  for (const SceneCapacity& capacity : kSceneCapacities) {
    EXPECT_FALSE(is_sound_with(capacity.limit, 0)) << capacity.name;
  }
}

}  // namespace
}  // namespace tactus::rendering
