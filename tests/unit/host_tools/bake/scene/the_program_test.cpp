// Runs the tactus program as a user does.
#include <gtest/gtest.h>

#include <algorithm>

#include "host_tools/files/atomic_file.h"
#include "tests/support/run_program.h"
#include "tests/unit/host_tools/bake/scene/box_files.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::Outcome;
using testing::TemporaryFolder;

class TheProgram : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) {
    return testing::run_program(folder.path(), arguments);
  }

  void expect_bad_input(const std::string& arguments, std::string_view message) {
    const Outcome result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(contains(result.output, message));
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
  }

  void write_box_scene() {
    (void)folder.write("box.off", testing::box_files().front().content);
    (void)folder.write("scene.toml", "[[object]]\nmesh = \"box.off\"\nscale = 0.01\n");
  }

  TemporaryFolder folder;
};

TEST_F(TheProgram, BakesBesideTheSceneAndInspects) {
  write_box_scene();
  const Outcome bake = run("bake scene.toml");
  EXPECT_EQ(bake.exit_code, 0);
  EXPECT_TRUE(contains(bake.output, "scene.tactus: "));
  const Outcome inspect = run("inspect scene.tactus");
  EXPECT_EQ(inspect.exit_code, 0);
  EXPECT_TRUE(contains(inspect.output, "triangles  12, vertices 8"));
  EXPECT_TRUE(contains(inspect.output, "(0, 0, 0) to (0.01, 0.02, 0.03) m"));
}

TEST_F(TheProgram, PrintsOneJsonObjectALine) {
  write_box_scene();
  const Outcome bake = run("bake scene.toml -o other.tactus --json");
  EXPECT_TRUE(bake.output.starts_with("{\"image\":\"other.tactus\"")) << bake.output;
  EXPECT_EQ(std::ranges::count(bake.output, '\n'), 1);
  EXPECT_TRUE(contains(bake.output, "\"triangles\":12,\"vertices\":8,\"dropped_triangles\":0"));
  const Outcome inspect = run("inspect other.tactus --json");
  EXPECT_TRUE(contains(inspect.output, "\"version\":4"));
  EXPECT_EQ(std::ranges::count(inspect.output, '\n'), 1);
}

TEST_F(TheProgram, InspectShowsTheVolumeAndOffersFlip) {
  write_box_scene();
  ASSERT_EQ(run("bake scene.toml").exit_code, 0);
  EXPECT_TRUE(
      contains(run("inspect scene.tactus").output, "  volume     6e-06 m^3 in 1 closed part\n"));
  (void)folder.write("scene.toml", "[[object]]\nmesh = \"box.off\"\nscale = 0.01\nflip = true\n");
  EXPECT_TRUE(contains(run("bake scene.toml").output, "leave flip = true out"));
  const Outcome flipped = run("inspect scene.tactus");
  EXPECT_TRUE(contains(flipped.output, "  volume     -6e-06 m^3 in 1 closed part\n"));
  EXPECT_TRUE(contains(flipped.output, "write flip = true at the object"));
  EXPECT_TRUE(contains(run("inspect scene.tactus --json").output, "\"parts_inside_out\":1"));
}

TEST_F(TheProgram, TouchGuessesThatAPathIsInMillimetres) {
  write_box_scene();
  (void)folder.write("path.csv", "t_s;x_m;y_m;z_m\n0,0;1;1;1\n0,001;40;50,5;1\n");
  ASSERT_EQ(run("bake scene.toml").exit_code, 0);
  EXPECT_TRUE(contains(run("touch scene.tactus --path path.csv -o out.csv").output,
                       "tactus touch: warning: path.csv:3: the tool is 64.43 m from the world's "
                       "origin; if the file has millimetres, divide its positions by 1000"));
}

TEST_F(TheProgram, ShowsFrictionAndGrain) {
  (void)folder.write("box.off", testing::box_files().front().content);
  (void)folder.write("scene.toml",
                     "[[object]]\nmesh = \"box.off\"\nscale = 0.01\n"
                     "friction = { model = \"dahl\", dynamic = 0.5, stiffness_N_per_m = 300 }\n"
                     "grain = { direction = [0, 0, 1], across = 0.4 }\n");
  ASSERT_EQ(run("bake scene.toml").exit_code, 0);
  const Outcome text = run("inspect scene.tactus");
  EXPECT_TRUE(contains(text.output,
                       "  friction   dahl, dynamic 0.5, viscous_s_per_m 0, stiffness_N_per_m 300\n"
                       "  grain      direction (0, 0, 1), along 1, across 0.4\n"));
  const Outcome json = run("inspect scene.tactus --json");
  EXPECT_TRUE(contains(json.output,
                       R"("friction":{"model":"dahl","dynamic":0.5,"viscous_s_per_m":0.0,)"
                       R"("stiffness_N_per_m":300.0},)"
                       R"("grain":{"direction":[0.0,0.0,1.0],"along":1.0,"across":0.4})"));
}

TEST_F(TheProgram, IsQuietWhenAsked) {
  write_box_scene();
  EXPECT_EQ(run("bake scene.toml --quiet").output, "");
}

TEST_F(TheProgram, EndsWithTwoAndOneLineThatNamesFileAndPlace) {
  write_box_scene();
  expect_bad_input("bake none.toml", "tactus bake: none.toml: cannot read: No such file");
  (void)folder.write("key.toml", "[[object]]\nmesh = \"box.off\"\nstiffness = 3\n");
  expect_bad_input("bake key.toml", "tactus bake: key.toml:3: object 1: unknown key 'stiffness'");
  (void)folder.write("missing.toml", "[[object]]\nmesh = \"none.off\"\n");
  expect_bad_input("bake missing.toml",
                   "tactus bake: missing.toml:2: there is no mesh file none.off");
  (void)folder.write("nan.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n");
  (void)folder.write("nan.toml", "[[object]]\nmesh = \"nan.off\"\n");
  expect_bad_input("bake nan.toml", "tactus bake: nan.off:4: vertex 1 is not finite");
  expect_bad_input("inspect scene.toml", "tactus inspect: scene.toml: byte 0: not a Tactus scene");
}

TEST_F(TheProgram, RefusesADamagedImage) {
  write_box_scene();
  ASSERT_EQ(run("bake scene.toml").exit_code, 0);
  std::string image = read_file(folder.path() / "scene.tactus");
  (void)folder.write("short.tactus", image.substr(0, image.size() - 1));
  expect_bad_input(
      "inspect short.tactus",
      "short.tactus: byte " + std::to_string(image.size() - 1) + ": image is cut short");
  image[image.size() / 2] ^= 4;
  (void)folder.write("flipped.tactus", image);
  expect_bad_input("inspect flipped.tactus", "flipped.tactus: checksum does not match");
}

TEST_F(TheProgram, EndsWithTwoOnAWrongCommandLine) {
  expect_bad_input("", "tactus: say what to do");
  expect_bad_input("stroke", "tactus: there is no verb 'stroke'");
  expect_bad_input("bake", "tactus bake: scene is required");
  expect_bad_input("inspect a b", "tactus inspect: ");
  expect_bad_input("bake a --fast", "tactus bake: ");
}

TEST_F(TheProgram, EndsEveryHelpWithExamples) {
  EXPECT_EQ(run("--version").output.rfind("tactus ", 0), 0U);
  const Outcome help = run("--help");
  EXPECT_EQ(help.exit_code, 0);
  for (const char* verb : {"bake", "inspect"}) {
    EXPECT_TRUE(contains(help.output, verb));
    const Outcome verb_help = run(std::string(verb) + " --help");
    EXPECT_EQ(verb_help.exit_code, 0);
    EXPECT_TRUE(contains(verb_help.output, std::string("Examples:\n  tactus ") + verb));
  }
}

}  // namespace
}  // namespace tactus::host
