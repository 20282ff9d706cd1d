// The textbook's contact methods in a scene: their keys, from the text to the image, and what is
// refused beside them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/world/world.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::testing {
namespace {

using host::bake_file;
using host::MappedScene;
using rendering::ContactMethod;
using rendering::Object;

struct TextbookName {
  const char* name;
  ContactMethod method;
};
constexpr std::array kOnMeshes{
    TextbookName{.name = "one_plane", .method = ContactMethod::one_plane},
    TextbookName{.name = "three_sub_goals", .method = ContactMethod::three_sub_goals},
    TextbookName{.name = "three_step", .method = ContactMethod::three_step},
    TextbookName{.name = "one_step", .method = ContactMethod::one_step}};

// A square in y = 0 with its front upward.
constexpr std::string_view kSquare =
    "OFF\n4 2 0\n-0.1 0 -0.1\n0.1 0 -0.1\n0.1 0 0.1\n-0.1 0 0.1\n3 0 2 1\n3 0 3 2\n";
const std::string kTextbookMesh = "[[object]]\nmesh = \"square.off\"\nsides = \"two\"\n";
const std::string kTextbookBall = "[[object]]\nprimitive = \"sphere\"\nradius_m = 0.02\n";
const std::string kFormula = "[[object]]\nformula = \"sphere(1)\"\nscale = 0.02\n";

std::string contact(const std::string& name) {
  return "contact = \"" + name + "\"\n";
}

class TextbookScene : public ::testing::Test {
 protected:
  TextbookScene() { (void)folder_.write("square.off", kSquare); }
  MappedScene baked(const std::string& text) {
    bake_file(folder_.write("scene.toml", text), folder_.path() / "scene.tactus");
    return MappedScene(folder_.path() / "scene.tactus");
  }
  void expect_error(const std::string& text, const std::string& line, const std::string& part) {
    const std::string error = input_error([&] { baked(text); });
    EXPECT_TRUE(contains(error, "scene.toml:" + line + ": ")) << text;
    EXPECT_TRUE(contains(error, part)) << text;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(TextbookScene, TheMethodsReachTheImageWithTheirPushOut) {
  for (const TextbookName& method : kOnMeshes) {
    const MappedScene plain = baked(kTextbookMesh + contact(method.name));
    EXPECT_EQ(plain.image().objects()[0].method, method.method);
    EXPECT_EQ(plain.image().objects()[0].push_out_m, rendering::kDefaultPushOut_m);
    const MappedScene pushed = baked(kTextbookMesh + contact(method.name) + "push_out_mm = 0.25\n");
    EXPECT_EQ(pushed.image().objects()[0].push_out_m, 2.5e-4);
    const MappedScene none = baked(kTextbookMesh + contact(method.name) + "push_out_mm = 0\n");
    EXPECT_EQ(none.image().objects()[0].push_out_m, 0.0);
  }
  const MappedScene formula = baked(kFormula + contact("plain_tracking"));
  EXPECT_EQ(formula.image().objects()[0].method, ContactMethod::plain_tracking);
  EXPECT_EQ(formula.image().objects()[0].surface, rendering::SurfaceKind::implicit);
  const MappedScene meshed = baked(kFormula + "tolerance_m = 1e-3\n" + contact("one_plane"));
  EXPECT_EQ(meshed.image().objects()[0].surface, rendering::SurfaceKind::mesh);
}

TEST_F(TextbookScene, TheWorldTouchesByTheMethodAndThePushOutOfTheScene) {
  for (const TextbookName& method : kOnMeshes) {
    SCOPED_TRACE(method.name);
    const MappedScene scene = baked(kTextbookMesh + contact(method.name) +
                                    "push_out_mm = 0.25\nstiffness_N_per_m = 800.0\n");
    const auto world = std::make_unique<rendering::World>();
    ASSERT_TRUE(world->set_scene(scene.image().objects(), {.tool_radius_m = 0.002}));
    world->touch({.p_W = {0.01, 0.01, 0.02}});
    const rendering::Touch touch = world->touch({.p_W = {0.01, -0.003, 0.02}});
    EXPECT_EQ(touch.contact, rendering::ContactKind::face);
    EXPECT_NEAR(touch.proxy_W.y(), 2.5e-4, 1e-12) << "the tool's radius is not used";
    EXPECT_NEAR(touch.force_W.y(), 800.0 * 0.00325, 1e-9);
    EXPECT_NEAR(touch.depth_m, 0.00325, 1e-12);
  }
}

TEST_F(TextbookScene, APushOutIsForTheMethodsOnMeshesAlone) {
  for (const char* method : {"sphere_proxy", "god_object", "potential_field", "feature_walk"}) {
    expect_error(kTextbookMesh + contact(method) + "push_out_mm = 0.001\n", "5",
                 "push_out_mm is for the contacts one_plane, three_sub_goals, three_step and "
                 "one_step; leave it out");
  }
  expect_error(kTextbookMesh + "push_out_mm = 0.001\n", "4", "push_out_mm is for the contacts");
  expect_error(kFormula + contact("plain_tracking") + "push_out_mm = 0.001\n", "5",
               "push_out_mm is for the contacts");
  expect_error(kTextbookMesh + contact("one_plane") + "push_out_mm = -0.1\n", "5", "push_out_mm");
  expect_error(kTextbookMesh + contact("one_plane") + "push_out_m = 1e-6\n", "5",
               "wrong unit, push_out is in millimetres; write push_out_mm = 0.001");
}

TEST_F(TextbookScene, AMethodIsRefusedOnASurfaceThatItDoesNotKnow) {
  for (const TextbookName& method : kOnMeshes) {
    expect_error(kTextbookBall + contact(method.name), "4",
                 fmt::format(R"("{}" is for meshes; write "sphere_proxy")", method.name));
  }
  expect_error(kTextbookBall + contact("plain_tracking"), "4",
               R"("plain_tracking" is for formulas; write "sphere_proxy")");
  expect_error(kTextbookMesh + contact("plain_tracking"), "4",
               "\"plain_tracking\" is for formulas");
  expect_error(kTextbookMesh + contact("two_plane"), "4", "no contact method \"two_plane\"");
}

TEST_F(TextbookScene, FrictionIsTheConeOnMeshesAndNoneOnFormulas) {
  const std::string cone = "friction = { model = \"cone\", static = 0.6, dynamic = 0.4 }\n";
  const std::string dahl =
      "friction = { model = \"dahl\", dynamic = 0.4, stiffness_N_per_m = 500.0 }\n";
  for (const TextbookName& method : kOnMeshes) {
    const std::string object = kTextbookMesh + contact(method.name);
    const MappedScene rough = baked(object + cone);
    EXPECT_EQ(rough.image().objects()[0].material.friction.coulomb, 0.4);
    expect_error(object + dahl, "5",
                 "a textbook's method has the friction cone only; write model = \"cone\", or leave "
                 "out contact");
    std::string grained = object + cone;
    grained += "grain = { direction = [1, 0, 0], across = 0.4 }\n";
    expect_error(grained, "6", "a textbook's method has no grain");
  }
  expect_error(kFormula + contact("plain_tracking") + cone, "5",
               "plain_tracking has no friction; leave it out, or write \"tracking\"");
}

TEST_F(TextbookScene, ShadingAndTexturesAreRefused) {
  for (const TextbookName& method : kOnMeshes) {
    expect_error(kTextbookMesh + contact(method.name) + "shading = {}\n", "5",
                 "a textbook's method has no shading; leave it out, or leave out contact");
    expect_error(
        kTextbookMesh + contact(method.name) + "texture.friction = { image = \"a.png\" }\n", "5",
        "a textbook's method has no texture");
    expect_error(kTextbookMesh + contact(method.name) + "deforms = true\n", "5", "");
  }
}

}  // namespace
}  // namespace tactus::testing
