#include "host_tools/bake/mesh_file/ply_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>

#include "tests/unit/host_tools/bake/mesh_file/measured.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::area;
using testing::contains;
using testing::input_error;

ImportedMesh ply(std::string_view content) {
  return cut_into_triangles(read_ply("a.ply", content), "a.ply");
}

std::string ply_header(int vertices, std::string_view elements, std::string_view format = "ascii",
                       std::string_view type = "float") {
  std::string text = "ply\nformat " + std::string(format) +
                     " 1.0\ncomment by a test\nelement vertex " + std::to_string(vertices) + "\n";
  for (const char axis : {'x', 'y', 'z'}) {
    text += "property " + std::string(type) + " " + axis + "\n";
  }
  return text + std::string(elements) + "end_header\n";
}

constexpr std::string_view kPlyFace = "element face 1\nproperty list uchar int vertex_indices\n";

// A row of squares of side 1 in the plane z = 0, two triangles each, as vertices of a strip.
std::string strip_vertices(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += std::to_string(i / 2) + " " + std::to_string(1 - i % 2) + " 0\n";
  }
  return text;
}

// The least z of the triangles' cross products: positive if all of them face +z.
double least_z_of(const ImportedMesh& mesh) {
  double least = 1e9;
  for (const rendering::TriangleIndices& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    least = std::min(least, (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).z());
  }
  return least;
}

TEST(PlyReader, ReadsEveryTriangleOfAStripOnTheSameSide) {
  const ImportedMesh mesh =
      ply(ply_header(8, "element tristrips 1\nproperty list int int vertex_indices\n") +
          strip_vertices(8) + "8 0 1 2 3 4 5 6 7\n");
  EXPECT_EQ(mesh.triangles.size(), 6U);
  EXPECT_NEAR(area(mesh), 3.0, 1e-12);
  EXPECT_GT(least_z_of(mesh), 0.0);
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(PlyReader, EndsAStripAtMinusOneAndSkipsTrianglesThatOnlyJoin) {
  const ImportedMesh mesh =
      ply(ply_header(8, "element tristrips 2\nproperty list int int vertex_indices\n") +
          strip_vertices(8) + "9 0 1 2 3 -1 4 5 6 7\n8 0 1 2 3 3 2 2 3\n");
  EXPECT_EQ(mesh.triangles.size(), 6U);
  EXPECT_NEAR(area(mesh), 3.0, 1e-12);
  EXPECT_GT(least_z_of(mesh), 0.0);
}

TEST(PlyReader, ReadsDoublesPolygonsAndOtherPropertiesInText) {
  const ImportedMesh mesh =
      ply("ply\nformat ascii 1.0\nelement vertex 4\nproperty uchar red\nproperty double x\n"
          "property double y\nproperty double z\nelement face 1\nproperty uchar flags\n"
          "property list uchar uint vertex_index\nend_header\n"
          "255 4649776.0001 0 0\n0 4649777.0001 0 0\n0 4649777.0001 1 0\n0 4649776.0001 1 0\n"
          "7 4 0 1 2 3\n");
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_NEAR(area(mesh), 1.0, 1e-8);
  EXPECT_TRUE(mesh.notes.empty());
}

template <class Number>
void append_number(std::string& bytes, Number value, bool big) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if (big) {
    std::ranges::reverse(raw);
  }
  bytes.append(raw.data(), raw.size());
}

TEST(PlyReader, ReadsBinaryDoublesInBothByteOrders) {
  for (const bool big : {false, true}) {
    std::string content =
        ply_header(3, kPlyFace, big ? "binary_big_endian" : "binary_little_endian", "double");
    for (const double x : {1e6, 0.0, 0.0, 1e6 + 1e-4, 0.0, 0.0, 1e6, 1.0, 0.0}) {
      append_number(content, x, big);
    }
    append_number(content, std::uint8_t{3}, big);
    for (const std::int32_t index : {0, 1, 2}) {
      append_number(content, index, big);
    }
    const ImportedMesh mesh = ply(content);
    EXPECT_EQ(mesh.triangles.size(), 1U);
    EXPECT_EQ(mesh.vertices[1].x(), 1e6 + 1e-4);
    EXPECT_TRUE(mesh.notes.empty());
    EXPECT_TRUE(contains(ply(content + "more").notes.at(0), "a.ply: 4 bytes after the elements"));
  }
}

TEST(PlyReader, GivesCornersTheTextureCoordinatesOfVerticesOrOfTheirFace) {
  const std::string vertices = "0 0 0 0.5 0\n1 0 0 1 0\n0 1 0 0 1\n";
  const std::string start =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nproperty float s\nproperty float t\n"
      "element face 1\nproperty list uchar int vertex_indices\n";
  const ImportedMesh by_vertex = ply(start + "end_header\n" + vertices + "3 0 1 2\n");
  ASSERT_EQ(by_vertex.corner_places.size(), 1U);
  EXPECT_EQ(by_vertex.corner_places[0][0], (CornerPlace{0.5F, 0.0F}));
  const ImportedMesh by_corner = ply(start + "property list uchar float texcoord\nend_header\n" +
                                     vertices + "3 0 1 2 6 0 0 0.25 0 0 1\n");
  ASSERT_EQ(by_corner.corner_places.size(), 1U);
  EXPECT_EQ(by_corner.corner_places[0][1], (CornerPlace{0.25F, 0.0F}));
}

TEST(PlyReader, TellsWhatItLeavesOut) {
  const ImportedMesh mesh =
      ply(ply_header(3, std::string(kPlyFace) +
                            "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
                            "element patch 2\nproperty list uchar int corners\n") +
          "0 0 0\n1 0 0 9 9\n0 1 0\n3 0 1 2\n0 1\n2 0 1\n2 1 2\n3 0 1 2\n");
  EXPECT_EQ(mesh.triangles.size(), 1U);
  ASSERT_EQ(mesh.notes.size(), 4U);
  EXPECT_TRUE(mesh.notes[0].starts_with("a.ply: the 2 entries of element 'patch' are left out"));
  EXPECT_TRUE(mesh.notes[1].starts_with("a.ply:17: 1 lines have more numbers"));
  EXPECT_TRUE(mesh.notes[2].starts_with("a.ply:23: 1 lines after the elements"));
  EXPECT_TRUE(contains(mesh.notes[3], "1 lines and points"));
}

TEST(PlyReader, RefusesHeadersThatItCannotFollow) {
  const auto error = [](std::string_view content) { return input_error([&] { ply(content); }); };
  EXPECT_TRUE(error("plx\n").starts_with("a.ply:1: a PLY file begins with the word ply"));
  EXPECT_TRUE(error("ply\nformat text 1.0\n").starts_with("a.ply:2: 'text' is no format of PLY"));
  EXPECT_TRUE(error("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n")
                  .starts_with("a.ply:4: 'half' is no type of PLY"));
  EXPECT_TRUE(error("ply\nformat ascii 1.0\nelement vertex x\n")
                  .starts_with("a.ply:3: element vertex has no count"));
  EXPECT_TRUE(error("ply\nformat ascii 1.0\nelement face 1\n")
                  .starts_with("a.ply:3: the file ends before end_header"));
  EXPECT_TRUE(contains(error("ply\nformat ascii 1.0\nelement face 1\nend_header\n"),
                       "the header has no vertex with a property x"));
}

}  // namespace
}  // namespace tactus::host
