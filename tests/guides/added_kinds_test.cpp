// Bakes and touches a scene with the friction model, the effect and the primitive that run.sh has
// added to a copy of the tree by the guides, and reads a device with the added mechanism.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "firmware/configuration/config_state.h"
#include "host_tools/bake/device/device_bake.h"
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
[object.friction]
model = "hess_soom"
static = 0.6
dynamic = 0.3
stribeck_velocity_m_per_s = 0.05
viscous_s_per_m = 0.2

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

// ---- the mechanism

constexpr const char* kDevice = R"(name = "added"
[mechanism]
kind = "planar_arm"
outer_m = 0.09
[controller]
rate_hz = 500
[[connection]]
name = "bus"
kind = "can"
interface = "can3"
[[axis]]
name = "inner drive"
driver = "odrive_can"
connection = "bus"
node_id = 5
max_torque_Nm = 0.25
[[axis]]
name = "outer drive"
driver = "odrive_can"
connection = "bus"
node_id = 6
max_torque_Nm = 0.25
[[joint]]
name = "inner"
motor = "inner drive"
motor_ratio = 4.0
encoder_ratio = 4.0
reference = "known_pose"
reference_rad = 0.0
[[joint]]
name = "outer"
motor = "outer drive"
motor_ratio = 4.0
encoder_ratio = 4.0
reference = "known_pose"
reference_rad = 1.57
)";

class AddedMechanism : public ::testing::Test {
 protected:
  host::LoadedDevice loaded(const std::string& text) {
    return host::bake_device(folder_.write("device.toml", text));
  }
  std::string complaint(const std::string& old_part, const std::string& part) {
    std::string text = kDevice;
    text.replace(text.find(old_part), old_part.size(), part);
    return input_error([&] { (void)loaded(text); });
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(AddedMechanism, IsReadFromADeviceAndMovesTheTool) {
  const host::LoadedDevice device = loaded(kDevice);
  const firmware::ControllerConfig& config = device.config().controller;
  EXPECT_EQ(joint_count(config.mechanism), 2U);
  const firmware::Mechanism mechanism(config.mechanism);
  const firmware::Pose pose = mechanism.forward({0.3, 1.4, 0.0}, Vec3::Zero());
  EXPECT_EQ(pose.status, firmware::kPoseGood);
  const Vec3 tool(0.1 * std::cos(0.3) + 0.09 * std::cos(1.4), 0.0,
                  0.1 * std::sin(0.3) + 0.09 * std::sin(1.4));
  EXPECT_LT((pose.p_D - tool).norm(), 1e-15);
  const Vec3 by_inner(-0.1 * std::sin(0.3), 0.0, 0.1 * std::cos(0.3));
  EXPECT_LT((pose.jacobian_D.col(0) - by_inner).norm(), 1e-15);
}

TEST_F(AddedMechanism, IsKeptInRecordings) {
  const host::LoadedDevice device = loaded(kDevice);
  std::array<std::byte, firmware::kMaxConfigBytes> bytes{};
  const std::size_t size = save_config(device.config().controller, bytes);
  firmware::ControllerConfig again;
  ASSERT_TRUE(read_config(std::span(bytes).first(size), again));
  EXPECT_EQ(std::get<firmware::PlanarArmGeometry>(again.mechanism).outer_m, 0.09);
}

TEST_F(AddedMechanism, AWrongKeyIsAdvisedAndAValueOutOfRangeRefused) {
  EXPECT_TRUE(contains(complaint("outer_m", "outer_mm"), "outer_m"));
  EXPECT_TRUE(contains(complaint("outer_m = 0.09", "outer_m = 2.0"), "outer_m"));
  EXPECT_TRUE(contains(complaint("\"planar_arm\"", "\"planar\""), "\"planar_arm\""));
}

}  // namespace
}  // namespace tactus::testing
