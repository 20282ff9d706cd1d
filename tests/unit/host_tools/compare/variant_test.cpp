// The variants of a comparison: their product, their names, and what they change in a scene.
#include "host_tools/compare/variant.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::ContactMethod;
using rendering::FrictionKind;
using rendering::Sides;
using testing::contains;
using testing::input_error;

std::vector<std::string> names_of(const VariantLists& lists) {
  std::vector<std::string> names;
  for (const Variant& variant : variants_of(lists)) {
    names.push_back(variant.name);
  }
  return names;
}

SceneDescription scene_of(const std::string& text) {
  return parse_scene_description(text, "folder/scene.toml");
}

const std::string kTwoMeshes =
    "[[object]]\nmesh = \"a.off\"\nfriction = { static = 0.6, dynamic = 0.4 }\n"
    "stiffness_N_per_m = 700.0\n[[object]]\nmesh = \"b.off\"\n";

TEST(Variants, AreTheProductOfTheListsInTheirOrder) {
  const std::vector<Variant> variants =
      variants_of({.methods = {"three_step", "god_object"}, .rates_Hz = {500.0, 1000.0, 2500.5}});
  ASSERT_EQ(variants.size(), 6U);
  const std::vector<std::string> names{"three_step, 500 Hz",    "three_step, 1000 Hz",
                                       "three_step, 2500.5 Hz", "god_object, 500 Hz",
                                       "god_object, 1000 Hz",   "god_object, 2500.5 Hz"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(variants[i].name, names[i]);
    EXPECT_EQ(variants[i].method, i < 3 ? ContactMethod::three_step : ContactMethod::god_object);
    EXPECT_FALSE(variants[i].friction || variants[i].push_out_m || variants[i].sides);
  }
  EXPECT_EQ(variants[4].rate_Hz, 1000.0);
}

TEST(Variants, OfAllListsTogetherAreAllCombinations) {
  const std::vector<Variant> variants = variants_of({.methods = {"one_plane", "one_step"},
                                                     .frictions = {"cone", "dahl"},
                                                     .push_outs_mm = {0.0, 0.5},
                                                     .sides = {"one", "two"},
                                                     .rates_Hz = {100.0, 200.0}});
  ASSERT_EQ(variants.size(), 32U);
  EXPECT_EQ(variants.front().name, "one_plane, cone, push-out 0 mm, one side, 100 Hz");
  EXPECT_EQ(variants.back().name, "one_step, dahl, push-out 0.5 mm, two sides, 200 Hz");
  EXPECT_EQ(variants.back().friction, FrictionKind::dahl);
  EXPECT_EQ(variants.back().push_out_m, 5e-4);
  EXPECT_EQ(variants.back().sides, Sides::two);
}

TEST(Variants, NameWhatDiffers) {
  EXPECT_EQ(names_of({}), (std::vector<std::string>{"as the scene has it"}));
  EXPECT_EQ(names_of({.rates_Hz = {1000.0}}), (std::vector<std::string>{"as the scene has it"}));
  EXPECT_EQ(names_of({.methods = {"one_step"}, .push_outs_mm = {0.5}, .rates_Hz = {1000.0}}),
            (std::vector<std::string>{"one_step"}));
  EXPECT_EQ(names_of({.push_outs_mm = {0.001, 0.0}}),
            (std::vector<std::string>{"push-out 0.001 mm", "push-out 0 mm"}));
}

TEST(Variants, RefuseUnknownNamesAndNumbersOutOfRange) {
  EXPECT_TRUE(contains(input_error([] { variants_of({.methods = {"one_plan"}}); }),
                       "there is no contact method \"one_plan\"; write some of sphere_proxy"));
  EXPECT_TRUE(contains(input_error([] { variants_of({.frictions = {"glue"}}); }),
                       "there is no friction model \"glue\""));
  EXPECT_TRUE(
      contains(input_error([] { variants_of({.sides = {"three"}}); }), "write some of one, two"));
  EXPECT_TRUE(contains(input_error([] { variants_of({.push_outs_mm = {-0.1}}); }),
                       "--push-outs has -0.1; write numbers of millimetres, 0 or more"));
  EXPECT_TRUE(contains(input_error([] { variants_of({.rates_Hz = {0.0}}); }),
                       "--rates has 0; write numbers of ticks in a second, above 0"));
  EXPECT_TRUE(contains(input_error([] { variants_of({.rates_Hz = {1.0 / 0.0}}); }), "--rates"));
}

TEST(ChangedScene, HasTheVariantOnAllObjectsOrOnTheOneThatIsNamed) {
  const SceneDescription scene = scene_of(kTwoMeshes);
  const Variant variant =
      variants_of({.methods = {"three_step"}, .push_outs_mm = {0.25}, .sides = {"two"}})[0];
  for (const ObjectDescription& object : changed(scene, variant, "").objects) {
    EXPECT_EQ(object.contact, ContactMethod::three_step);
    EXPECT_EQ(object.push_out_m, 2.5e-4);
    EXPECT_EQ(object.sides, Sides::two);
  }
  const SceneDescription one = changed(scene, variant, "b");
  EXPECT_EQ(one.objects[0].contact, ContactMethod::sphere_proxy);
  EXPECT_EQ(one.objects[0].push_out_m, rendering::kDefaultPushOut_m);
  EXPECT_EQ(one.objects[1].contact, ContactMethod::three_step);
  EXPECT_EQ(input_error([&] { changed(scene, variant, "c"); }),
            "folder/scene.toml: there is no object \"c\"");
}

TEST(ChangedScene, GivesBristlesTheStiffnessOfTheObject) {
  const SceneDescription scene = scene_of(kTwoMeshes);
  const SceneDescription dahl = changed(scene, variants_of({.frictions = {"dahl"}})[0], "a");
  EXPECT_EQ(dahl.objects[0].material.friction.kind, FrictionKind::dahl);
  EXPECT_EQ(dahl.objects[0].material.friction.stiffness_N_per_m, 700.0);
  EXPECT_TRUE(
      contains(input_error([&] { changed(scene, variants_of({.frictions = {"dahl"}})[0], "b"); }),
               "folder/scene.toml:6: object b has no dynamic friction"));
}

TEST(ChangedScene, RefusesMethodsThatTheObjectCannotHave) {
  const SceneDescription ball = scene_of("[[object]]\nprimitive = \"sphere\"\nradius_m = 0.01\n");
  EXPECT_TRUE(contains(
      input_error([&] { changed(ball, variants_of({.methods = {"one_plane"}})[0], ""); }),
      "folder/scene.toml:2: object sphere: one_plane is for meshes; name other objects with "
      "--object"));
  const SceneDescription mesh = scene_of(kTwoMeshes);
  EXPECT_TRUE(contains(
      input_error([&] { changed(mesh, variants_of({.methods = {"plain_tracking"}})[0], ""); }),
      "plain_tracking is for formulas"));
  const SceneDescription shaded = scene_of("[[object]]\nmesh = \"a.off\"\nshading = {}\n");
  EXPECT_TRUE(
      contains(input_error([&] { changed(shaded, variants_of({.methods = {"one_step"}})[0], ""); }),
               "one_step renders neither shading nor textures"));
  EXPECT_EQ(changed(shaded, variants_of({.methods = {"god_object"}})[0], "").objects.size(), 1U);
}

}  // namespace
}  // namespace tactus::host
