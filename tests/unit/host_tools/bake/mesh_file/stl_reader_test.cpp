#include "host_tools/bake/mesh_file/stl_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "tests/unit/host_tools/bake/mesh_file/measured.h"
#include "tests/unit/host_tools/bake/scene/box_files.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::input_error;
using testing::volume;

ImportedMesh stl(std::string_view content) {
  return cut_into_triangles(read_stl("a.stl", content), "a.stl");
}

std::string box_stl(std::string_view name) {
  for (const testing::BoxFile& file : testing::box_files()) {
    if (file.name == name) {
      return file.content;
    }
  }
  return {};
}

// A facet with the corners of these numbers of a box of 1 x 2 x 3.
std::string stl_facet(std::initializer_list<int> corners) {
  constexpr std::array kBox{"0 0 0", "1 0 0", "1 2 0", "0 2 0", "0 0 3", "1 0 3", "1 2 3", "0 2 3"};
  std::string text = "facet normal 0 0 0\nouter loop\n";
  for (const int corner : corners) {
    text += std::string("vertex ") + kBox[static_cast<std::size_t>(corner)] + "\n";
  }
  return text + "endloop\nendfacet\n";
}

void expect_stl_box(const ImportedMesh& mesh) {
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_NEAR(volume(mesh), 6.0, 1e-12);
}

TEST(StlReader, ReadsFacetsOfFourVertices) {
  const ImportedMesh mesh = stl("solid q\n" + stl_facet({0, 3, 2, 1}) + stl_facet({4, 5, 6, 7}) +
                                stl_facet({0, 1, 5, 4}) + stl_facet({3, 7, 6, 2}) +
                                stl_facet({0, 4, 7, 3}) + stl_facet({1, 2, 6, 5}) + "endsolid q\n");
  expect_stl_box(mesh);
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(StlReader, ReadsKeywordsInCapitals) {
  std::string text = box_stl("ascii.stl");
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  expect_stl_box(stl(text));
}

TEST(StlReader, ReadsABinaryFileWhoseTitleBeginsLikeAText) {
  std::string content = box_stl("binary.stl");
  content.replace(0, 10, "solid cube");
  expect_stl_box(stl(content));
  const ImportedMesh longer = stl(content + std::string("more\0", 5));
  expect_stl_box(longer);
  ASSERT_EQ(longer.notes.size(), 1U);
  EXPECT_TRUE(longer.notes[0].starts_with("a.stl: 5 bytes after the 12 facets"));
}

TEST(StlReader, SaysHowManyFacetsABinaryFileLacks) {
  const std::string content = box_stl("binary.stl");
  for (const std::size_t size : {std::size_t{84}, std::size_t{84 + 50 * 7}, content.size() - 1}) {
    EXPECT_EQ(input_error([&] { stl(content.substr(0, size)); }),
              "a.stl: declares 12 facets, but has only " + std::to_string((size - 84) / 50) +
                  "; copy or export it again");
  }
}

TEST(StlReader, TellsOfFacetsWithoutASurface) {
  const ImportedMesh mesh = stl("solid q\n" + stl_facet({0, 3, 2, 1}) + stl_facet({0, 1}) +
                                stl_facet({}) + "endsolid q\n");
  EXPECT_EQ(mesh.triangles.size(), 2U);
  ASSERT_EQ(mesh.notes.size(), 1U);
  EXPECT_EQ(mesh.notes[0],
            "a.stl:15: 2 facets have fewer than three vertices and are left out, the first of them "
            "ends here; export the mesh again");
}

TEST(StlReader, ReadsSeveralSolidsAndNamesTheLineWhereOneIsCutShort) {
  const std::string one = "solid a\n" + stl_facet({0, 3, 2, 1}) + "endsolid a\n";
  EXPECT_EQ(stl(one + one).triangles.size(), 4U);
  EXPECT_TRUE(input_error([&] {
                stl(one + "solid b\n");
              }).starts_with("a.stl:11: the file ends before endsolid"));
  EXPECT_TRUE(input_error([&] {
                stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n");
              }).starts_with("a.stl:4: the file ends before endfacet"));
}

TEST(StlReader, RefusesWhatIsNeitherTextNorBinary) {
  EXPECT_EQ(input_error([] { stl("hello"); }),
            "a.stl: is neither text nor binary STL; export the mesh again");
  EXPECT_EQ(input_error([] { stl(std::string(2000, 'x')); }),
            "a.stl: is neither text nor binary STL; export the mesh again");
}

}  // namespace
}  // namespace tactus::host
