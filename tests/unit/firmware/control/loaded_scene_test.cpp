#include "firmware/control/loaded_scene.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

constexpr rendering::Material kSoft = {
    .stiffness_N_per_m = 500.0, .damping_Ns_per_m = 0.0, .friction = {}};

// A floor at y = 0, with the tool 4 mm deep in it.
class LoadedSceneTest : public ::testing::Test {
 protected:
  LoadedSceneTest() {
    scene_->restart(0.001, 2e6);
    EXPECT_TRUE(scene_->load(floor_.objects(), {.tool_radius_m = 0.0}));
    scene_->world.touch({.p_W = {0.01, 0.05, 0.02}});
    EXPECT_NEAR(force_N(), 2.0, 1e-3);
  }

  double force_N() { return scene_->world.touch({.p_W = {0.01, -0.004, 0.02}}).force_W.y(); }
  static StiffnessCertificate up_to(double stiffness_N_per_m) {
    StiffnessCertificate certificate{.count = 1};
    certificate.points[0] = {.damping_Ns_per_m = 0.0, .stiffness_N_per_m = stiffness_N_per_m};
    return certificate;
  }

  Floor floor_{kSoft};
  std::unique_ptr<LoadedScene> scene_ = std::make_unique<LoadedScene>();
};

TEST_F(LoadedSceneTest, AChangeOfAMaterialTakesSmallSteps) {
  rendering::Material stiff = kSoft;
  stiff.stiffness_N_per_m = 1000.0;
  ASSERT_TRUE(scene_->change_material(0, stiff));
  EXPECT_EQ(scene_->wanted(0).stiffness_N_per_m, 1000.0);
  double before_N = force_N();
  EXPECT_NEAR(before_N, 2.0, 1e-3) << "no step at the beginning";
  int ticks = 1;
  for (; scene_->advance_changes(0.1, 0.0); ++ticks) {
    const double now_N = force_N();
    EXPECT_LE(now_N - before_N, 0.1 + 1e-9);
    before_N = now_N;
  }
  EXPECT_NEAR(ticks, 20, 1);
  EXPECT_NEAR(force_N(), 4.0, 1e-3);
}

TEST_F(LoadedSceneTest, ARestartCompletesTheChanges) {
  rendering::Material stiff = kSoft;
  stiff.stiffness_N_per_m = 1000.0;
  ASSERT_TRUE(scene_->change_material(0, stiff));
  scene_->restart(0.001, 2e6);
  EXPECT_EQ(scene_->world.material(0).stiffness_N_per_m, 1000.0);
  EXPECT_FALSE(scene_->changes.any());
}

TEST_F(LoadedSceneTest, TheCertificateCountsWhatAMaterialWillBe) {
  const SafetyConfig safety;
  EXPECT_FALSE(scene_->first_refused(up_to(600.0), safety));
  rendering::Material stiff = kSoft;
  stiff.stiffness_N_per_m = 700.0;
  EXPECT_FALSE(
      scene_->is_certified(up_to(600.0), safety, 0, stiff, rendering::ContactMethod::sphere_proxy));
  EXPECT_EQ(scene_->refused_part.stiffness_N_per_m, 700.0);
  EXPECT_TRUE(
      scene_->is_certified(up_to(800.0), safety, 0, stiff, rendering::ContactMethod::sphere_proxy));
  ASSERT_TRUE(scene_->change_material(0, stiff));
  EXPECT_TRUE(scene_->first_refused(up_to(600.0), safety)) << "the change has only begun";
}

TEST_F(LoadedSceneTest, ARefusedSceneLeavesNone) {
  const double no_radius_m = -1.0;
  EXPECT_FALSE(scene_->load(floor_.objects(), {.tool_radius_m = no_radius_m}));
  EXPECT_TRUE(scene_->objects.empty());
  EXPECT_EQ(force_N(), 0.0);
}

TEST(FreeTouch, IsAtTheToolAndFinite) {
  const rendering::ToolState tool{.p_W = {1.0, 2.0, 3.0}};
  rendering::Touch touch = free_touch(tool);
  EXPECT_EQ(touch.proxy_W, tool.p_W);
  EXPECT_TRUE(is_finite(touch));
  touch.parts.texture_W.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_finite(touch));
}

}  // namespace
}  // namespace tactus::firmware
