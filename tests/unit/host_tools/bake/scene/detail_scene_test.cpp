// Shading, textures, effects, tools and movers, from the text of a scene to the touch.
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <tuple>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/world/world.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::testing {
namespace {

using host::MappedScene;
using rendering::Object;
using rendering::TextureProjection;
using rendering::TextureUse;
using rendering::Touch;
using rendering::World;

const std::string kBall = "[[object]]\nprimitive = \"sphere\"\nradius_m = 0.03\n";
const std::string kPlate = "[[object]]\nmesh = \"plate.obj\"\n";

std::string picture(png_uint_32 format, png_uint_32 side, const std::vector<std::uint8_t>& texels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = side;
  image.height = side;
  image.format = format;
  png_alloc_size_t bytes = 0;
  png_image_write_get_memory_size(image, bytes, 0, texels.data(), 0, nullptr);
  std::string file(bytes, '\0');
  png_image_write_to_memory(&image, file.data(), &bytes, 0, texels.data(), 0, nullptr);
  file.resize(bytes);
  return file;
}

class DetailScene : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ignore =
        folder_.write("half.png", picture(PNG_FORMAT_GRAY, 2, {0, 255, 0, 255}));  // black left
    std::ignore = folder_.write("lean.png", picture(PNG_FORMAT_RGB, 1, {204, 128, 230}));
    // 40 mm x 40 mm in the plane y = 0, the picture once across; a second without coordinates.
    const std::string corners = "v -0.02 0 0.02\nv 0.02 0 0.02\nv 0.02 0 -0.02\nv -0.02 0 -0.02\n";
    std::ignore = folder_.write(
        "plate.obj", corners + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    std::ignore = folder_.write("bare.obj", corners + "f 1 2 3\nf 1 3 4\n");
  }

  MappedScene baked(const std::string& text) {
    host::bake_file(folder_.write("scene.toml", text), folder_.path() / "scene.tactus");
    return MappedScene(folder_.path() / "scene.tactus");
  }
  std::string error_of(const std::string& text) {
    return input_error([&] { baked(text); });
  }
  // Expects an error in a scene whose first line is [[object]] and whose third line is wrong.
  void expect_error(const std::string& text, std::string_view line, std::string_view part) {
    const std::string error = error_of(text);
    EXPECT_TRUE(contains(error, line));
    EXPECT_TRUE(contains(error, part));
  }

 private:
  TemporaryFolder folder_;
};

// The touch of a point tool that goes straight to each place in turn.
Touch press(const MappedScene& scene, const std::vector<Vec3>& places) {
  const auto world = std::make_unique<World>();
  EXPECT_TRUE(world->set_scene(scene.image().objects(),
                               {.tool_radius_m = 0.0, .effects = scene.image().effects()}));
  Touch touch;
  for (const Vec3& p : places) {
    touch = world->touch({.p_W = p});
  }
  return touch;
}

std::vector<Vec3> down_at(double x, double depth_m) {
  return {{x, 0.005, 0.003}, {x, -depth_m, 0.003}, {x, -depth_m, 0.003}, {x, -depth_m, 0.003}};
}

TEST_F(DetailScene, ATextureOverTexturesCoordinatesIsFeltWhereItLies) {
  const MappedScene scene =
      baked(kPlate +
            "stiffness_N_per_m = 1000.0\ntexture.stiffness = { image = \"half.png\", range = "
            "[0.5, 2.0] }\n");
  const Object& plate = scene.image().objects()[0];
  ASSERT_EQ(plate.detail.layers.size(), 1U);
  EXPECT_EQ(plate.detail.layers[0].projection, TextureProjection::uv);
  EXPECT_EQ(plate.detail.corner_places.size(), 2U);
  // The texels' centres lie a quarter of the picture from its sides.
  EXPECT_NEAR(press(scene, down_at(-0.01, 0.001)).force_W.y(), 0.5, 1e-3);
  EXPECT_NEAR(press(scene, down_at(0.01, 0.001)).force_W.y(), 2.0, 1e-3);
  EXPECT_NEAR(press(scene, down_at(0.0, 0.001)).force_W.y(), 1.25, 1e-3);
}

TEST_F(DetailScene, AProjectedTextureNeedsNoCoordinates) {
  const MappedScene scene = baked(
      "[[object]]\nmesh = \"bare.obj\"\nstiffness_N_per_m = 1000.0\ntexture.bump = { image = "
      "\"half.png\", height_m = 0.0004, projection = \"y\", tile_m = 0.04 }\n");
  const Object& plate = scene.image().objects()[0];
  EXPECT_TRUE(plate.detail.corner_places.empty());
  EXPECT_EQ(plate.detail.layers[0].use, TextureUse::bump);
  EXPECT_EQ(plate.detail.layers[0].high, 0.0004);
  // Tiles begin at the world's origin: black is centred at 10 mm.
  EXPECT_NEAR(press(scene, down_at(0.01, 0.001)).force_W.y(), 0.6, 5e-3);
  EXPECT_NEAR(press(scene, down_at(-0.01, 0.001)).force_W.y(), 1.0, 5e-3);
}

TEST_F(DetailScene, ANormalMapLeansTheForceOnAMeshAndOnAPrimitive) {
  const Vec3 map = (2.0 / 255.0 * Vec3{204, 128, 230} - Vec3::Ones()).normalized();
  for (const std::string& surface : {kPlate, std::string("[[object]]\nprimitive = \"plane\"\n")}) {
    const MappedScene scene =
        baked(surface + "texture.normal = { image = \"lean.png\", projection = \"y\" }\n");
    const Vec3 force = press(scene, down_at(0.0, 0.001)).force_W.normalized();
    EXPECT_LE((force - Vec3{map.x(), map.z(), -map.y()}).norm(), 0.01);
  }
}

TEST_F(DetailScene, AnImplicitSurfaceAndAFeatureWalkFeelTextures) {
  const std::string soft =
      "stiffness_N_per_m = 1000.0\ntexture.stiffness = { image = "
      "\"half.png\", range = [0.5, 0.5] }\n";
  const MappedScene formula = baked("[[object]]\nformula = \"y\"\n" + soft);
  EXPECT_NEAR(press(formula, down_at(0.0, 0.001)).force_W.y(), 0.5, 1e-3);
  const MappedScene walk = baked(kPlate + "contact = \"feature_walk\"\n" + soft);
  EXPECT_NEAR(press(walk, down_at(0.0, 0.001)).force_W.y(), 0.5, 1e-3);
  const MappedScene leaning =
      baked("[[object]]\nformula = \"y\"\ntexture.normal = { image = \"lean.png\" }\n");
  const Vec3 force = press(leaning, down_at(0.0, 0.001)).force_W;
  EXPECT_NEAR(force.x() / force.y(), (204.0 * 2 / 255 - 1) / (230.0 * 2 / 255 - 1), 0.01);
}

TEST_F(DetailScene, ShadingIsBakedWithItsAngleLimit) {
  const MappedScene flat = baked(kPlate);
  EXPECT_TRUE(flat.image().objects()[0].detail.empty());
  const MappedScene shaded = baked(kPlate + "shading = { angle_limit_deg = 30 }\n");
  const Object& plate = shaded.image().objects()[0];
  ASSERT_EQ(plate.detail.corner_normals.size(), 2U);
  EXPECT_LE((decode(plate.detail.corner_normals[0][0]) - Vec3::UnitY()).norm(), 1e-4);
  EXPECT_EQ(baked(kPlate + "shading = {}\n").image().objects()[0].detail.corner_normals.size(), 2U);
}

TEST_F(DetailScene, ToolsAndMoversAreCarriedOver) {
  const MappedScene scene = baked("[tool]\ncount = 3\n" + kBall + "moves = true\n" +
                                  "[[object]]\nprimitive = \"plane\"\n");
  EXPECT_EQ(scene.image().tool_count(), 3U);
  EXPECT_TRUE(scene.image().objects()[0].moves);
  EXPECT_FALSE(scene.image().objects()[1].moves);
  EXPECT_EQ(baked(kBall).image().tool_count(), 1U);
}

TEST_F(DetailScene, MistakesInTexturesAreToldWithLineAndRemedy) {
  const std::string texture = "texture.bump = { image = \"half.png\", height_m = 0.001 ";
  expect_error(kPlate + "texture.bumps = {}\n", "scene.toml:3", "did you mean bump?");
  expect_error(kPlate + "texture.bump = { height_m = 1.0 }\n", "scene.toml:3", "write image = ");
  expect_error(kPlate + "texture.bump = { image = \"half.png\" }\n", "scene.toml:3",
               "write height_m = 0.0002");
  expect_error(kPlate + "texture.bump = { image = \"half.png\", height_mm = 0.2 }\n",
               "scene.toml:3", "write height_m = 0.0002");
  expect_error(kPlate + "texture.bump = { image = \"half.png\", height_m = 0.2 }\n", "scene.toml:3",
               "write a number up to 0.1");
  expect_error(kPlate + texture + ", projection = \"w\" }\n", "scene.toml:3",
               "no projection \"w\"");
  expect_error(kPlate + texture + ", tile_m = 0.0 }\n", "scene.toml:3", "above 0");
  expect_error(kPlate + texture + ", tile_m = 1e-9 }\n", "scene.toml:3", "from 1e-05 to 100");
  expect_error(kPlate + texture + ", projection = \"uv\", tile_m = 0.1 }\n", "scene.toml:3",
               "leave tile_m out");
  expect_error(kBall + texture + ", projection = \"uv\" }\n", "scene.toml:4", "for meshes");
  expect_error("[[object]]\nmesh = \"bare.obj\"\n" + texture + ", projection = \"uv\" }\n",
               "scene.toml:3", "no texture coordinates");
  expect_error(kPlate + "texture.friction = { image = \"half.png\", range = [0.0, 101.0] }\n",
               "scene.toml:3", "each from 0 to 100");
  expect_error(kPlate + "texture.friction = { image = \"half.png\", range = 2 }\n", "scene.toml:3",
               "must be 2 numbers; write range = [0.0, 1.0]");
  expect_error(kPlate + "texture.friction = { image = \"none.png\" }\n", "scene.toml:3",
               "there is no image file");
  expect_error(kPlate + "texture.normal = { image = \"half.png\" }\n", "scene.toml:3", "is grey");
  EXPECT_TRUE(
      contains(error_of(kPlate + "texture.friction = { image = \"plate.obj\" }\n"), "plate.obj"));
  expect_error(
      kBall + "contact = \"potential_field\"\ntexture.friction = { image = \"half.png\" }\n",
      "scene.toml:5", "a potential field has no texture");
}

TEST_F(DetailScene, MistakesInShadingToolsAndMoversAreToldWithLineAndRemedy) {
  expect_error(kBall + "shading = {}\n", "scene.toml:4", "are exact");
  expect_error(kPlate + "shading = { angle_limit_deg = 181 }\n", "scene.toml:3", "up to 180");
  expect_error(kPlate + "shading = { angle_limit_rad = 1 }\n", "scene.toml:3",
               "write angle_limit_deg = 57.29577951");
  expect_error(kPlate + "shading = 40\n", "scene.toml:3", "must be a table");
  expect_error(kPlate + "moves = \"yes\"\n", "scene.toml:3", "write moves = true");
  for (const char* bad : {"0", "11", "1.5", "\"two\""}) {
    expect_error(std::string("[tool]\ncount = ") + bad + "\n" + kBall, "scene.toml:2",
                 "a whole number from 1 to 10");
  }
}

std::string effect(const std::string& lines) {
  return kBall + "position_m = [0.0, -1.0, 0.0]\n[[effect]]\n" + lines;
}

TEST_F(DetailScene, EffectsPushByTheirClosedForms) {
  const Vec3 tool{0.01, 0.02, -0.02};
  const auto felt = [&](const std::string& lines) {
    return press(baked(effect(lines)), {tool, tool}).force_W;
  };
  const std::string bound = "max_force_N = 10.0\n";
  EXPECT_LE(
      (felt("law = \"spring\"\nposition_m = [0.02, 0.02, 0.0]\nstiffness_N_per_m = 50\n" + bound) -
       50.0 * Vec3{0.01, 0.0, 0.02})
          .norm(),
      1e-12);
  EXPECT_LE(
      (felt("law = \"spring_damper\"\nstiffness_N_per_m = 50\ndamping_Ns_per_m = 1\n" + bound) +
       50.0 * tool)
          .norm(),
      1e-12);
  EXPECT_LE((felt("law = \"constant_field\"\nforce_N = [0.0, -0.5, 0.0]\n" + bound) -
             Vec3{0.0, -0.5, 0.0})
                .norm(),
            1e-12);
  // S d / (d^2 + c^2)^(3/2), with the strongest pull of 2 N at d = c / sqrt 2.
  const double core = 0.01;
  const double pole = 2.0 * 1.5 * std::sqrt(3.0) * core * core;
  EXPECT_LE((felt("law = \"magnet\"\nstrength_N = 2.0\ncore_m = 0.01\n" + bound) +
             pole / std::pow(tool.squaredNorm() + core * core, 1.5) * tool)
                .norm(),
            1e-12);
  EXPECT_LE((felt("law = \"snap_to_point\"\nstiffness_N_per_m = 50\ncapture_m = 0.1\n" + bound) +
             50.0 * tool)
                .norm(),
            1e-12);
  EXPECT_LE((felt("law = \"snap_to_line\"\ndirection = [0, 2, 0]\nstiffness_N_per_m = 50\n"
                  "capture_m = 0.1\n" +
                  bound) +
             50.0 * Vec3{0.01, 0.0, -0.02})
                .norm(),
            1e-12);
  EXPECT_LE((felt("law = \"snap_to_plane\"\ndirection = [0, 2, 0]\nstiffness_N_per_m = 50\n"
                  "capture_m = 0.1\n" +
                  bound) +
             50.0 * Vec3{0.0, 0.02, 0.0})
                .norm(),
            1e-12);
  EXPECT_LE(
      felt("law = \"stick_slip\"\nstiffness_N_per_m = 50\nbreak_force_N = 1\n" + bound).norm(),
      1e-12);
  EXPECT_NEAR(felt("law = \"spring\"\nstiffness_N_per_m = 500\nmax_force_N = 0.25\n").norm(), 0.25,
              1e-12);
}

TEST_F(DetailScene, EffectsOfMotionAndTimeAreFelt) {
  const MappedScene honey = baked(effect(
      "law = \"fluid_drag\"\nprimitive = \"box\"\nsize_m = [0.1, 0.1, 0.1]\nposition_m = [0.0, "
      "0.0, 0.01]\ndamping_Ns_per_m = 2.0\nquadratic_Ns2_per_m2 = 3.0\nmax_force_N = 10.0\n"));
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene(honey.image().objects(), {.effects = honey.image().effects()}));
  const Vec3 v{0.3, 0.0, -0.4};
  EXPECT_LE((world->touch({.p_W = {0.0, 0.0, 0.059}, .v_W = v}).force_W + 3.5 * v).norm(), 1e-12);
  EXPECT_EQ(world->touch({.p_W = {0.0, 0.0, -0.041}, .v_W = v}).force_W, Vec3::Zero());

  const MappedScene buzz = baked(
      effect("law = \"vibration\"\ndirection = [0, 0, 3]\namplitude_N = 0.5\nfrequency_Hz = 50\n"
             "max_force_N = 1.0\n"));
  ASSERT_TRUE(world->set_scene(buzz.image().objects(), {.effects = buzz.image().effects()}));
  ASSERT_TRUE(world->set_tick(0.002));
  for (int tick = 0; tick < 100; ++tick) {
    const double expected = 0.5 * std::sin(2.0 * std::numbers::pi * 50.0 * 0.002 * tick);
    EXPECT_NEAR(world->touch({}).force_W.z(), expected, 1e-12);
  }
}

TEST_F(DetailScene, TheAccountOfAnEffectIsBounded) {
  const MappedScene scene =
      baked(effect("law = \"spring\"\nstiffness_N_per_m = 200\nmax_force_N = 10\n"));
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene(scene.image().objects(), {.effects = scene.image().effects()}));
  const Vec3 start{0.02, 0.01, 0.0};
  const double stored = 0.5 * 200.0 * start.squaredNorm();
  double sampling = 0.0;
  Vec3 last = start;
  for (int tick = 0; tick < 5000; ++tick) {
    const double a = 0.003 * tick;
    const Vec3 tool =
        start + Vec3{0.02 * std::sin(a), -0.01 * std::sin(2.7 * a), 0.015 * (1 - std::cos(a))};
    world->touch({.p_W = tool});
    sampling += 0.5 * 200.0 * (tool - last).squaredNorm();
    last = tool;
    ASSERT_LE(world->delivered_J(0), stored - 0.5 * 200.0 * tool.squaredNorm() + sampling + 1e-12);
  }
  const Touch invalid = world->touch({.p_W = Vec3::Constant(std::nan(""))});
  EXPECT_EQ(invalid.force_W, Vec3::Zero());
  const double before = world->delivered_J(0);
  world->touch({.p_W = Vec3::Zero()});
  EXPECT_EQ(world->delivered_J(0), before) << "nothing was felt on the way";
}

TEST_F(DetailScene, MistakesInEffectsAreToldWithLineAndRemedy) {
  const auto refused = [&](const std::string& lines, std::string_view line, std::string_view part) {
    expect_error(effect(lines), line, part);
  };
  refused("max_force_N = 1.0\n", "scene.toml:5: effect 1", "the law is missing");
  refused("law = \"springs\"\n", "scene.toml:6", R"(no law "springs"; write one of "spring")");
  refused("law = \"spring\"\nstiffness_N_per_m = 5\n", "scene.toml:5", "write max_force_N = 3.0");
  refused("law = \"spring\"\nmax_force_N = 1\n", "scene.toml:5", "write stiffness_N_per_m = 200");
  refused("law = \"spring\"\nmax_force_mN = 100\n", "scene.toml:7", "write max_force_N = 0.1");
  refused("law = \"spring\"\nstiffness_N_per_m = 5\nmax_force_N = 0\n", "scene.toml:8", "above 0");
  refused("law = \"spring\"\ncapture_m = 0.1\n", "scene.toml:7", "unknown key 'capture_m'");
  refused("law = \"vibration\"\ndirection = [0, 0, 0]\n", "scene.toml:7", "direction is zero");
  refused("law = \"vibration\"\ndirection = [0, 1, 0]\namplitude_N = 1\nfrequency_kHz = 0.12\n",
          "scene.toml:9", "write frequency_Hz = 120");
  refused("law = \"fluid_drag\"\nmax_force_N = 1\n", "scene.toml:5", "the volume is missing");
  refused("law = \"fluid_drag\"\nprimitive = \"sphere\"\n", "scene.toml:5", "needs radius_m");
  refused("law = \"constant_field\"\nmax_force_N = 1\n", "scene.toml:5", "write force_N = ");
  expect_error(kBall + "[effect]\nlaw = \"spring\"\n", "scene.toml:4", "with two brackets");
  std::string many = kBall;
  for (int i = 0; i < 17; ++i) {
    many += "[[effect]]\nlaw = \"spring\"\nstiffness_N_per_m = 1\nmax_force_N = 1\n";
  }
  EXPECT_TRUE(contains(error_of(many), "17 effects, where 16 fit"));
}

}  // namespace
}  // namespace tactus::testing
