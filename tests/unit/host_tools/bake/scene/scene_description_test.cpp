#include "host_tools/bake/scene/scene_description.h"

#include <gtest/gtest.h>

#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

constexpr const char* kFile = "folder/scene.toml";

SceneDescription parse(std::string_view text) {
  return parse_scene_description(text, kFile);
}

// The error for an object with one more line, or for a whole scene.
std::string scene_error(std::string_view text) {
  return testing::input_error([&] { parse(text); });
}
std::string object_error(const std::string& line) {
  return scene_error("[[object]]\nmesh = \"a.off\"\n" + line + "\n");
}

TEST(SceneDescription, ReadsEveryKey) {
  const SceneDescription scene = parse(R"(
[tool]
radius_m = 0.003
[[object]]
name = "bunny"
mesh = "bunny00.off"
longest_side_m = 0.15
position_m = [0.1, 0, -0.2]
rotation = { axis = [0, 2, 0], angle_deg = 90 }
sides = "two"
stiffness_N_per_m = 800.0
damping_Ns_per_m = 0.5
weld_m = 1e-6
cap_holes_mm = 2.5
[object.friction]
model = "cone"
static = 0.6
dynamic = 0.4
[[object]]
mesh = "/elsewhere/plate.stl"
scale = 0.001
)");
  EXPECT_EQ(scene.tool_radius_m, 0.003);
  ASSERT_EQ(scene.objects.size(), 2U);
  const ObjectDescription& bunny = scene.objects[0];
  EXPECT_EQ(bunny.name, "bunny");
  EXPECT_EQ(bunny.mesh, "folder/bunny00.off") << "relative to the scene file";
  EXPECT_EQ(bunny.line, 6U);
  EXPECT_EQ(bunny.placement.longest_side_m, 0.15);
  EXPECT_EQ(bunny.placement.position_m, Vec3(0.1, 0, -0.2));
  EXPECT_NEAR((bunny.placement.rotation * Vec3::UnitX() + Vec3::UnitZ()).norm(), 0.0, 1e-15);
  EXPECT_EQ(bunny.sides, rendering::Sides::two);
  EXPECT_EQ(bunny.material.stiffness_N_per_m, 800.0);
  EXPECT_EQ(bunny.material.damping_Ns_per_m, 0.5);
  EXPECT_EQ(bunny.material.friction.static_level, 0.6);
  EXPECT_EQ(bunny.material.friction.coulomb, 0.4);
  EXPECT_EQ(bunny.mesh_options.weld_m, 1e-6);
  EXPECT_EQ(bunny.mesh_options.cap_holes_m, 0.0025);
  EXPECT_EQ(scene.objects[1].mesh, "/elsewhere/plate.stl");
  EXPECT_EQ(scene.objects[1].placement.scale, 0.001);
}

TEST(SceneDescription, NeedsNothingButAMesh) {
  const SceneDescription scene = parse("[[object]]\nmesh = \"meshes/plate.stl\"\n");
  EXPECT_EQ(scene.tool_radius_m, kDefaultToolRadius_m);
  const ObjectDescription& plate = scene.objects.at(0);
  EXPECT_EQ(plate.name, "plate");
  EXPECT_FALSE(plate.placement.longest_side_m.has_value());
  EXPECT_EQ(plate.placement.scale, 1.0);
  EXPECT_EQ(plate.placement.position_m, Vec3::Zero());
  EXPECT_EQ(plate.sides, rendering::Sides::one);
  EXPECT_EQ(plate.material.stiffness_N_per_m, kDefaultStiffness_N_per_m);
  EXPECT_EQ(plate.material.damping_Ns_per_m, 0.0);
  EXPECT_EQ(plate.material.friction.static_level, 0.0);
}

TEST(SceneDescription, TakesAQuaternionOfAnyLength) {
  const SceneDescription scene =
      parse("[[object]]\nmesh = \"a\"\nrotation = { quaternion_wxyz = [2, 0, 2, 0] }\n");
  EXPECT_NEAR((scene.objects[0].placement.rotation * Vec3::UnitX() + Vec3::UnitZ()).norm(), 0.0,
              1e-15);
}

TEST(SceneDescription, TakesDynamicFrictionFromStaticWhenItIsAbsent) {
  const SceneDescription scene = parse("[[object]]\nmesh = \"a\"\nfriction = { static = 0.3 }\n");
  EXPECT_EQ(scene.objects[0].material.friction.coulomb, 0.3);
}

TEST(SceneDescription, AsksForAMissingUnit) {
  EXPECT_EQ(object_error("stiffness = 800"),
            "folder/scene.toml:3: object 1: unknown key 'stiffness'; did you mean "
            "stiffness_N_per_m (newtons per metre)?");
}

TEST(SceneDescription, ConvertsWrongUnits) {
  EXPECT_EQ(object_error("stiffness_N_per_mm = 0.8"),
            "folder/scene.toml:3: object 1: unknown key 'stiffness_N_per_mm'; wrong unit, "
            "stiffness is in newtons per metre; write stiffness_N_per_m = 800");
  EXPECT_TRUE(object_error("longest_side_cm = 15").ends_with("write longest_side_m = 0.15"));
  EXPECT_TRUE(object_error("damping_Ns_per_mm = 0.0005").ends_with("write damping_Ns_per_m = 0.5"));
  EXPECT_TRUE(
      object_error("position_mm = [10, 0, 1.5]").ends_with("write position_m = [0.01, 0, 0.0015]"));
  EXPECT_TRUE(object_error("rotation = { axis = [0, 1, 0], angle_rad = 3.14159265358979 }")
                  .ends_with("write angle_deg = 180"));
  EXPECT_EQ(scene_error("[tool]\nradius_mm = 2\n[[object]]\nmesh = \"a\"\n"),
            "folder/scene.toml:2: [tool]: unknown key 'radius_mm'; wrong unit, radius is in "
            "metres; write radius_m = 0.002");
}

TEST(SceneDescription, WantsAToolThatIsNoLargerThanAMetre) {
  EXPECT_EQ(scene_error("[tool]\nradius_m = 2\n[[object]]\nmesh = \"a\"\n"),
            "folder/scene.toml:2: [tool]: radius_m is 2 m, where 1 m is the most; is it in "
            "millimetres?");
}

TEST(SceneDescription, SuggestsTheNearestKey) {
  EXPECT_TRUE(object_error("meshes = \"b\"").ends_with("did you mean mesh?"));
  EXPECT_TRUE(object_error("Sides = \"one\"").ends_with("did you mean sides?"));
  EXPECT_TRUE(object_error("postion_m = [0, 0, 0]").ends_with("did you mean position_m (metres)?"));
  EXPECT_TRUE(object_error("[object.fricton]\nstatic = 1").ends_with("did you mean friction?"));
}

TEST(SceneDescription, ListsTheKeysWhenNoneIsNear) {
  EXPECT_TRUE(testing::contains(object_error("colour = \"red\""), "the keys here are name, mesh,"));
}

TEST(SceneDescription, NamesTheLineThatIsNotToml) {
  EXPECT_TRUE(
      scene_error("[tool]\nradius_m = \n").starts_with("folder/scene.toml:2: not valid TOML"));
}

TEST(SceneDescription, WantsObjects) {
  EXPECT_TRUE(testing::contains(scene_error("[tool]\nradius_m = 0.1\n"), "there is no [[object]]"));
  EXPECT_TRUE(testing::contains(scene_error("[object]\nmesh = \"a\"\n"), "with two brackets"));
  std::string many;
  for (int i = 0; i < 1025; ++i) {
    many += "[[object]]\nname = \"o" + std::to_string(i) + "\"\nmesh = \"a\"\n";
  }
  EXPECT_TRUE(testing::contains(scene_error(many), "1025 objects, where 1024 fit"));
}

TEST(SceneDescription, WantsAMeshAndDistinctNames) {
  EXPECT_EQ(scene_error("[[object]]\nname = \"a\"\n"),
            "folder/scene.toml:1: object 1: has no surface; write mesh = \"file.ply\", primitive = "
            "\"sphere\" or formula = \"x^2 + y^2 + z^2 - 1\"");
  EXPECT_TRUE(testing::contains(
      scene_error("[[object]]\nmesh = \"a.off\"\n[[object]]\nmesh = \"b/a.ply\"\n"),
      "scene.toml:3: two objects are named 'a'"));
}

TEST(SceneDescription, RefusesNumbersOutOfRange) {
  EXPECT_TRUE(testing::contains(object_error("scale = -1"),
                                ":3: object 1: scale is -1; write a number above 0"));
  EXPECT_TRUE(testing::contains(object_error("scale = 0"), "above 0"));
  EXPECT_TRUE(testing::contains(object_error("longest_side_m = 0.0"), "above 0"));
  EXPECT_TRUE(testing::contains(object_error("stiffness_N_per_m = -5"), "from 0"));
  EXPECT_TRUE(
      testing::contains(object_error("damping_Ns_per_m = nan"), "is nan; write a finite number"));
  EXPECT_TRUE(testing::contains(object_error("weld_m = inf"), "is inf; write a finite number"));
  EXPECT_TRUE(testing::contains(object_error("position_m = [0, nan, 0]"), "finite number"));
  EXPECT_TRUE(testing::contains(scene_error("[tool]\nradius_m = -1\n[[object]]\nmesh = \"a\"\n"),
                                "from 0"));
}

TEST(SceneDescription, RefusesValuesOfTheWrongKind) {
  EXPECT_TRUE(testing::contains(object_error("scale = \"1\""), "without quotes"));
  EXPECT_TRUE(testing::contains(object_error("scale = true"), "must be a number"));
  EXPECT_TRUE(testing::contains(object_error("sides = 2"), "must be text"));
  EXPECT_TRUE(testing::contains(object_error("name = \"\""), "must be text"));
  EXPECT_TRUE(testing::contains(object_error("name = \"a\\nb\""), "control character"));
  EXPECT_TRUE(testing::contains(object_error("position_m = 3"), "must be 3 numbers"));
  EXPECT_TRUE(testing::contains(object_error("position_m = [1, 2]"), "must be 3 numbers"));
  EXPECT_TRUE(testing::contains(object_error("position_m = [1, 2, \"3\"]"), "must be a number"));
  EXPECT_TRUE(testing::contains(object_error("friction = 0.5"), "must be a table"));
}

TEST(SceneDescription, RefusesUnknownChoices) {
  EXPECT_TRUE(testing::contains(object_error("sides = \"both\""), "write \"one\" or \"two\""));
  EXPECT_TRUE(testing::contains(object_error("friction = { model = \"ice\", static = 1 }"),
                                "no friction model 'ice'"));
}

TEST(SceneDescription, RefusesBothSizes) {
  EXPECT_TRUE(
      testing::contains(object_error("scale = 1\nlongest_side_m = 1"), "leave one of them out"));
}

TEST(SceneDescription, RefusesHalfOrDoubleRotations) {
  for (const char* rotation :
       {"{ axis = [0, 1, 0] }", "{ angle_deg = 90 }", "{ }",
        "{ axis = [0, 1, 0], angle_deg = 90, quaternion_wxyz = [1, 0, 0, 0] }"}) {
    EXPECT_TRUE(testing::contains(object_error(std::string("rotation = ") + rotation),
                                  "write one of the two"));
  }
  EXPECT_TRUE(testing::contains(object_error("rotation = { axis = [0, 0, 0], angle_deg = 1 }"),
                                "axis is zero"));
  EXPECT_TRUE(
      testing::contains(object_error("rotation = { quaternion_wxyz = [0, 0, 0, 0] }"), "is zero"));
}

TEST(SceneDescription, RefusesFrictionThatHoldsMoreSlidingThanSticking) {
  EXPECT_TRUE(testing::contains(object_error("friction = { static = 0.2, dynamic = 0.3 }"),
                                "dynamic (0.3) is above static (0.2)"));
  EXPECT_TRUE(testing::contains(object_error("friction = { dynamic = 0.3 }"), "static is missing"));
  EXPECT_TRUE(testing::contains(object_error("friction = { static = -0.3 }"), "from 0"));
}

TEST(SceneDescription, NamesASceneFileThatIsMissing) {
  EXPECT_TRUE(
      testing::contains(testing::input_error([] { read_scene_description("/nowhere/scene.toml"); }),
                        "/nowhere/scene.toml: cannot read: No such file"));
}

}  // namespace
}  // namespace tactus::host
