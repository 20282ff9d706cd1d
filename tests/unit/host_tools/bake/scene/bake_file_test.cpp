#include "host_tools/bake/scene/bake.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/files/atomic_file.h"
#include "tests/support/shapes.h"
#include "tests/unit/host_tools/bake/scene/box_files.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::input_error;
using testing::TemporaryFolder;

constexpr const char* kScene = R"([tool]
radius_m = 0.001
[[object]]
mesh = "box.off"
longest_side_m = 0.3
)";
constexpr const char* kTriangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::size_t count_files(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(std::ranges::distance(
      std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()));
}

TEST(BakeFile, WritesAnImageThatOpensWithTheBoxPlaced) {
  const TemporaryFolder folder;
  (void)folder.write("box.off", testing::box_files().front().content);
  const std::filesystem::path image = folder.path() / "scene.tactus";
  const BakeReport report = bake_file(folder.write("scene.toml", kScene), image);
  ASSERT_EQ(report.objects.size(), 1U);
  EXPECT_EQ(report.objects[0].triangles, 12U);
  EXPECT_EQ(report.objects[0].vertices, 8U);
  EXPECT_TRUE(report.objects[0].warnings.empty());
  EXPECT_EQ(report.bytes, std::filesystem::file_size(image));

  const MappedScene scene(image);
  EXPECT_EQ(scene.image().tool_radius_m(), 0.001);
  EXPECT_EQ(scene.image().object_name(0), "box");
  const rendering::BvhNode& root = scene.image().objects()[0].mesh.nodes[0];
  EXPECT_EQ(root.lower, (rendering::Float3{-0.05F, -0.1F, -0.15F}));
  EXPECT_EQ(root.upper, (rendering::Float3{0.05F, 0.1F, 0.15F}));
}

TEST(BakeFile, WritesTheSameBytesEveryTime) {
  const TemporaryFolder folder;
  (void)folder.write("box.off", testing::box_files().front().content);
  const std::filesystem::path scene = folder.write("scene.toml", kScene);
  bake_file(scene, folder.path() / "a.tactus");
  bake_file(scene, folder.path() / "b.tactus");
  EXPECT_EQ(read_file(folder.path() / "a.tactus"), read_file(folder.path() / "b.tactus"));
}

TEST(BakeFile, KeepsTheOldImageAndLeavesNothingBehindWhenItFails) {
  const TemporaryFolder folder;
  const std::filesystem::path image = folder.write("scene.tactus", "the old one");
  const std::filesystem::path scene = folder.write("scene.toml", kScene);
  EXPECT_TRUE(contains(input_error([&] { bake_file(scene, image); }),
                       "scene.toml:4: there is no mesh file"));
  (void)folder.write("box.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
  EXPECT_TRUE(contains(input_error([&] { bake_file(scene, image); }), "box.off:4: "));
  EXPECT_EQ(read_file(image), "the old one");
  EXPECT_EQ(count_files(folder), 3U);
}

TEST(BakeFile, NamesAnOutputThatCannotBeWritten) {
  const TemporaryFolder folder;
  (void)folder.write("box.off", kTriangle);
  const std::filesystem::path scene = folder.write("scene.toml", kScene);
  EXPECT_TRUE(contains(input_error([&] { bake_file(scene, folder.path() / "no/scene.tactus"); }),
                       "no/scene.tactus: cannot write: No such file"));
  std::filesystem::create_directory(folder.path() / "taken");
  EXPECT_TRUE(contains(input_error([&] { bake_file(scene, folder.path() / "taken"); }),
                       "taken: is a folder; name a file in it"));
  EXPECT_EQ(count_files(folder), 3U) << "no partial file is left";
}

TEST(BakeFile, WarnsOfAnOpenMeshWithOneSide) {
  const TemporaryFolder folder;
  (void)folder.write("box.off", kTriangle);
  const std::filesystem::path image = folder.path() / "scene.tactus";
  const BakeReport one = bake_file(folder.write("one.toml", kScene), image);
  ASSERT_EQ(one.objects[0].warnings.size(), 1U);
  EXPECT_TRUE(contains(one.objects[0].warnings[0], "3 open"));
  EXPECT_TRUE(contains(one.objects[0].warnings[0], "write sides = \"two\""));
  const BakeReport two =
      bake_file(folder.write("two.toml", std::string(kScene) + "sides = \"two\"\n"), image);
  EXPECT_TRUE(two.objects[0].warnings.empty());
}

TEST(BakeFile, ReportsDegenerateTriangles) {
  const TemporaryFolder folder;
  (void)folder.write("box.off",
                     "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0.5 0 0\n3 0 1 2\n3 0 1 1\n3 0 1 3\n");
  const BakeReport report =
      bake_file(folder.write("scene.toml", kScene), folder.path() / "scene.tactus");
  EXPECT_EQ(report.objects[0].triangles, 1U);
  EXPECT_EQ(report.objects[0].counters.degenerate_triangles, 2U);
  EXPECT_TRUE(contains(report.objects[0].warnings.back(), "2 triangles without area"));
}

TEST(BakeFile, NamesTheMeshOfWhichNothingIsLeft) {
  const TemporaryFolder folder;
  (void)folder.write("box.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  EXPECT_TRUE(contains(
      input_error([&] { bake_file(folder.write("scene.toml", kScene), folder.path() / "x"); }),
      "box.off: no triangle with an area is left (1 dropped)"));
}

TEST(BakeFile, TellsItsSteps) {
  const TemporaryFolder folder;
  (void)folder.write("box.off", kTriangle);
  std::vector<std::string> steps;
  bake_file(folder.write("scene.toml", kScene), folder.path() / "scene.tactus",
            [&](std::string_view step) { steps.emplace_back(step); });
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_TRUE(steps[0].starts_with("box: reading"));
  EXPECT_EQ(steps[1], "box: baking 1 triangles");
}

TEST(Image, TakesAtMostAHundredBytesATriangle) {
  const testing::Shape sphere = testing::icosphere(0.1, 6);
  const BakedMesh mesh = bake_mesh(sphere.vertices, sphere.triangles);
  const std::vector<std::byte> image =
      write_image({.tool_radius_m = 0.0,
                   .objects = {{.name = "sphere", .sides = {}, .material = {}, .mesh = mesh}}});
  EXPECT_LE(image.size(), 100 * sphere.triangles.size());
}

TEST(Image, RefusesNoneAndTooManyObjects) {
  EXPECT_TRUE(contains(input_error([] { write_image({}); }), "0 objects, where 1 to 1024 fit"));
  BakedScene scene;
  scene.objects.resize(1025);
  EXPECT_TRUE(contains(input_error([&] { write_image(scene); }), "1025 objects"));
}

TEST(MappedScene, NamesAFileThatIsNoImage) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(input_error([&] { MappedScene(folder.path() / "no.tactus"); }),
                       "no.tactus: cannot read: No such file"));
  EXPECT_TRUE(contains(input_error([&] { MappedScene{folder.path()}; }), "is not a file"));
  EXPECT_TRUE(contains(input_error([&] { MappedScene(folder.write("a.tactus", "")); }),
                       "a.tactus: byte 0: image is cut short"));
  EXPECT_TRUE(contains(input_error([&] { MappedScene(folder.write("a.tactus", "solid a")); }),
                       "a.tactus: byte 0: not a Tactus scene image"));
}

TEST(MappedScene, StaysOpenWhereItIsMovedAndWhenItsFileIsReplaced) {
  const TemporaryFolder folder;
  (void)folder.write("box.off", kTriangle);
  const std::filesystem::path scene = folder.write("scene.toml", kScene);
  const std::filesystem::path image = folder.path() / "scene.tactus";
  bake_file(scene, image);
  MappedScene first(image);
  const MappedScene second(std::move(first));
  (void)folder.write("box.off", testing::box_files().front().content);
  bake_file(scene, image);
  EXPECT_EQ(second.image().objects()[0].mesh.triangles.size(), 1U);
  EXPECT_EQ(second.image().objects()[0].mesh.vertices[1].y, -0.15F);
  EXPECT_EQ(MappedScene(image).image().objects()[0].mesh.triangles.size(), 12U);
}

TEST(MappedScene, ExplainsWhereAnImageIsWrong) {
  EXPECT_EQ(explain({.fault = rendering::SceneFault::vertex_index, .object = 2, .place = 17}),
            "object 2: triangle 17: vertex index is out of range; bake the scene again");
  EXPECT_EQ(explain({.fault = rendering::SceneFault::newer_version,
                     .object = rendering::kNoObject,
                     .place = 9}),
            "version 9: image format is newer than this program reads; update the program");
}

}  // namespace
}  // namespace tactus::host
