// Scenes of primitives and formulas, from the text to the touch.
#include <gtest/gtest.h>

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
  EXPECT_TRUE(
      contains(error_of("[[object]]\nformula = \"x\"\ncontact = \"sphere_proxy\"\n"), "tracking"));
  EXPECT_TRUE(
      contains(error_of("[[object]]\nprimitive = \"plane\"\nformula = \"x\"\n"), "more than one"));
}

}  // namespace
}  // namespace tactus::testing
