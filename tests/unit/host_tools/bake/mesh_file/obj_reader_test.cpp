#include "host_tools/bake/mesh_file/obj_reader.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/unit/host_tools/bake/mesh_file/measured.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::area;
using testing::input_error;
using testing::volume;

ImportedMesh obj(std::string_view text) {
  return cut_into_triangles(read_obj("a.obj", text), "a.obj");
}

constexpr std::string_view kObjTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ObjReader, ReadsPolygonsOfAllObjectsAndGroups) {
  const ImportedMesh mesh =
      obj("o a\ng b\nv 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"
          "usemtl red\ns 1\nf 1 4 3 2 # bottom\nf 5 6 7 8\n\no c\nf 1 2 6 5\nf 4 8 7 3 \\\n\n"
          "f 1 5 \\\n  8 4\nfo 2 3 7 6\n");
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_NEAR(volume(mesh), 6.0, 1e-12);
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(ObjReader, TakesCommentsColoursWeightsAndAllFormsOfCorners) {
  for (const char* text :
       {"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 # the only one\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n",
        "v 0 0 0 1.0\nv 2 0 0 2.0\nv 0 3 0 3.0\nf 1 2 3\n",
        "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n"}) {
    const ImportedMesh mesh = obj(text);
    EXPECT_EQ(mesh.triangles.size(), 1U) << text;
    EXPECT_NEAR(area(mesh), 0.5, 1e-12) << text;
    EXPECT_TRUE(mesh.notes.empty()) << text;
  }
}

TEST(ObjReader, KeepsTheDigitsOfCoordinatesFarFromTheOrigin) {
  const ImportedMesh mesh = obj("v 4649776.0001 0 0\nv 4649776.0002 0 0\nv 4649776 1 0\nf 1 2 3\n");
  EXPECT_NEAR(mesh.vertices[1].x() - mesh.vertices[0].x(), 1e-4, 1e-9);
}

TEST(ObjReader, GivesEveryCornerItsTextureCoordinates) {
  const ImportedMesh mesh =
      obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.25 0\nvt 0.5\nvt 1 1 0\nvt 0 0.75\n"
          "f 1/1 2/2 3/3 -1/-1\n");
  ASSERT_EQ(mesh.corner_places.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<CornerPlace, 4> of_vertex{{{0.25F, 0}, {0.5F, 0}, {1, 1}, {0, 0.75F}}};
      EXPECT_EQ(mesh.corner_places[i][k], of_vertex[mesh.triangles[i][k]]);
    }
  }
}

TEST(ObjReader, TellsWhatItLeavesOutWithNumbersAndLines) {
  const ImportedMesh mesh = obj(std::string(kObjTriangle) +
                                "vt 0 0\nf 1/1 2/1 3/1\nf 3 2 1\nl 1 2\np 1\ncstype bezier\n"
                                "deg 3 3\nsurf 0 1 0 1 1 2 3\nend\nface 1 2 3\n");
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_TRUE(mesh.corner_places.empty());
  ASSERT_EQ(mesh.notes.size(), 4U);
  EXPECT_EQ(mesh.notes[0],
            "a.obj:11: 1 free-form curves and surfaces are left out, the first is a 'surf'; export "
            "the surface as polygons");
  EXPECT_EQ(mesh.notes[1],
            "a.obj:13: 1 lines with an unknown keyword are left out, the first has 'face'");
  EXPECT_EQ(mesh.notes[2], "a.obj: 2 lines and points have no surface and are left out");
  EXPECT_TRUE(mesh.notes[3].starts_with("a.obj: only 3 of 6 corners have texture coordinates"));
}

TEST(ObjReader, NamesTheLineOfWhatItCannotRead) {
  const auto error = [](std::string_view rest) {
    return input_error([&] { obj(std::string(kObjTriangle) + std::string(rest)); });
  };
  EXPECT_TRUE(error("f 1 2 x\n").starts_with("a.obj:4: face 0: 'x' is not a whole number"));
  EXPECT_TRUE(error("f\n").starts_with("a.obj:4: face 0 has no corners"));
  EXPECT_TRUE(
      error("vt 0 0\nf 1/1 2/2 3/1\n")
          .starts_with("a.obj:5: face 0 names texture coordinate 2, but there are 1 so far"));
  EXPECT_TRUE(error("vt nan 0\nf 1 2 3\n").starts_with("a.obj:4: texture coordinate 1 is 'nan'"));
}

}  // namespace
}  // namespace tactus::host
