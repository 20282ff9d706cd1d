// Bodies of several convex parts from the text of a scene to the world.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>

#include "rendering/world/world.h"
#include "tests/unit/host_tools/bake/scene/baked_body_scene.h"

namespace tactus::testing {
namespace {

using rendering::BodyPart;
using rendering::PrimitiveKind;

const std::string kDumbbell =
    "[[object]]\nname = \"dumbbell\"\nprimitive = \"capsule\"\nradius_m = 0.005\n"
    "height_m = 0.06\n";
const std::string kDumbbellBody = kDumbbell + "[object.body]\nmass_kg = 0.1\n";
const std::string kBallPart = "[[object.body.part]]\nprimitive = \"sphere\"\nradius_m = 0.01\n";
// A wedge of 0.04 m x 0.03 m x 0.04 m, and the same without its bottom.
constexpr const char* kClosedWedge =
    "OFF\n6 8 0\n0 0 0\n0.04 0 0\n0.04 0 0.04\n0 0 0.04\n0 0.03 0\n0 0.03 0.04\n"
    "3 0 1 2\n3 0 2 3\n3 0 4 1\n3 3 2 5\n3 0 3 5\n3 0 5 4\n3 1 4 5\n3 1 5 2\n";
constexpr const char* kOpenWedge =
    "OFF\n6 6 0\n0 0 0\n0.04 0 0\n0.04 0 0.04\n0 0 0.04\n0 0.03 0\n0 0.03 0.04\n"
    "3 0 4 1\n3 3 2 5\n3 0 3 5\n3 0 5 4\n3 1 4 5\n3 1 5 2\n";

class BodyPartsScene : public BakedBodyScene {
 protected:
  [[nodiscard]] std::span<const BodyPart> parts() const { return scene_->image().body_parts(); }
};

TEST_F(BodyPartsScene, PlacesThePartsInTheFrameOfTheObject) {
  bake(kDumbbell +
       "position_m = [0.1, 0.2, 0.3]\nrotation = { axis = [0.0, 0.0, 1.0], angle_deg = 90.0 }\n"
       "[object.body]\n" +
       kBallPart + "position_m = [0.0, 0.03, 0.0]\n" +
       "[[object.body.part]]\nprimitive = \"box\"\nsize_m = [0.02, 0.04, 0.06]\n"
       "position_m = [0.01, 0.0, 0.0]\n"
       "rotation = { axis = [0.0, 0.0, 1.0], angle_deg = -90.0 }\n");
  ASSERT_EQ(parts().size(), 2U);
  EXPECT_EQ(parts()[0].primitive.kind, PrimitiveKind::sphere);
  EXPECT_LT((parts()[0].primitive.X_WO.translation - Vec3(0.07, 0.2, 0.3)).norm(), 1e-12);
  EXPECT_EQ(parts()[1].primitive.kind, PrimitiveKind::box);
  EXPECT_LT((parts()[1].primitive.X_WO.translation - Vec3(0.1, 0.21, 0.3)).norm(), 1e-12);
  EXPECT_LT((parts()[1].primitive.X_WO.rotation - Mat3::Identity()).norm(), 1e-12);
  EXPECT_EQ(scene_->image().bodies()[0].part_count, 2U);
}

TEST_F(BodyPartsScene, LeavesTheMassToTheObjectsOwnShape) {
  bake(kDumbbell + "[object.body]\n");
  const rendering::BodyMass own = scene_->image().bodies()[0].mass;
  bake(kDumbbell + "[object.body]\n" + kBallPart + "position_m = [0.0, 0.03, 0.0]\n");
  EXPECT_EQ(scene_->image().bodies()[0].mass.mass_kg, own.mass_kg);
  EXPECT_EQ(scene_->image().bodies()[0].mass.center_O, own.center_O);
  EXPECT_EQ(scene_->image().bodies()[0].mass.inertia_C, own.inertia_C);
}

// A dumbbell lies on its balls: its own rod would lie lower.
TEST_F(BodyPartsScene, MeetsOthersByThePartsAlone) {
  bake("[[object]]\nprimitive = \"plane\"\nfriction = { static = 0.5 }\n" + kDumbbell +
       "position_m = [0.0, 0.011, 0.0]\n"
       "rotation = { axis = [0.0, 0.0, 1.0], angle_deg = 90.0 }\nfriction = { static = 0.5 }\n"
       "[object.body]\nmass_kg = 0.1\nrolling_friction_m = 1e-3\n" +
       kBallPart + "position_m = [0.0, 0.03, 0.0]\n" + kBallPart +
       "position_m = [0.0, -0.03, 0.0]\n");
  const auto world = run(500);
  EXPECT_NEAR(world->body(1)->motion().center_W.y(), 0.01, 2e-5);
}

TEST_F(BodyPartsScene, TakesTheHullOfAPartsMesh) {
  static_cast<void>(folder_.write("wedge.off", kOpenWedge));
  const host::BakeReport report = bake(kDumbbellBody +
                                       "[[object.body.part]]\nmesh = \"wedge.off\"\nscale = 2.0\n"
                                       "position_m = [0.0, 0.1, 0.0]\n");
  ASSERT_EQ(parts().size(), 1U);
  EXPECT_EQ(parts()[0].hull.vertices_O.size(), 6U);
  EXPECT_EQ(parts()[0].hull.faces.size(), 5U);
  EXPECT_EQ(parts()[0].hull.edges.size(), 9U);
  double highest = 0.0;
  for (const Vec3& vertex : parts()[0].hull.vertices_O) {
    highest = std::max(highest, vertex.y());
  }
  EXPECT_NEAR(highest, 0.16, 1e-6);
  EXPECT_TRUE(report.objects[0].warnings.empty());
}

// Parts say nothing about the mass; a closed mesh does, or three keys.
TEST_F(BodyPartsScene, AsksForTheMassOfAMeshThatIsOpen) {
  static_cast<void>(folder_.write("open.off", kOpenWedge));
  static_cast<void>(folder_.write("closed.off", kClosedWedge));
  const auto wedge = [](const std::string& file, const std::string& keys) {
    return "[[object]]\nname = \"wedge\"\nmesh = \"" + file +
           "\"\nsides = \"two\"\nposition_m = [0.0, 0.5, 0.0]\n[object.body]\n" + keys + kBallPart;
  };
  bake(wedge("closed.off", ""));
  EXPECT_NEAR(scene_->image().bodies()[0].mass.mass_kg, 1000.0 * 0.5 * 0.04 * 0.03 * 0.04, 1e-6);
  const std::string refused = input_error([&] { bake(wedge("open.off", "mass_kg = 0.1\n")); });
  EXPECT_TRUE(contains(refused, "scene.toml:6: wedge: ")) << refused;
  EXPECT_TRUE(contains(refused, "write mass_kg, center_of_mass_m and inertia_kg_m2")) << refused;
  bake(wedge("open.off",
             "mass_kg = 0.1\ncenter_of_mass_m = [0.01, 0.02, 0.0]\n"
             "inertia_kg_m2 = [1e-5, 1e-5, 1e-5]\n"));
  const rendering::BodyMass& mass = scene_->image().bodies()[0].mass;
  EXPECT_EQ(mass.mass_kg, 0.1);
  EXPECT_LT((mass.center_O - Vec3(0.01, 0.52, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(mass.inertia_C(1, 1), 1e-5, 1e-15);
  EXPECT_TRUE(contains(body_refused(kDumbbellBody + "center_of_mass_m = [0.0, 0.0, 0.0]\n"),
                       "scene.toml:8: object 1 body: the inertia is about the centre of mass"));
}

TEST_F(BodyPartsScene, RefusesMorePartsThanFit) {
  const auto balls = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
      text += kBallPart;
    }
    return text;
  };
  bake(kDumbbellBody + balls(16));
  EXPECT_TRUE(contains(body_refused(kDumbbellBody + balls(17)),
                       "object 1 body: 17 parts, where 16 fit a body"));
  std::string many;
  for (int i = 0; i < 9; ++i) {
    many += "[[object]]\nname = \"ball_" + std::to_string(i) +
            "\"\nprimitive = \"sphere\"\nradius_m = 0.01\nposition_m = [0.0, " +
            std::to_string(0.1 * i) + ", 0.0]\n[object.body]\n" + balls(i < 8 ? 16 : 1);
  }
  EXPECT_TRUE(contains(input_error([&] { bake(many); }), "129 parts, where 128 fit a scene"));
}

TEST_F(BodyPartsScene, RefusesWhatIsNoPart) {
  const auto refusal = [](const std::string& part) {
    return body_refused(kDumbbellBody + "[[object.body.part]]\n" + part);
  };
  EXPECT_TRUE(contains(refusal("primitive = \"torus\"\nring_radius_m = 0.03\n"
                               "tube_radius_m = 0.005\n"),
                       "scene.toml:9: object 1 body part 1: a part is convex and has a volume"));
  EXPECT_TRUE(contains(refusal("primitive = \"plane\"\n"), "which a plane is not"));
  EXPECT_TRUE(contains(refusal("primitive = \"ball\"\n"), "no primitive \"ball\""));
  EXPECT_TRUE(contains(refusal("primitive = \"box\"\nsize_m = [0.1, 0.0, 0.1]\n"),
                       "the box's dimensions must be above 0"));
  EXPECT_TRUE(contains(refusal("position_m = [0.0, 0.0, 0.0]\n"), "write one of the two"));
  EXPECT_TRUE(contains(refusal("primitive = \"sphere\"\nradius_m = 0.01\nmesh = \"a.off\"\n"),
                       "write one of the two"));
  EXPECT_TRUE(
      contains(refusal("primitive = \"sphere\"\nradius_mm = 10.0\n"), "write radius_m = 0.01"));
  EXPECT_TRUE(
      contains(refusal("primitive = \"sphere\"\nradius_m = 0.01\nmass_kg = 1.0\n"), "mass_kg"));
  EXPECT_TRUE(contains(refusal("primitive = \"sphere\"\nradius_m = 0.01\nscale = 2.0\n"),
                       "scale is for the mesh of a part"));
  EXPECT_TRUE(contains(body_refused(kDumbbellBody + "[object.body.part]\nprimitive = \"box\"\n"),
                       "write [[object.body.part]], with two brackets"));
}

TEST_F(BodyPartsScene, RefusesAPartsMeshThatIsMissingOrHasNoVolume) {
  const std::string text = kDumbbellBody + "[[object.body.part]]\nmesh = \"part.off\"\n";
  EXPECT_TRUE(contains(input_error([&] { bake(text); }), "scene.toml:9: there is no mesh file"));
  static_cast<void>(folder_.write(
      "part.off",
      "OFF\n4 2 0\n-0.1 0 -0.1\n-0.1 0 0.1\n0.1 0 0.1\n0.1 0 -0.1\n3 0 1 2\n3 0 2 3\n"));
  const std::string flat = input_error([&] { bake(text); });
  EXPECT_TRUE(contains(flat, "scene.toml:9: dumbbell part 1: ")) << flat;
  EXPECT_TRUE(contains(flat, "plane")) << flat;
}

}  // namespace
}  // namespace tactus::testing
