#include "host_tools/bake/mesh_file/mesh_import.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <string_view>

#include "host_tools/bake/mesh_file/gltf_count.h"
#include "host_tools/bake/mesh_file/obj_reader.h"
#include "host_tools/bake/mesh_file/off_reader.h"
#include "host_tools/bake/mesh_file/ply_reader.h"
#include "host_tools/bake/mesh_file/stl_reader.h"
#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/placement.h"
#include "tests/unit/host_tools/bake/mesh_file/measured.h"
#include "tests/unit/host_tools/bake/scene/box_files.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::input_error;
using testing::TemporaryFolder;
using testing::volume;

using Corner = std::array<float, 3>;
using Corners = std::array<Corner, 3>;

// Triangles by their corners' places, each from its smallest corner on, sorted: equal for equal
// surfaces however the vertices are numbered.
std::vector<Corners> surface(const BakedMesh& mesh) {
  std::vector<Corners> result;
  for (const rendering::TriangleIndices& t : mesh.triangles) {
    Corners corners;
    std::ranges::transform(t, corners.begin(), [&](std::uint32_t v) {
      return Corner{mesh.vertices[v].x, mesh.vertices[v].y, mesh.vertices[v].z};
    });
    std::ranges::rotate(corners, std::ranges::min_element(corners));
    result.push_back(corners);
  }
  std::ranges::sort(result);
  return result;
}

BakedMesh expected_box() {
  TriangleMesh mesh;
  for (const auto& c : testing::kBoxCorners) {
    mesh.vertices.push_back({c[0], c[1], c[2]});
  }
  mesh.triangles.assign(testing::kBoxTriangles.begin(), testing::kBoxTriangles.end());
  return bake_mesh(mesh);
}

std::string error_for(const std::string& name, std::string_view content) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.write(name, content);
  const std::string message = input_error([&] { import_mesh(path); });
  EXPECT_TRUE(message.starts_with(path.string())) << message;
  return message.substr(std::min(message.size(), folder.path().string().size() + 1));
}

TEST(MeshImport, GivesTheSameBoxFromEveryFormat) {
  const TemporaryFolder folder;
  for (const testing::BoxFile& file : testing::box_files()) {
    SCOPED_TRACE(file.name);
    const ImportedMesh imported = import_mesh(folder.write(file.name, file.content));
    const BakedMesh baked = bake_mesh(place(imported, {}));
    EXPECT_EQ(baked.vertices.size(), 8U);
    EXPECT_EQ(baked.counters.open_edges, 0U);
    EXPECT_EQ(baked.counters.inconsistent_edges, 0U);
    EXPECT_EQ(surface(baked), surface(expected_box()));
  }
}

TEST(MeshImport, CutsPolygonsIntoTriangles) {
  const TemporaryFolder folder;
  const ImportedMesh mesh = import_mesh(
      folder.write("quads.obj",
                   "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"
                   "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n"));
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_NEAR(volume(mesh), 6.0, 1e-12);
}

TEST(MeshImport, MovesMeshesToWhereTheFilesNodesPutThem) {
  const TemporaryFolder folder;
  const ImportedMesh mesh = import_mesh(folder.write("moved.gltf", testing::box_gltf(10.0)));
  const auto [least, most] =
      std::ranges::minmax(mesh.vertices, {}, [](const Vec3& v) { return v.x(); });
  EXPECT_EQ(least.x(), 10.0);
  EXPECT_EQ(most.x(), 11.0);
}

// glTF 2.0, 3.7.4: a mesh under a node that mirrors is wound the other way.
TEST(MeshImport, TurnsMeshesAroundThatTheFilesNodesMirror) {
  const TemporaryFolder folder;
  std::string mirrored = testing::box_gltf(0.0);
  mirrored.replace(mirrored.find("\"translation\":[0,0,0]"), 21, "\"scale\":[-1,1,2]");
  EXPECT_NEAR(volume(import_mesh(folder.write("a.gltf", mirrored))), 12.0, 1e-5);
}

TEST(MeshImport, TellsOfTrianglesThatAGltfFileDeclaresAndThatAreNotRead) {
  const TemporaryFolder folder;
  const std::string box = testing::box_gltf(0.0);
  EXPECT_TRUE(import_mesh(folder.write("a.gltf", box)).notes.empty());
  EXPECT_EQ(declared_gltf_triangles(box), 12U);
  std::string twice = box;
  twice.replace(twice.find(R"("nodes":[0])"), 11, R"("nodes":[0,1])");
  twice.replace(twice.find(R"("nodes":[{)"), 10, R"("nodes":[{"mesh":0},{)");
  EXPECT_EQ(declared_gltf_triangles(twice), 24U);
  std::string strip = box;
  strip.replace(strip.find(R"("indices":1)"), 11, R"("indices":1,"mode":5)");
  EXPECT_EQ(declared_gltf_triangles(strip), 34U);
  EXPECT_FALSE(declared_gltf_triangles("no JSON"));
}

TEST(MeshImport, TellsOfCoordinatesThatAreTooCoarseForTheMesh) {
  const TemporaryFolder folder;
  std::string far = testing::box_gltf(0.0);
  EXPECT_TRUE(import_mesh(folder.write("near.gltf", far)).notes.empty());
  const ImportedMesh dae = import_mesh(
      folder.write("far.x",
                   "xof 0303txt 0032\nMesh {\n3;\n4649776;0;0;,\n4649777;0;0;,\n4649776;1;0;;\n1;\n"
                   "3;0,1,2;;\n}\n"));
  ASSERT_EQ(dae.notes.size(), 1U);
  EXPECT_TRUE(contains(dae.notes[0], "far.x: the mesh of size 1 lies 4.64978e+06 from its origin"));
}

TEST(MeshImport, SkipsAByteOrderMarkAndTakesLineEndsOfOldMacs) {
  const TemporaryFolder folder;
  for (const testing::BoxFile& file : testing::box_files()) {
    if (file.name.ends_with(".gltf")) {
      continue;
    }
    EXPECT_EQ(import_mesh(folder.write(file.name, "\xEF\xBB\xBF" + file.content)).triangles.size(),
              12U)
        << file.name;
  }
  std::string obj = testing::box_files().at(1).content;
  std::ranges::replace(obj, '\n', '\r');
  EXPECT_EQ(import_mesh(folder.write("mac.obj", obj)).triangles.size(), 12U);
  EXPECT_TRUE(contains(error_for("a.obj", "\xff\xfev"), "UTF-16"));
}

TEST(MeshImport, CountsLinesAndPointsThatItLeavesOut) {
  const TemporaryFolder folder;
  const ImportedMesh mesh =
      import_mesh(folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n"));
  EXPECT_EQ(mesh.triangles.size(), 1U);
  EXPECT_EQ(mesh.lines_and_points, 1U);
}

TEST(MeshImport, NamesAFileThatIsMissingEmptyOrAFolder) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(input_error([&] { import_mesh(folder.path() / "no.off"); }),
                       "no.off: there is no such mesh file"));
  EXPECT_TRUE(contains(input_error([&] { import_mesh(folder.path()); }), "is not a file"));
  EXPECT_EQ(error_for("a.off", ""), "a.off: the mesh file is empty; export it again");
}

TEST(MeshImport, NamesFileLineAndVertexOfANumberThatIsNotFinite) {
  EXPECT_TRUE(error_for("a.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n")
                  .starts_with("a.off:4: vertex 1 is not finite (nan)"));
  EXPECT_TRUE(error_for("a.obj", "v 0 0 0\nv 1 0 inf\nv 0 1 0\nf 1 2 3\n")
                  .starts_with("a.obj:2: vertex 2 is not finite (inf)"));
  EXPECT_TRUE(error_for("a.stl",
                        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                        "vertex 0 -nan 0\nendloop\nendfacet\nendsolid\n")
                  .starts_with("a.stl:6: vertex 2 is not finite (-nan)"));
}

TEST(MeshImport, NamesTheVertexOfABinaryFileThatIsNotFinite) {
  for (testing::BoxFile& file : testing::box_files()) {
    if (file.name == "little.ply") {
      // Corner 1's x, after the header and corner 0.
      const std::size_t x = file.content.find("end_header\n") + 11 + 12;
      file.content.replace(x, 4, std::string("\0\0\xc0\x7f", 4));
      EXPECT_TRUE(error_for(file.name, file.content)
                      .starts_with("little.ply: vertex 1 is not finite (nan)"));
    }
  }
}

TEST(MeshImport, NamesFileLineAndFaceOfAnIndexOutOfRange) {
  EXPECT_TRUE(error_for("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n")
                  .starts_with("a.off:6: face 0 names vertex 3, but vertices go from 0 to 2"));
  EXPECT_TRUE(error_for("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n")
                  .starts_with("a.off:6: face 0 names vertex -1"));
  EXPECT_TRUE(error_for("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 3\n")
                  .starts_with("a.obj:4: a face names vertex 4, but vertices go from 1 to 3"));
  EXPECT_TRUE(error_for("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n")
                  .starts_with("a.obj:4: face 0 names vertex 0"));
  EXPECT_TRUE(error_for("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 -2 -1\n")
                  .starts_with("a.obj:4: face 0 names vertex -4"));
}

TEST(MeshImport, FindsAnIndexOutOfRangeInBinaryFilesToo) {
  for (testing::BoxFile& file : testing::box_files()) {
    if (file.name == "little.ply") {
      file.content[file.content.size() - 4] = 8;
      EXPECT_TRUE(
          error_for(file.name, file.content)
              .starts_with("little.ply: face 11 names vertex 8, but vertices go from 0 to 7"));
    }
  }
}

TEST(MeshImport, NamesTheLineWhereATextFileIsCutShort) {
  EXPECT_TRUE(error_for("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
                  .starts_with("a.off:6: the file ends before face 1 of 2"));
  EXPECT_TRUE(error_for("a.off", "OFF\n3 1 0\n0 0 0\n1 0\n")
                  .starts_with("a.off:4: vertex 1 has too few numbers"));
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_TRUE(error_for("a.ply", header + "0 0 0\n1 0 0\n")
                  .starts_with("a.ply:11: the file ends before vertex 2 of 3"));
  EXPECT_TRUE(error_for("a.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n")
                  .starts_with("a.ply:13: face 0 has too few numbers"));
}

TEST(MeshImport, RefusesEveryTruncationOfABinaryPly) {
  const TemporaryFolder folder;
  for (const testing::BoxFile& file : testing::box_files()) {
    if (file.name != "little.ply" && file.name != "big.ply") {
      continue;
    }
    const std::size_t body = file.content.find("end_header\n") + 11;
    for (std::size_t size = body; size < file.content.size(); ++size) {
      EXPECT_FALSE(input_error([&] {
                     import_mesh(folder.write(file.name, file.content.substr(0, size)));
                   }).empty())
          << size;
    }
  }
}

TEST(MeshImport, NamesWordsWhereNumbersShouldBe) {
  EXPECT_TRUE(error_for("a.off", "OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n")
                  .starts_with("a.off:4: vertex 1: 'x' is not a number"));
  EXPECT_TRUE(error_for("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n")
                  .starts_with("a.off:6: face 0: '1.5' is not a whole number"));
}

TEST(MeshImport, RefusesWhatIsNoMesh) {
  EXPECT_TRUE(contains(error_for("a.txt", "hello"), "Assimp cannot read this mesh"));
  EXPECT_TRUE(contains(error_for("a.glb", "hello, this is no glTF"), "Assimp cannot read"));
}

// A reader returns triangles of vertices that it has, or throws InputError, whatever the bytes are.
TEST(MeshImport, ReadsOrRefusesDamagedFilesWithoutHarm) {
  constexpr unsigned kDamageSeed = 20;
  std::mt19937 random(kDamageSeed);
  const auto damaged = [&](std::string content) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t place = random() % content.size();
      const std::size_t other = random() % content.size();
      switch (random() % 4) {
        case 0:
          content[place] = static_cast<char>(random());
          break;
        case 1:
          content.insert(place, content.substr(other, 8));
          break;
        case 2:
          content.erase(place, 8);
          break;
        default:
          content[place] = content[other];
      }
    }
    return content;
  };
  std::size_t read = 0;
  for (const testing::BoxFile& file : testing::box_files()) {
    const auto reader = file.name.ends_with("off")   ? read_off
                        : file.name.ends_with("obj") ? read_obj
                        : file.name.ends_with("ply") ? read_ply
                                                     : read_stl;
    for (int i = 0; !file.name.ends_with("gltf") && i < 2000; ++i) {
      try {
        const ImportedMesh mesh = cut_into_triangles(reader("a", damaged(file.content)), "a");
        ++read;
        for (const rendering::TriangleIndices& t : mesh.triangles) {
          ASSERT_LT(std::ranges::max(t), mesh.vertices.size())
              << file.name << ", seed " << kDamageSeed;
        }
      } catch (const InputError& error) {
        ASSERT_TRUE(std::string_view(error.what()).starts_with("a:")) << error.what();
      }
    }
  }
  EXPECT_GT(read, 1000U);
}

TEST(MeshImport, RefusesAMeshOfPointsAlone) {
  EXPECT_TRUE(contains(
      error_for("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                "property float z\nend_header\n0 0 0\n1 0 0\n"),
      "a.ply: "));
}

}  // namespace
}  // namespace tactus::host
