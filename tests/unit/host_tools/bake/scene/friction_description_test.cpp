#include "host_tools/bake/scene/friction_description.h"

#include <gtest/gtest.h>

#include <string>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/bake/scene/scene_description.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using rendering::FrictionParameters;

const std::string kPlate = "[[object]]\nprimitive = \"box\"\nsize_m = [0.1, 0.02, 0.1]\n";

rendering::Material material_of(const std::string& lines) {
  return parse_scene_description(kPlate + lines + "\n", "folder/scene.toml")
      .objects.front()
      .material;
}

FrictionParameters friction_of(const std::string& keys) {
  return material_of("friction = { " + keys + " }").friction;
}

std::string error_of(const std::string& lines) {
  return testing::input_error([&] { material_of(lines); });
}

std::string friction_error(const std::string& keys) {
  return error_of("friction = { " + keys + " }");
}

TEST(FrictionDescription, ReadsEveryModelByItsName) {
  EXPECT_EQ(friction_of("static = 0.6").kind, FrictionKind::cone);
  EXPECT_EQ(friction_of("model = \"cone\", static = 0.6").kind, FrictionKind::cone);
  EXPECT_EQ(friction_of("model = \"coulomb\", dynamic = 0.6").kind, FrictionKind::coulomb_viscous);
  EXPECT_EQ(friction_of("model = \"stribeck\", static = 0.6").kind, FrictionKind::stribeck);
  EXPECT_EQ(friction_of("model = \"karnopp\", static = 0.6").kind, FrictionKind::karnopp);
  EXPECT_EQ(friction_of("model = \"dahl\", dynamic = 0.6").kind, FrictionKind::dahl);
  EXPECT_EQ(friction_of("model = \"lugre\", static = 0.6").kind, FrictionKind::lugre);
  EXPECT_EQ(friction_of("model = \"elasto_plastic\", static = 0.6").kind,
            FrictionKind::elasto_plastic);
}

TEST(FrictionDescription, ReadsEveryParameter) {
  const FrictionParameters lugre = friction_of(
      "model = \"lugre\", static = 0.8, dynamic = 0.5, viscous_s_per_m = 0.3, "
      "stribeck_velocity_m_per_s = 0.02, stribeck_exponent = 1.5, stiffness_N_per_m = 1500, "
      "damping_s_per_m = 2, damping_fade_m_per_s = 0.04");
  EXPECT_EQ(lugre.static_level, 0.8);
  EXPECT_EQ(lugre.coulomb, 0.5);
  EXPECT_EQ(lugre.viscous_s_per_m, 0.3);
  EXPECT_EQ(lugre.stribeck_velocity_m_per_s, 0.02);
  EXPECT_EQ(lugre.stribeck_exponent, 1.5);
  EXPECT_EQ(lugre.stiffness_N_per_m, 1500.0);
  EXPECT_EQ(lugre.damping_s_per_m, 2.0);
  EXPECT_EQ(lugre.damping_fade_m_per_s, 0.04);
  EXPECT_EQ(friction_of("model = \"karnopp\", static = 0.8, stick_velocity_m_per_s = 0.03")
                .stick_velocity_m_per_s,
            0.03);
  EXPECT_EQ(friction_of("model = \"elasto-plastic\", static = 0.8, elastic_fraction = 0.4")
                .elastic_fraction,
            0.4);
}

TEST(FrictionDescription, TakesDefaultsThatAreValidForEveryModel) {
  for (const rendering::FrictionModelTraits& model : rendering::kFrictionModels) {
    const bool has_static =
        model.kind != FrictionKind::dahl && model.kind != FrictionKind::coulomb_viscous;
    const FrictionParameters friction =
        friction_of(std::string("model = \"") + std::string(model.name) +
                    (has_static ? "\", static = 0.6" : "\", dynamic = 0.6"));
    EXPECT_TRUE(valid(friction)) << model.name;
    EXPECT_EQ(friction.coulomb, 0.6) << model.name;
    EXPECT_EQ(friction.static_level, 0.6) << model.name;
    EXPECT_EQ(friction.viscous_s_per_m, 0.0) << model.name;
    EXPECT_EQ(friction.damping_s_per_m, 0.0) << model.name;
    const bool has_bristles = model.has_bristles;
    EXPECT_EQ(friction.stiffness_N_per_m, has_bristles ? kDefaultStiffness_N_per_m : 0.0)
        << model.name;
  }
  EXPECT_TRUE(valid(material_of("").friction));
  EXPECT_EQ(material_of("").friction.static_level, 0.0);
}

TEST(FrictionDescription, MakesBristlesAsStiffAsTheContact) {
  EXPECT_EQ(material_of("stiffness_N_per_m = 800\nfriction = { model = \"dahl\", dynamic = 0.3 }")
                .friction.stiffness_N_per_m,
            800.0);
  EXPECT_EQ(error_of("stiffness_N_per_m = 0\nfriction = { model = \"dahl\", dynamic = 0.3 }"),
            "folder/scene.toml:5: object 1 friction: \"dahl\" has bristles, and they need a "
            "stiffness above 0; write stiffness_N_per_m = 500.0");
}

TEST(FrictionDescription, RefusesModelsThatItDoesNotKnow) {
  EXPECT_EQ(friction_error("model = \"bouc_wen\", static = 1"),
            "folder/scene.toml:4: object 1 friction: there is no friction model 'bouc_wen'; there "
            "are cone, coulomb, stribeck, karnopp, dahl, lugre, elasto_plastic");
}

TEST(FrictionDescription, RefusesKeysOfOtherModelsAndListsItsOwn) {
  EXPECT_EQ(friction_error("model = \"dahl\", static = 0.6, dynamic = 0.4"),
            "folder/scene.toml:4: object 1 friction: model \"dahl\" has no static; it has dynamic, "
            "viscous_s_per_m, stiffness_N_per_m");
  EXPECT_TRUE(friction_error("static = 0.6, stiffness_N_per_m = 100")
                  .ends_with("model \"cone\" has no stiffness_N_per_m; it has dynamic, static"));
  EXPECT_TRUE(
      testing::contains(friction_error("model = \"lugre\", static = 1, elastic_fraction = 0.5"),
                        "\"lugre\" has no elastic_fraction; it has dynamic, static, "));
}

TEST(FrictionDescription, RefusesKeysThatNoModelHas) {
  EXPECT_EQ(friction_error("static = 0.6, viscos_s_per_m = 1"),
            "folder/scene.toml:4: object 1 friction: unknown key 'viscos_s_per_m'; did you mean "
            "viscous_s_per_m (seconds per metre)?");
  EXPECT_TRUE(friction_error("model = \"lugre\", static = 0.6, stribeck_velocity_mm_per_s = 20")
                  .ends_with("stribeck_velocity is in metres per second; write "
                             "stribeck_velocity_m_per_s = 0.02"));
  EXPECT_TRUE(friction_error("model = \"lugre\", static = 0.6, stiffness_N_per_mm = 1.5")
                  .ends_with("write stiffness_N_per_m = 1500"));
}

TEST(FrictionDescription, RefusesNumbersOutOfRange) {
  EXPECT_TRUE(friction_error("model = \"lugre\", static = 0.6, stribeck_velocity_m_per_s = 0")
                  .ends_with("write a number above 0"));
  EXPECT_TRUE(friction_error("model = \"lugre\", static = 0.6, viscous_s_per_m = -1")
                  .ends_with("write a number from 0"));
  EXPECT_TRUE(friction_error("model = \"elasto_plastic\", static = 0.6, elastic_fraction = 1")
                  .ends_with("elastic_fraction is 1; write a number between 0 and 1"));
  EXPECT_TRUE(friction_error("model = \"stribeck\", static = 0.6, stribeck_exponent = nan")
                  .ends_with("write a finite number"));
}

TEST(FrictionDescription, RefusesLevelsThatContradictEachOther) {
  EXPECT_TRUE(testing::contains(friction_error("model = \"lugre\", static = 0.2, dynamic = 0.3"),
                                "dynamic (0.3) is above static (0.2)"));
  EXPECT_TRUE(testing::contains(friction_error("model = \"lugre\", dynamic = 0.3"),
                                "the coefficient static is missing; write static = 0.6"));
  EXPECT_TRUE(testing::contains(friction_error("model = \"dahl\""),
                                "the coefficient dynamic is missing; write dynamic = 0.4"));
  EXPECT_TRUE(testing::contains(friction_error("model = \"lugre\", static = 0.3, dynamic = 0"),
                                "has no friction at rest either"));
  EXPECT_EQ(friction_of("static = 0.3, dynamic = 0").coulomb, 0.0) << "a cone may let go at once";
}

TEST(FrictionDescription, ReadsAGrain) {
  const rendering::MaterialGrain grain =
      material_of("friction = { static = 0.6 }\ngrain = { direction = [0, 0, 2], across = 0.4 }")
          .grain;
  EXPECT_EQ(grain.direction_O, (rendering::Float3{0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(grain.along, 1.0);
  EXPECT_EQ(grain.across, 0.4);
  EXPECT_FALSE(material_of("friction = { static = 0.6 }").grain.differs());
}

TEST(FrictionDescription, RefusesGrainsThatMeanNothing) {
  const std::string friction = "friction = { static = 0.6 }\n";
  EXPECT_EQ(error_of(friction + "grain = { direction = [0, 0, 0], across = 0.4 }"),
            "folder/scene.toml:5: object 1 grain: direction is zero; write direction = [1.0, 0.0, "
            "0.0]");
  EXPECT_TRUE(testing::contains(error_of(friction + "grain = { across = 0.4 }"),
                                "the direction is missing"));
  EXPECT_TRUE(testing::contains(error_of(friction + "grain = { direction = [1, 0, 0] }"),
                                "neither along nor across is given"));
  EXPECT_TRUE(
      testing::contains(error_of(friction + "grain = { direction = [1, 0, 0], across = 1.4 }"),
                        "across is 1.4; write a factor from 0 to 1"));
  EXPECT_TRUE(testing::contains(error_of("grain = { direction = [1, 0, 0], across = 0.4 }"),
                                ":4: object 1: a grain without friction is not felt"));
  EXPECT_TRUE(testing::contains(error_of("contact = \"potential_field\"\n" + friction +
                                         "grain = { direction = [1, 0, 0], across = 0.4 }"),
                                "a potential field has no friction"));
}

TEST(FrictionDescription, ReachesTheImageWhole) {
  const testing::TemporaryFolder folder;
  const std::string text = kPlate +
                           "friction = { model = \"elasto_plastic\", static = 0.7, dynamic = 0.5, "
                           "viscous_s_per_m = 0.25, stribeck_velocity_m_per_s = 0.02, "
                           "stribeck_exponent = 1.5, stiffness_N_per_m = 700, damping_s_per_m = "
                           "0.01, damping_fade_m_per_s = 0.03, elastic_fraction = 0.6 }\n"
                           "grain = { direction = [3, 0, 4], along = 0.9, across = 0.4 }\n";
  const std::filesystem::path image = folder.path() / "scene.tactus";
  bake_file(folder.write("scene.toml", text), image);
  const MappedScene scene(image);
  const rendering::Material& stored = scene.image().objects()[0].material;
  const FrictionParameters& friction = stored.friction;
  EXPECT_EQ(friction.kind, FrictionKind::elasto_plastic);
  EXPECT_EQ(friction.static_level, 0.7);
  EXPECT_EQ(friction.coulomb, 0.5);
  EXPECT_EQ(friction.viscous_s_per_m, 0.25);
  EXPECT_EQ(friction.stribeck_velocity_m_per_s, 0.02);
  EXPECT_EQ(friction.stribeck_exponent, 1.5);
  EXPECT_EQ(friction.stiffness_N_per_m, 700.0);
  EXPECT_EQ(friction.damping_s_per_m, 0.01);
  EXPECT_EQ(friction.damping_fade_m_per_s, 0.03);
  EXPECT_EQ(friction.elastic_fraction, 0.6);
  EXPECT_EQ(stored.grain.direction_O, (rendering::Float3{0.6F, 0.0F, 0.8F}));
  EXPECT_EQ(stored.grain.along, 0.9);
  EXPECT_EQ(stored.grain.across, 0.4);
}

}  // namespace
}  // namespace tactus::host
