// Scenes of primitives and formulas, from the text to the touch.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/world/world.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::testing {
namespace {

using host::bake_file;
using host::MappedScene;

using rendering::ContactMethod;
using rendering::SurfaceKind;
using rendering::Touch;
using rendering::World;

// The touch of a point tool that goes straight to each place in turn.
Touch walk_to(const MappedScene& scene, const std::vector<Vec3>& places) {
  const auto world = std::make_unique<World>();
  EXPECT_TRUE(world->set_scene(scene.image().objects(), {.tool_radius_m = 0.0}));
  Touch touch;
  for (const Vec3& p : places) {
    touch = world->touch({.p_W = p});
  }
  return touch;
}

class ShapeScene : public ::testing::Test {
 protected:
  MappedScene baked(const std::string& text) {
    bake_file(folder_.write("scene.toml", text), folder_.path() / "scene.tactus");
    return MappedScene(folder_.path() / "scene.tactus");
  }
  host::BakeReport reported(const std::string& text) {
    return bake_file(folder_.write("scene.toml", text), folder_.path() / "scene.tactus");
  }
  std::string error_of(const std::string& text) {
    return input_error([&] { baked(text); });
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(ShapeScene, APrimitiveHoldsTheToolAtItsSurface) {
  const MappedScene scene = baked(
      "[[object]]\nprimitive = \"sphere\"\nradius_m = 0.03\nposition_m = [0.1, 0.0, 0.0]\n"
      "stiffness_N_per_m = 1000.0\n");
  const Touch touch = walk_to(scene, {{0.1, 0.05, 0.0}, {0.1, 0.028, 0.0}});
  EXPECT_NEAR(touch.depth_m, 0.002, 1e-6);
  EXPECT_NEAR(touch.force_W.y(), 2.0, 1e-3);
}

TEST_F(ShapeScene, APrimitiveAndAMeshlessFormulaOfTheSameSphereFeelAlike) {
  const MappedScene scene = baked(
      "[[object]]\nformula = \"x^2 + y^2 + z^2 - 1\"\nscale = 0.03\nstiffness_N_per_m = 1000.0\n"
      "friction = { static = 0.0 }\n");
  EXPECT_EQ(scene.image().objects()[0].surface, SurfaceKind::implicit);
  const Touch touch = walk_to(scene, {{0.0, 0.05, 0.0},
                                      {0.0, 0.028, 0.0},
                                      {0.004, 0.028, 0.0},
                                      {0.004, 0.028, 0.0},
                                      {0.004, 0.028, 0.0},
                                      {0.004, 0.028, 0.0}});
  const Vec3 expected = 0.03 * Vec3(0.004, 0.028, 0.0).normalized();
  EXPECT_LT((touch.proxy_W - expected).norm(), 1e-6);
}

// The oracle is the offset surface of an ellipsoid: q + r n for its points q with the normals n.
TEST_F(ShapeScene, ASphereTouchesTheOffsetSurfaceOfAFormula) {
  constexpr double kRadius_m = 0.004;
  constexpr double kDepth_m = 0.001;
  constexpr double kTolerance_m = 2e-5;
  const MappedScene scene = baked(
      "[[object]]\nformula = \"(x/1.2)^2 + y^2 + (z/0.8)^2 - 1\"\nscale = 0.03\n"
      "contact = \"sphere_proxy\"\ntolerance_m = 2e-5\nstiffness_N_per_m = 1000.0\n");
  EXPECT_EQ(scene.image().objects()[0].surface, SurfaceKind::mesh);
  for (int i = 0; i < 40; ++i) {
    const double turn = 2.4 * i;
    const double up = (i - 19.5) / 20.0;
    const double out = std::sqrt(1.0 - up * up);
    const Vec3 unit(out * std::cos(turn), up, out * std::sin(turn));
    const Vec3 q = 0.03 * Vec3(1.2 * unit.x(), unit.y(), 0.8 * unit.z());
    const Vec3 n = Vec3(unit.x() / 1.2, unit.y(), unit.z() / 0.8).normalized();
    const auto world = std::make_unique<World>();
    ASSERT_TRUE(world->set_scene(scene.image().objects(), {.tool_radius_m = kRadius_m}));
    world->touch({.p_W = q + 3.0 * kRadius_m * n});
    const Touch touch = world->touch({.p_W = q + (kRadius_m - kDepth_m) * n});
    // A facet that is off by e is tilted by less than 2 sqrt(2 e / R), which moves the proxy by
    // that part of the depth.
    const double most_m = kTolerance_m + kDepth_m * 2.0 * std::sqrt(2.0 * kTolerance_m / 0.016);
    EXPECT_LT((touch.proxy_W - (q + kRadius_m * n)).norm(), most_m) << i;
    EXPECT_NEAR(touch.force_W.norm(), 1.0, 2.0 * kTolerance_m * 1000.0) << i;
  }
}

TEST_F(ShapeScene, AFormulaThatIsAMeshTakesWhatMeshesTake) {
  const std::string ball =
      "[[object]]\nformula = \"sphere(1)\"\nscale = 0.03\ntolerance_m = 1e-3\n";
  EXPECT_EQ(baked(ball + "contact = \"feature_walk\"\n").image().objects()[0].method,
            ContactMethod::feature_walk);
  const MappedScene shaded = baked(ball + "contact = \"sphere_proxy\"\nshading = {}\n");
  EXPECT_FALSE(shaded.image().objects()[0].detail.corner_normals.empty());
  const MappedScene soft = baked(ball + "contact = \"sphere_proxy\"\ndeforms = true\n");
  EXPECT_TRUE(soft.image().objects()[0].deforms);
}

TEST_F(ShapeScene, KeysOfAMeshAreRefusedBesideATrackedFormula) {
  const std::string ball = "[[object]]\nformula = \"sphere(1)\"\n";
  EXPECT_TRUE(contains(error_of(ball + "tolerance_m = 1e-5\n"),
                       "scene.toml:3: object 1: tolerance_m is for a formula that is baked as a "
                       "mesh; write contact = \"sphere_proxy\""));
  EXPECT_TRUE(contains(error_of(ball + "longest_side_m = 0.1\n"), "write scale"));
  EXPECT_TRUE(contains(error_of("[[object]]\nformula = \"x^2 + 1\"\ncontact = \"sphere_proxy\"\n"),
                       "scene.toml:2: the formula is above 0 everywhere"));
}

TEST_F(ShapeScene, APoleIsToldBeforeAFormulaIsCutIntoTriangles) {
  const std::string pole =
      error_of("[[object]]\nformula = \"1/(x - 0.5)^2 - 1\"\ncontact = \"sphere_proxy\"\n");
  EXPECT_TRUE(contains(pole, "scene.toml:2: the formula has a pole at about (0.5, "));
  EXPECT_EQ(pole.find("scene.toml"), pole.rfind("scene.toml")) << pole;
}

// The closed form: the stiffness times the depth below the face, also where the tool is beyond the
// other face.
TEST_F(ShapeScene, WallsThatAreThinOrHaveNoInsideAreFeltFromBothSides) {
  struct Wall {
    const char* formula;
    // Its middle, and half of its thickness, m.
    double x_m;
    double half_m;
    const char* scale;
  };
  for (const Wall& wall :
       {Wall{"translate(box(0.12, 100, 100), 13.3, 0, 0)", 0.0133, 6e-5, "0.001"},
        Wall{"translate(box(0.02, 100, 100), 13.3, 0, 0)", 0.0133, 1e-5, "0.001"},
        Wall{"abs(x - 13.37) - 0.01", 0.01337, 1e-5, "0.001"}, Wall{"x^2", 0.0, 0.0, "1.0"},
        Wall{"(x - 0.37)^4", 0.37, 0.0, "1.0"}, Wall{"abs(x)", 0.0, 0.0, "1.0"},
        Wall{"abs(x - 0.37)", 0.37, 0.0, "1.0"}, Wall{"shell(x - 0.37, 0)", 0.37, 0.0, "1.0"},
        Wall{"x^2 - 0.74*x + 0.1369", 0.37, 0.0, "1.0"}}) {
    const MappedScene scene =
        baked(std::string("[[object]]\nformula = \"") + wall.formula + "\"\nscale = " + wall.scale +
              "\nbounds = [-60, -60, -60, 60, 60, 60]\nstiffness_N_per_m = 1000.0\n");
    for (const double side : {-1.0, 1.0}) {
      const auto world = std::make_unique<World>();
      ASSERT_TRUE(world->set_scene(scene.image().objects(), {.tool_radius_m = 0.0}));
      for (int i = -100; i <= 200; ++i) {
        const double depth_m = 1.3e-5 * i;
        const double x_m = wall.x_m + side * (wall.half_m - depth_m);
        const Touch touch = world->touch({.p_W = {x_m, 0.002, 0.003}});
        ASSERT_LT((touch.force_W - side * 1000.0 * std::max(0.0, depth_m) * Vec3::UnitX()).norm(),
                  5e-4)
            << wall.formula << ", " << side << ", " << depth_m;
      }
    }
  }
}

TEST_F(ShapeScene, ThinShapesAreDrawnWhereTheyAre) {
  const std::string box = "\nscale = 0.001\nbounds = [-60, -60, -60, 60, 60, 60]\n";
  const MappedScene plate =
      baked("[[object]]\nformula = \"translate(box(100, 0.02, 100), 0, 13.37, 0)\"" + box);
  const auto& root = plate.image().objects()[0].mesh.nodes.front();
  EXPECT_NEAR(root.lower.y, 0.01336, 1e-7);
  EXPECT_NEAR(root.upper.y, 0.01338, 1e-7);
  EXPECT_NEAR(root.upper.x - root.lower.x, 0.1, 1e-4);
  const MappedScene ball =
      baked("[[object]]\nformula = \"translate(sphere(0.6), 13.3, 7.1, -9.2)\"" + box);
  const auto& about = ball.image().objects()[0].mesh.nodes.front();
  EXPECT_NEAR(about.upper.x - about.lower.x, 0.0012, 2e-5);
  EXPECT_NEAR(about.lower.z, -0.0098, 1e-5);
}

// A plate that lies askew is thinner than the cells of any picture.
TEST_F(ShapeScene, ShapesThatAreDrawnThickerAreToldSo) {
  const host::BakeReport askew = reported(
      "[[object]]\nformula = \"rotate(box(50, 0.02, 50), 1, 2, 3, 33)\"\nscale = 0.001\n"
      "bounds = [-60, -60, -60, 60, 60, 60]\n");
  ASSERT_EQ(askew.objects[0].warnings.size(), 1U);
  EXPECT_TRUE(contains(askew.objects[0].warnings[0], "formula: its picture shows it about 0."));
  const host::BakeReport wall = reported("[[object]]\nformula = \"x^2\"\n");
  ASSERT_EQ(wall.objects[0].warnings.size(), 2U);
  EXPECT_TRUE(contains(wall.objects[0].warnings[0], "felt as a wall without an inside"));
  EXPECT_GT(wall.objects[0].triangles, 0U);
  EXPECT_TRUE(contains(reported("[[object]]\nformula = \"-x^2\"\n").objects[0].warnings[0],
                       "it is never felt; write sides = \"two\""));
}

TEST_F(ShapeScene, AThinPlateIsAMeshToo) {
  const MappedScene plate = baked(
      "[[object]]\nformula = \"translate(box(100, 0.02, 100), 0, 13.37, 0)\"\nscale = 0.001\n"
      "bounds = [-60, -60, -60, 60, 60, 60]\ncontact = \"sphere_proxy\"\n");
  EXPECT_EQ(plate.image().counters(0).open_edges, 0U);
  EXPECT_NEAR(plate.image().objects()[0].mesh.nodes.front().upper.y, 0.01338, 1e-7);
}

TEST_F(ShapeScene, APotentialFieldPopsThroughAThinPlateWhereAProxyHolds) {
  const std::string plate =
      "[[object]]\nprimitive = \"box\"\nsize_m = [0.1, 0.002, 0.1]\nstiffness_N_per_m = 500.0\n";
  const std::vector<Vec3> way{{0.0, 0.004, 0.0}, {0.0, 0.0002, 0.0}, {0.0, -0.0002, 0.0}};
  EXPECT_LT(walk_to(baked(plate + "contact = \"potential_field\"\n"), way).force_W.y(), 0.0);
  EXPECT_GT(walk_to(baked(plate + "contact = \"god_object\"\n"), way).force_W.y(), 0.5);
}

TEST_F(ShapeScene, AGodObjectHasNoRadius) {
  const MappedScene scene = baked(
      "[[object]]\nprimitive = \"plane\"\ncontact = \"god_object\"\nstiffness_N_per_m = 1000.0\n");
  EXPECT_EQ(scene.image().objects()[0].method, ContactMethod::god_object);
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene(scene.image().objects(), {.tool_radius_m = 0.01}));
  EXPECT_EQ(world->touch({.p_W = {0.0, 0.005, 0.0}}).planes, 0);
  EXPECT_NEAR(world->touch({.p_W = {0.0, -0.001, 0.0}}).depth_m, 0.001, 1e-6);
}

TEST_F(ShapeScene, MistakesAreToldWithLineAndRemedy) {
  EXPECT_TRUE(contains(error_of("[[object]]\nprimitive = \"spere\"\n"), "scene.toml:2"));
  EXPECT_TRUE(contains(error_of("[[object]]\nprimitive = \"sphere\"\n"), "write radius_m = 0.03"));
  EXPECT_TRUE(contains(error_of("[[object]]\nname = \"a\"\n"), "has no surface"));
  EXPECT_TRUE(contains(error_of("[[object]]\nformula = \"x +\"\n"), "scene.toml:2"));
  EXPECT_TRUE(contains(error_of("[[object]]\nformula = \"x^2 + 1\"\n"), "above 0 everywhere"));
  const std::string pole = error_of("[[object]]\nformula = \"1/(x - 0.5)^2 - 1\"\n");
  EXPECT_TRUE(contains(pole, "scene.toml:2: the formula has a pole at about (0.5, "));
  EXPECT_TRUE(contains(pole, "1/x - y becomes 1 - x*y"));
  EXPECT_TRUE(contains(error_of("[[object]]\nprimitive = \"sphere\"\nradius_m = 0.03\n"
                                "contact = \"tracking\"\n"),
                       "\"tracking\" is for formulas"));
  EXPECT_TRUE(
      contains(error_of("[[object]]\nprimitive = \"plane\"\nformula = \"x\"\n"), "more than one"));
}

}  // namespace
}  // namespace tactus::testing
