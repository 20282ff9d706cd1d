// Bakes and touches a scene with the friction model, the effect and the primitive that run.sh has
// added to a copy of the tree by the guides, and reads a device with the added mechanism.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/scene/scene_world.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::testing {
namespace {

constexpr const char* kScene = R"(
[tool]
radius_m = 0.005

[[object]]
name = "table"
primitive = "plane"
stiffness_N_per_m = 1000.0
friction = { model = "hess_soom", static = 0.6, dynamic = 0.3, stribeck_velocity_m_per_s = 0.05,
             viscous_s_per_m = 0.2 }

[[object]]
name = "puck"
primitive = "puck"
radius_m = 0.03
edge_radius_m = 0.01
position_m = [0.2, 0.1, 0.0]
stiffness_N_per_m = 500.0

[[effect]]
law = "detents"
direction = [0.0, 0.0, 2.0]
amplitude_N = 0.5
pitch_m = 0.02
max_force_N = 3.0
)";

class AddedKinds : public ::testing::Test {
 protected:
  host::MappedScene baked(const std::string& text) {
    host::bake_file(folder_.write("scene.toml", text), folder_.path() / "scene.tactus");
    return host::MappedScene(folder_.path() / "scene.tactus");
  }
  // Returns the error of baking the scene with one part of its text changed.
  std::string complaint(const std::string& old_part, const std::string& part) {
    std::string text = kScene;
    text.replace(text.find(old_part), old_part.size(), part);
    return input_error([&] { baked(text); });
  }
  void take(const rendering::SceneImage& scene) {
    ASSERT_TRUE(world_->set_scene(scene.objects(), rendering::world_of(scene)));
  }
  rendering::Touch touch(const Vec3& p_W) { return world_->touch({.p_W = p_W}); }

  std::unique_ptr<rendering::World> world_ = std::make_unique<rendering::World>();

 private:
  TemporaryFolder folder_;
};

TEST_F(AddedKinds, TheFrictionModelIsFelt) {
  const host::MappedScene scene = baked(kScene);
  take(scene.image());
  constexpr double kTick_s = 1e-3;  // the world's
  for (const double speed : {0.01, 0.05, 0.2}) {
    touch({0.0, 0.02, 0.0});
    rendering::Touch felt;
    for (int i = 0; i < 400; ++i) {
      felt = touch({speed * kTick_s * i, 0.003, 0.0});
    }
    const double ratio = speed / 0.05;
    const double level = 0.3 + 0.3 / (1.0 + ratio * ratio) + 0.2 * speed;
    EXPECT_NEAR(felt.force_W.y(), 2.0, 0.01);
    EXPECT_NEAR(-felt.force_W.x() / felt.force_W.y(), level, 1e-4) << speed;
  }
}

TEST_F(AddedKinds, TheEffectIsFeltAndPaysBackWhatItStores) {
  const host::MappedScene scene = baked(kScene);
  take(scene.image());
  const rendering::Effect& effect = scene.image().effects()[0];
  for (const double z : {0.0, 0.003, 0.005, 0.017, -0.004}) {
    const Vec3 p_W(0.0, 0.05, z);
    const double angle = 2.0 * std::numbers::pi * z / 0.02;
    EXPECT_NEAR(touch(p_W).force_W.z(), -0.5 * std::sin(angle), 1e-12);
    EXPECT_NEAR(stored_J(effect, {}, p_W),
                0.5 * 0.02 / (2.0 * std::numbers::pi) * (1.0 - std::cos(angle)), 1e-12);
  }
  EXPECT_NEAR(steepest(effect).stiffness_N_per_m, 0.5 * 2.0 * std::numbers::pi / 0.02, 1e-9);
}

TEST_F(AddedKinds, ThePrimitiveIsFeltAndSeen) {
  const host::MappedScene scene = baked(kScene);
  take(scene.image());
  const rendering::Object& puck = scene.image().objects()[1];
  const auto height = [&](const Vec3& p_O) {
    return sample(puck.primitive, Vec3(0.2, 0.1, 0.0) + p_O).distance_m;
  };
  EXPECT_DOUBLE_EQ(height({0.0, 0.03, 0.0}), 0.02);
  EXPECT_NEAR(height({0.034, -0.003, 0.0}), 0.005 - 0.01, 1e-15);
  EXPECT_NEAR(height({0.0, 0.0, 0.06}), 0.02, 1e-15);
  EXPECT_NEAR(bounds(puck.primitive).upper_W.x(), 0.24, 1e-15);
  // On top, 1 mm deep under a tool of 5 mm.
  touch({0.2, 0.13, 0.0});
  EXPECT_NEAR(touch({0.2, 0.114, 0.0}).force_W.y(), 0.5, 1e-3);
  EXPECT_GT(puck.mesh.triangles.size(), 1000U);
  for (const rendering::Float3& vertex : puck.mesh.vertices) {
    ASSERT_NEAR(sample(puck.primitive, rendering::to_vec3(vertex)).distance_m, 0.0, 1e-5);
  }
}

TEST_F(AddedKinds, AWrongKeyIsAdvised) {
  EXPECT_TRUE(contains(complaint("pitch_m", "pitch"), "did you mean pitch_m (metres)?"));
  EXPECT_TRUE(contains(complaint("edge_radius_m", "edge_radus_m"), "did you mean edge_radius_m"));
  EXPECT_TRUE(contains(complaint("viscous_s_per_m", "elastic_fraction"),
                       "model \"hess_soom\" has no elastic_fraction"));
}

TEST_F(AddedKinds, AValueOutOfRangeIsRefused) {
  EXPECT_TRUE(contains(complaint("pitch_m = 0.02", "pitch_m = 0.0"), "pitch_m"));
  EXPECT_TRUE(
      contains(complaint("edge_radius_m = 0.01", "edge_radius_m = -0.01"), "edge_radius_m"));
  EXPECT_TRUE(contains(complaint("static = 0.6", "static = 0.2"), "dynamic (0.3) is above static"));
  EXPECT_TRUE(contains(complaint("edge_radius_m = 0.01", ""), "a puck needs edge_radius_m"));
}

}  // namespace
}  // namespace tactus::testing
