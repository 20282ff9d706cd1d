// Bodies from the text of a scene to the world, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "rendering/world/world.h"
#include "tests/unit/host_tools/bake/scene/baked_body_scene.h"

namespace tactus::testing {
namespace {

using rendering::ObjectBody;

const std::string kCube =
    "[[object]]\nname = \"cube\"\nprimitive = \"box\"\nsize_m = [0.04, 0.04, 0.04]\n";

class BodyScene : public BakedBodyScene {
 protected:
  [[nodiscard]] const ObjectBody& body() const { return scene_->image().bodies()[0]; }
};

TEST_F(BodyScene, HasTheMassOfItsDensityOrTheOneThatIsGiven) {
  bake(kCube + "[object.body]\ndensity_kg_per_m3 = 2000.0\n");
  EXPECT_NEAR(body().mass.mass_kg, 2000.0 * 6.4e-5, 1e-12);
  EXPECT_NEAR(body().mass.inertia_C(0, 0), body().mass.mass_kg * 0.0016 / 6.0, 1e-12);
  bake(kCube + "[object.body]\nmass_kg = 0.1\n");
  EXPECT_EQ(body().mass.mass_kg, 0.1);
  EXPECT_NEAR(body().mass.inertia_C(2, 2), 0.1 * 0.0016 / 6.0, 1e-12);
  bake(kCube + "[object.body]\n");
  EXPECT_NEAR(body().mass.mass_kg, 0.064, 1e-12);
}

TEST_F(BodyScene, TurnsWhatIsGivenAlongTheAxesOfTheObject) {
  bake(kCube +
       "position_m = [0.1, 0.2, 0.3]\nrotation = { axis = [0.0, 0.0, 1.0], angle_deg = 90.0 }\n"
       "[object.body]\nmass_kg = 0.1\ninertia_kg_m2 = [1e-4, 2e-4, 2.5e-4]\n"
       "angular_velocity_rad_per_s = [1.0, 0.0, 0.0]\nvelocity_m_per_s = [0.5, 0.0, 0.0]\n");
  EXPECT_NEAR(body().mass.inertia_C(1, 1), 1e-4, 1e-15);
  EXPECT_NEAR(body().mass.inertia_C(0, 0), 2e-4, 1e-15);
  EXPECT_LT((body().mass.center_O - Vec3(0.1, 0.2, 0.3)).norm(), 1e-12);
  EXPECT_LT((body().angular_velocity_O - Vec3(0.0, 1.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((body().velocity_W - Vec3(0.5, 0.0, 0.0)).norm(), 1e-12);
}

TEST_F(BodyScene, FallsAsTheWorldSays) {
  bake("[world]\ngravity_m_per_s2 = [0.0, 0.0, -1.62]\n" + kCube +
       "[object.body]\nmass_kg = 0.1\n");
  const auto world = run(1000);
  const rendering::BodyMotion& motion = world->body(0)->motion();
  EXPECT_NEAR(motion.velocity_W.z(), -1.62, 1e-9);
  EXPECT_NEAR(motion.center_W.z(), -0.81, 1e-3);
  EXPECT_EQ(world->body(1), nullptr);
}

TEST_F(BodyScene, RestsOnATableAndAMeshMeetsItByItsHull) {
  static_cast<void>(
      folder_.write("wedge.off",
                    "OFF\n6 8 0\n0 0 0\n0.04 0 0\n0.04 0 0.04\n0 0 0.04\n0 0.03 0\n0 0.03 0.04\n"
                    "3 0 1 2\n3 0 2 3\n3 0 4 1\n3 3 2 5\n3 0 3 5\n3 0 5 4\n3 1 4 5\n3 1 5 2\n"));
  const host::BakeReport report = bake(
      "[[object]]\nprimitive = \"plane\"\nfriction = { static = 0.5 }\n"
      "[[object]]\nname = \"wedge\"\nmesh = \"wedge.off\"\nscale = 1.0\nposition_m = [0.0, 0.01, "
      "0.0]\n"
      "friction = { static = 0.5 }\n[object.body]\nmass_kg = 0.1\n");
  EXPECT_TRUE(report.objects[1].warnings.empty());
  EXPECT_EQ(body().hull.vertices_O.size(), 6U);
  EXPECT_EQ(body().hull.faces.size(), 5U);
  EXPECT_EQ(body().hull.edges.size(), 9U);
  const auto world = run(1000);
  const rendering::RigidBody& wedge = *world->body(1);
  EXPECT_LT(wedge.motion().velocity_W.norm(), 1e-6);
  EXPECT_NEAR(wedge.motion().center_W.y(), 0.01, 1e-4) << "a third of its height";
}

// A sheet about the origin, of two triangles with their front upward.
constexpr const char* kSheet =
    "OFF\n4 2 0\n-0.1 0 -0.1\n-0.1 0 0.1\n0.1 0 0.1\n0.1 0 -0.1\n3 0 1 2\n3 0 2 3\n";

TEST_F(BodyScene, SaysWhereBodiesAreNotMetByTheirShape) {
  static_cast<void>(folder_.write("sheet.off", kSheet));
  const host::BakeReport report = bake(
      "[[object]]\nname = \"sheet\"\nmesh = \"sheet.off\"\nscale = 1.0\nsides = "
      "\"two\"\ndeforms = true\n"
      "[[object]]\nname = \"ring\"\nprimitive = \"torus\"\nring_radius_m = 0.03\n"
      "tube_radius_m = 0.005\n[object.body]\nmass_kg = 0.05\n");
  ASSERT_FALSE(report.objects[0].warnings.empty());
  EXPECT_TRUE(contains(report.objects[0].warnings[0], "sheet: bodies go through it"));
  ASSERT_FALSE(report.objects[1].warnings.empty());
  EXPECT_TRUE(contains(report.objects[1].warnings[0], "ring: other objects meet its convex hull"));
}

TEST_F(BodyScene, HasNoMoreObstaclesThanBodiesCanMeet) {
  std::string posts;
  for (int i = 0; i < 64; ++i) {
    posts += "[[object]]\nname = \"post_" + std::to_string(i) +
             "\"\nprimitive = \"sphere\"\nradius_m = 0.001\nposition_m = [" +
             std::to_string(0.003 * i) + ", 0.0, 0.0]\n";
  }
  const std::string ball =
      "[[object]]\nprimitive = \"sphere\"\nradius_m = 0.01\nposition_m = [0.0, 0.1, 0.0]\n"
      "[object.body]\n";
  bake(posts + ball);
  static_cast<void>(run(1));
  EXPECT_THROW(bake(posts + "[[object]]\nprimitive = \"plane\"\n" + ball), host::InputError);
}

// Every kind of surface stops a ball: it comes to rest upon it, and not below.
TEST_F(BodyScene, RestsOnEveryKindOfSurface) {
  static_cast<void>(folder_.write("sheet.off", kSheet));
  for (const std::string& floor :
       {std::string("primitive = \"plane\"\n"),
        std::string("mesh = \"sheet.off\"\nscale = 1.0\n"
                    "sides = \"two\"\n"),
        std::string("primitive = \"cylinder\"\nradius_m = 0.05\nheight_m = 0.02\n"
                    "position_m = [0.0, -0.01, 0.0]\n"),
        std::string(
            "formula = \"y\"\nscale = 0.1\nbounds = [-1.0, -1.0, -1.0, 1.0, 1.0, 1.0]\n")}) {
    bake("[[object]]\nname = \"floor\"\n" + floor +
         "friction = { static = 0.5 }\n"
         "[[object]]\nname = \"ball\"\nprimitive = \"sphere\"\nradius_m = 0.01\n"
         "position_m = [0.0, 0.02, 0.0]\nfriction = { static = 0.5 }\n[object.body]\n");
    const auto world = run(500);
    EXPECT_NEAR(world->body(1)->motion().center_W.y(), 0.01, 2e-5) << floor;
  }
}

TEST_F(BodyScene, SaysHowSoftTheFingersAre) {
  bake(kCube + "[object.body]\n");
  EXPECT_EQ(rendering::world_of(scene_->image()).soft_finger_modulus_Pa, 0.0);
  bake("[tool]\nsoft_finger_modulus_Pa = 5e4\n" + kCube + "[object.body]\n");
  EXPECT_EQ(rendering::world_of(scene_->image()).soft_finger_modulus_Pa, 5e4);
  static_cast<void>(run(1));
  const auto refusal = [](const std::string& keys) {
    return body_refused("[tool]\n" + keys + kCube + "[object.body]\n");
  };
  EXPECT_TRUE(contains(refusal("radius_m = 0.0\nsoft_finger_modulus_Pa = 5e4\n"),
                       "scene.toml:3: [tool]: a tool of radius 0 touches in a point"));
  EXPECT_TRUE(contains(refusal("soft_finger_modulus_Pa = 0.05\n"), "is it in megapascals"));
  EXPECT_TRUE(contains(refusal("soft_finger_modulus_Pa = -1.0\n"), "scene.toml:2: "));
  EXPECT_TRUE(contains(refusal("soft_finger_modulus_kPa = 50.0\n"),
                       "write soft_finger_modulus_Pa = 50000"));
}

TEST_F(BodyScene, RollsToAStopWhereItResistsRolling) {
  bake(
      "[[object]]\nprimitive = \"plane\"\nfriction = { static = 0.5 }\n"
      "[[object]]\nname = \"ball\"\nprimitive = \"sphere\"\nradius_m = 0.02\n"
      "position_m = [0.0, 0.02, 0.0]\nfriction = { static = 0.5 }\n[object.body]\n"
      "velocity_m_per_s = [0.1, 0.0, 0.0]\nangular_velocity_rad_per_s = [0.0, 0.0, -5.0]\n"
      "rolling_friction_m = 1e-3\nspinning_friction_m = 2e-3\n");
  EXPECT_EQ(body().rolling_friction_m, 1e-3);
  EXPECT_EQ(body().spinning_friction_m, 2e-3);
  const double stop_m =
      0.1 * 0.1 / (2.0 * 5.0 / 7.0 * rendering::kStandardGravity_m_per_s2 * 1e-3 / 0.02);
  const auto world = run(600);
  EXPECT_NEAR(world->body(1)->motion().center_W.x(), stop_m, 0.01 * stop_m);
  EXPECT_TRUE(contains(body_refused(kCube + "[object.body]\nrolling_friction_m = 2.0\n"),
                       "scene.toml:6: "));
  EXPECT_TRUE(contains(body_refused(kCube + "[object.body]\nspinning_friction_mm = 2.0\n"),
                       "write spinning_friction_m = 0.002"));
}

TEST_F(BodyScene, FallsAsleepWhereTheWorldSaysSo) {
  const std::string table = "[[object]]\nprimitive = \"plane\"\n";
  bake(table + kCube + "position_m = [0.0, 0.02, 0.0]\n[object.body]\n");
  EXPECT_FALSE(run(800)->bodies().is_asleep(0));
  bake("[world]\nsleep_after_s = 0.3\n" + table + kCube +
       "position_m = [0.0, 0.02, 0.0]\n[object.body]\n");
  EXPECT_TRUE(run(800)->bodies().is_asleep(0));
  EXPECT_TRUE(contains(body_refused("[world]\nsleep_after_s = 0.001\n" + kCube),
                       "scene.toml:2: [world]: bodies fall asleep after 0.001 s"));
  EXPECT_TRUE(contains(body_refused("[world]\nsleep_after_ms = 300\n" + kCube),
                       "write sleep_after_s = 0.3"));
}

TEST_F(BodyScene, RefusesWhatCannotBeABody) {
  EXPECT_TRUE(contains(
      body_refused(kCube + "motion = { spin_rad_per_s = [0.0, 1.0, 0.0] }\n[object.body]\n"),
      "a body moves by forces"));
  EXPECT_TRUE(contains(body_refused(kCube + "moves = false\n[object.body]\n"), "moves is false"));
  EXPECT_TRUE(contains(body_refused(kCube + "contact = \"potential_field\"\n[object.body]\n"),
                       "a body is touched by"));
  EXPECT_TRUE(
      contains(body_refused(kCube + "[object.body]\nmass_kg = 1.0\ndensity_kg_per_m3 = 1.0\n"),
               "say the same"));
  EXPECT_TRUE(
      contains(body_refused(kCube + "[object.body]\nrestitution = 1.5\n"), "1 is the most"));
  EXPECT_TRUE(contains(body_refused(kCube + "[object.body]\nmass = 1.0\n"), "mass_kg"));
  const std::string flat =
      kCube + "[object.body]\nmass_kg = 0.1\ninertia_kg_m2 = [1e-4, 1e-4, 3e-4]\n";
  EXPECT_TRUE(contains(input_error([&] { bake(flat); }), "scene.toml:5: cube: "));
  const std::string plane = "[[object]]\nprimitive = \"plane\"\n[object.body]\nmass_kg = 1.0\n";
  EXPECT_TRUE(contains(input_error([&] { bake(plane); }), "scene.toml:3: plane: "));
}

}  // namespace
}  // namespace tactus::testing
