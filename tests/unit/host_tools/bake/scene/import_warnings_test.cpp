#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/closed_volume.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "tests/unit/host_tools/bake/scene/box_files.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::input_error;
using testing::TemporaryFolder;

// The box of 1 x 2 x 3 as OFF, with its corners multiplied and moved along x.
std::string box_off(double factor, double offset = 0.0, bool inside_out = false) {
  std::string text = "OFF\n8 12 0\n";
  for (const auto& c : testing::kBoxCorners) {
    text += std::to_string(factor * static_cast<double>(c[0]) + offset) + " " +
            std::to_string(factor * static_cast<double>(c[1])) + " " +
            std::to_string(factor * static_cast<double>(c[2])) + "\n";
  }
  for (const auto& t : testing::kBoxTriangles) {
    text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[inside_out ? 2 : 1]) + " " +
            std::to_string(t[inside_out ? 1 : 2]) + "\n";
  }
  return text;
}

// The warnings of baking a scene of one mesh with these keys.
std::vector<std::string> import_warnings(const std::string& mesh, const std::string& keys) {
  const TemporaryFolder folder;
  (void)folder.write("a.off", mesh);
  const auto scene = folder.write("scene.toml", "[[object]]\nmesh = \"a.off\"\n" + keys + "\n");
  const BakeReport report = bake_file(scene, folder.path() / "a.tactus");
  std::vector<std::string> result = report.objects.at(0).warnings;
  for (std::string& warning : result) {
    EXPECT_TRUE(warning.starts_with((folder.path() / "a.off").string())) << warning;
    warning = warning.substr(std::min(warning.size(), folder.path().string().size() + 1));
  }
  return result;
}

TEST(ImportWarnings, TellOfAnInsideOutMeshAndFlipMendsIt) {
  const auto without = import_warnings(box_off(0.1, 0.0, true), "");
  ASSERT_EQ(without.size(), 1U);
  EXPECT_EQ(without[0],
            "a.off: the mesh is inside out: it is closed and its volume is -0.006 m^3, so the tool "
            "goes in unfelt and is held inside; write flip = true at the object");
  EXPECT_TRUE(import_warnings(box_off(0.1, 0.0, true), "flip = true").empty());
  EXPECT_TRUE(import_warnings(box_off(0.1), "flip = false").empty());
  EXPECT_TRUE(
      contains(import_warnings(box_off(0.1), "flip = true").at(0), "leave flip = true out"));
}

TEST(ImportWarnings, FlipTurnsTheTrianglesOfTheImageAround) {
  const TemporaryFolder folder;
  (void)folder.write("a.off", box_off(0.1, 0.0, true));
  const auto image = folder.path() / "a.tactus";
  bake_file(folder.write("s.toml", "[[object]]\nmesh = \"a.off\"\nflip = true\n"), image);
  const MappedScene scene(image);
  EXPECT_NEAR(closed_volume(scene.image().baked_mesh(0))->volume_m3, 0.006, 1e-8);
}

TEST(ImportWarnings, FlipIsForMeshesAlone) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& shape) {
    return input_error([&] {
      bake_file(folder.write("s.toml", "[[object]]\n" + shape + "\nflip = true\n"),
                folder.path() / "a.tactus");
    });
  };
  EXPECT_TRUE(contains(error("primitive = \"sphere\"\nradius_m = 0.1"),
                       "s.toml:4: object 1: flip is for meshes; leave it out"));
  EXPECT_TRUE(contains(error("formula = \"x^2+y^2+z^2-1\""), "negate the formula"));
}

TEST(ImportWarnings, GuessTheUnitOfAMeshOfAbsurdSize) {
  const auto huge = import_warnings(box_off(25.0), "");
  ASSERT_EQ(huge.size(), 1U);
  EXPECT_EQ(huge[0],
            "a.off: the object is 75 m long; its file looks like millimetres: write scale = 0.001, "
            "which makes it 0.075 m");
  EXPECT_TRUE(contains(import_warnings(box_off(2.5), "scale = 10").at(0), "write scale = 0.01, "));
  EXPECT_TRUE(contains(import_warnings(box_off(1.0), "longest_side_m = 80").at(0),
                       "write longest_side_m = 0.08"));
  EXPECT_TRUE(contains(import_warnings(box_off(1e4), "").at(0), "write longest_side_m = 0.1"));
  EXPECT_TRUE(contains(import_warnings(box_off(0.1), "scale = 0.001").at(0),
                       "the object is 0.0003 m long; write longest_side_m = 0.1"));
  EXPECT_TRUE(import_warnings(box_off(25.0), "scale = 0.001").empty());
  EXPECT_TRUE(import_warnings(box_off(1.0), "").empty());
}

TEST(ImportWarnings, TellOfAnObjectOutsideTheWorld) {
  const auto far = import_warnings(box_off(0.1, 4649776.0), "");
  ASSERT_FALSE(far.empty());
  EXPECT_TRUE(contains(far.back(),
                       "a.off: the object reaches 4.64978e+06 m from the world's origin, "
                       "where the world ends at 100 m; correct position_m, or write "
                       "longest_side_m, which centres the mesh"));
  EXPECT_TRUE(
      contains(import_warnings(box_off(0.1), "position_m = [0, 500, 0]").at(0), "reaches 500.2 m"));
}

TEST(ImportWarnings, AMeshFarFromItsOriginKeepsItsShape) {
  const TemporaryFolder folder;
  (void)folder.write("a.off", box_off(1.0, 4649776.0));
  const auto image = folder.path() / "a.tactus";
  const BakeReport report = bake_file(
      folder.write("s.toml", "[[object]]\nmesh = \"a.off\"\nlongest_side_m = 0.3\n"), image);
  EXPECT_TRUE(report.objects[0].warnings.empty());
  const MappedScene scene(image);
  const auto root = scene.image().objects()[0].mesh.nodes[0];
  EXPECT_EQ(root.lower, (rendering::Float3{-0.05F, -0.1F, -0.15F}));
  EXPECT_EQ(root.upper, (rendering::Float3{0.05F, 0.1F, 0.15F}));
}

TEST(ImportWarnings, HaveTheNotesOfTheImport) {
  const auto rest = import_warnings(box_off(0.1) + "3 0 1 2\n", "");
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_TRUE(rest[0].starts_with("a.off:23: 1 lines after the 12 faces")) << rest[0];
}

}  // namespace
}  // namespace tactus::host
