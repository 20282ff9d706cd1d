#include "host_tools/bake/mesh_file/off_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/unit/host_tools/bake/mesh_file/measured.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::area;
using testing::contains;
using testing::input_error;
using testing::volume;

ImportedMesh off(std::string_view text) {
  return cut_into_triangles(read_off("a.off", text), "a.off");
}

std::string off_error(std::string_view text) {
  return input_error([&] { off(text); });
}

// The corners of a box of 1 x 2 x 3, and its faces as rectangles.
constexpr std::string_view kOffCorners = "0 0 0\n1 0 0\n1 2 0\n0 2 0\n0 0 3\n1 0 3\n1 2 3\n0 2 3\n";
constexpr std::string_view kOffFaces =
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 3 7 6 2\n4 0 4 7 3\n4 1 2 6 5\n";

std::string quad_box_off(std::string_view header = "OFF\n8 6 12\n") {
  return std::string(header) + std::string(kOffCorners) + std::string(kOffFaces);
}

void expect_off_box(const ImportedMesh& mesh) {
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_NEAR(volume(mesh), 6.0, 1e-12);
  EXPECT_TRUE(mesh.notes.empty()) << mesh.notes.front();
}

TEST(OffReader, ReadsEveryFaceWhateverCommentsAndBlankLinesAreBetweenThem) {
  expect_off_box(off(quad_box_off()));
  std::string text;
  for (const char c : quad_box_off()) {
    text += c;
    text += c == '\n' ? "# 3 0 1 2\n\n  \t\n" : "";
  }
  expect_off_box(off(text));
  std::string with_ends;
  for (const char c : quad_box_off()) {
    with_ends += c == '\n' ? " # the end\r\n" : std::string(1, c);
  }
  expect_off_box(off(with_ends));
}

TEST(OffReader, ReadsNumbersThatBreakTheirLinesFreely) {
  std::string one_line = "OFF\n8 6 12\n" + std::string(kOffCorners) + std::string(kOffFaces);
  std::string many_lines = one_line;
  std::ranges::replace(one_line.begin() + 11, one_line.end(), '\n', ' ');
  expect_off_box(off(one_line));
  std::ranges::replace(many_lines.begin() + 11, many_lines.end(), ' ', '\n');
  expect_off_box(off(many_lines));
}

TEST(OffReader, ReadsColoursAndNormalsAndHeadersOfAllKinds) {
  for (const char* text :
       {"COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 255 0 0 255\n3 0 1 2\n",
        "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n",
        "OFF\n\n# comment\n3 1 0\n0 0 0 # first\n1 0 0\n0 1 0\n3 0 1 2 0.5 0.5 0.5\n",
        "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n"}) {
    const ImportedMesh mesh = off(text);
    EXPECT_EQ(mesh.triangles.size(), 1U) << text;
    EXPECT_NEAR(area(mesh), 0.5, 1e-12) << text;
    EXPECT_TRUE(mesh.notes.empty()) << text;
  }
}

TEST(OffReader, ReadsFacesWithManyCorners) {
  std::string text = "OFF\n40 1 0\n";
  std::string face = "40";
  for (int i = 0; i < 40; ++i) {
    text += i < 20 ? std::to_string(i) + " 0 0\n" : std::to_string(39 - i) + " 1 0\n";
    face += " " + std::to_string(i);
  }
  const ImportedMesh mesh = off(text + face + "\n");
  EXPECT_EQ(mesh.triangles.size(), 38U);
  EXPECT_NEAR(area(mesh), 19.0, 1e-12);
}

TEST(OffReader, KeepsTheDigitsOfCoordinatesFarFromTheOrigin) {
  const ImportedMesh mesh =
      off("OFF\n3 1 0\n500000.0001 4649776 0\n500000.0002 4649776 0\n500000.0001 4649776.25 0\n"
          "3 0 1 2\n");
  EXPECT_NEAR(mesh.vertices[1].x() - mesh.vertices[0].x(), 1e-4, 1e-9);
  EXPECT_EQ(mesh.vertices[2].y(), 4649776.25);
}

TEST(OffReader, TellsOfLinesPointsAndOfFacesThatTheCountsLeaveOut) {
  const ImportedMesh mesh =
      off("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n1 0\n3 2 1 0\n3 0 2 1\n");
  EXPECT_EQ(mesh.triangles.size(), 1U);
  EXPECT_EQ(mesh.lines_and_points, 2U);
  ASSERT_EQ(mesh.notes.size(), 2U);
  EXPECT_EQ(mesh.notes[0],
            "a.off:9: 2 lines after the 3 faces that the file declares are left out; correct the "
            "counts if they belong to the mesh");
  EXPECT_EQ(mesh.notes[1], "a.off: 2 lines and points have no surface and are left out");
}

TEST(OffReader, RefusesWhatItCannotRead) {
  EXPECT_TRUE(
      contains(off_error("OFF BINARY\n"), "a.off:1: binary OFF is not read; save it as text"));
  EXPECT_TRUE(contains(off_error("4OFF\n1 0 0\n0 0 0 1\n"), "a.off:1: 4OFF has more than three"));
  EXPECT_TRUE(
      contains(off_error("{ = OFF\n"), "a.off:1: an OFF file must begin with the word OFF"));
  EXPECT_TRUE(contains(off_error("OFF\nx\n"), "a.off:2: the line after OFF must hold"));
  EXPECT_TRUE(contains(off_error("OFF\n3 1 0\n0,5 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                       "a.off:3: vertex 0: '0,5' is not a number; numbers need a decimal point"));
  EXPECT_TRUE(
      contains(off_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n0\n"), "a.off:6: face 0 has 0 corners"));
}

}  // namespace
}  // namespace tactus::host
