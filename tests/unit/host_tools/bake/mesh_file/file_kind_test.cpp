#include "host_tools/bake/mesh_file/file_kind.h"

#include <gtest/gtest.h>

#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using namespace std::string_view_literals;
using testing::contains;
using testing::input_error;

std::string foreign_refusal(const std::string& name, std::string_view content) {
  return input_error([&] { refuse_foreign_mesh(name, content); });
}

// The text in UTF-16, little endian.
std::string utf16(std::string_view text) {
  std::string result;
  for (const char c : text) {
    result += c;
    result += '\0';
  }
  return result;
}

TEST(FileKind, NamesTheFileItsKindAndTheRemedy) {
  EXPECT_EQ(foreign_refusal("a.stl",
                            "version https://git-lfs.github.com/spec/v1\noid sha256:4d\nsize 9\n"),
            "a.stl: this file is a Git LFS pointer and not the file itself; fetch it with: git lfs "
            "pull");
  EXPECT_EQ(
      foreign_refusal("a.stl", "\n <!DOCTYPE html>\n<html></html>"),
      "a.stl: this file is a web page and not the file itself; download the file that the page "
      "links to");
  EXPECT_EQ(foreign_refusal("a.stp", "ISO-10303-21;\nHEADER;\n"),
            "a.stp: this file is CAD data, which has no triangles; export it as STL or OBJ from a "
            "CAD program");
}

TEST(FileKind, RecognisesUtf16WithAndWithoutAMark) {
  EXPECT_TRUE(
      contains(foreign_refusal("a.obj", "\xff\xfe" + utf16("v 0 0 0\nv 1 0 0\n")), "UTF-16"));
  EXPECT_TRUE(contains(foreign_refusal("a.obj", "\xfe\xff\0v\0 "sv), "UTF-16"));
  EXPECT_TRUE(contains(foreign_refusal("a.obj", utf16("v 0 0 0\nv 1 0 0\n")), "UTF-16"));
}

TEST(FileKind, RecognisesArchivesPicturesCadDataAndZeros) {
  const std::string iges = std::string(72, ' ') + "S      1\n";
  EXPECT_TRUE(contains(foreign_refusal("a.off", "\x1f\x8b\x08"), "gunzip"));
  EXPECT_TRUE(contains(foreign_refusal("a.stl", "PK\x03\x04"), "archive"));
  EXPECT_TRUE(contains(foreign_refusal("a.obj", "\x89PNG\r\n"), "picture"));
  EXPECT_TRUE(contains(foreign_refusal("a.igs", iges), "CAD"));
  EXPECT_TRUE(contains(foreign_refusal("a.ply", "# vtk DataFile Version 3.0\n"), "convert"));
  EXPECT_TRUE(contains(foreign_refusal("a.stl", std::string(500, '\0')), "nothing but zeros"));
}

TEST(FileKind, RecognisesAMeshOfAnotherFormat) {
  EXPECT_TRUE(contains(foreign_refusal("a.stl", "ply\nformat ascii 1.0\n"), "rename it to .ply"));
  EXPECT_TRUE(contains(foreign_refusal("a.obj", "OFF\n8 12 0\n"), "rename it to .off"));
}

TEST(FileKind, LetsMeshesPass) {
  for (const auto& [name, content] : {std::pair{"a.off", "OFF\n8 12 0\n"sv},
                                      {"a.ply", "ply\nformat ascii 1.0\n"sv},
                                      {"a.ply", "\xEF\xBB\xBFply\n"sv},
                                      {"a.stl", "solid a\n"sv},
                                      {"a.obj", "v 0 0 0\n"sv},
                                      {"a.3mf", "PK\x03\x04"sv},
                                      {"a.ifc", "ISO-10303-21;\n"sv},
                                      {"a.glb", "glTF\2\0\0\0"sv},
                                      {"a.stl", "binary\0\0\0\0\0\0\0\0\0\0\0\0"sv}}) {
    EXPECT_NO_THROW(refuse_foreign_mesh(name, content)) << name;
  }
}

}  // namespace
}  // namespace tactus::host
