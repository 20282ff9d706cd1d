#include "host_tools/bake/mesh_file/stl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>

#include "host_tools/bake/mesh_file/mesh_text.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// A binary file has 80 bytes for a title, the number of facets, and for each facet a normal, three
// vertices and two bytes more.
constexpr std::size_t kStlTitle = 80;
constexpr std::size_t kStlHead = kStlTitle + 4;
constexpr std::size_t kStlNormal = 12;
constexpr std::size_t kStlFacet = 50;

// Returns a little-endian number of 32 bits.
std::uint32_t little_endian_at(std::string_view content, std::size_t place) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    value |= std::uint32_t{static_cast<unsigned char>(content[place + k])} << (8 * k);
  }
  return value;
}

bool equals_in_lower_case(std::string_view word, std::string_view lower) {
  return std::ranges::equal(
      word, lower, [](unsigned char a, char b) { return static_cast<char>(std::tolower(a)) == b; });
}

// Reads a text STL.
class StlText {
 public:
  StlText(const std::string& file, std::string_view content) : text_(file, content, '\0') {}

  PolygonMesh read() {
    while (const std::optional<std::string_view> line = text_.next_line()) {
      std::string_view rest = *line;
      read_line(next_word(rest), rest);
    }
    if (is_open_ || !facet_.empty()) {
      text_.fail("the file ends before endfacet");
    }
    if (!ended_) {
      text_.fail("the file ends before endsolid");
    }
    if (small_facets_ != 0) {
      mesh_.notes.push_back(
          fmt::format("{}:{}: {} facets have fewer than three vertices and are left "
                      "out, the first of them ends here; export the mesh again",
                      text_.file(), first_small_line_, small_facets_));
    }
    return std::move(mesh_);
  }

 private:
  void read_line(std::string_view keyword, std::string_view rest) {
    if (equals_in_lower_case(keyword, "vertex")) {
      facet_.push_back(text_.require_position(rest, {.kind = "vertex", .index = vertices_++}));
    } else if (equals_in_lower_case(keyword, "facet")) {
      if (!facet_.empty()) {
        text_.fail("a facet begins before the last one has ended");
      }
      is_open_ = true;
    } else if (equals_in_lower_case(keyword, "endfacet")) {
      end_facet();
    } else if (equals_in_lower_case(keyword, "solid")) {
      ended_ = false;
    } else if (equals_in_lower_case(keyword, "endsolid")) {
      ended_ = true;
    }
  }

  void end_facet() {
    if (!is_open_) {
      text_.fail("a facet ends that has not begun");
    }
    if (facet_.size() < 3 && small_facets_++ == 0) {
      first_small_line_ = text_.number();
    } else if (facet_.size() >= 3) {
      mesh_.add_with_vertices(facet_);
    }
    facet_.clear();
    is_open_ = false;
  }

  MeshText text_;
  PolygonMesh mesh_;
  std::vector<Vec3> facet_;
  bool is_open_ = false;
  bool ended_ = false;
  std::size_t vertices_ = 0;
  std::size_t small_facets_ = 0;
  std::size_t first_small_line_ = 0;
};

// Returns a facet's vertex of a binary STL.
Vec3 stl_vertex(const std::string& file, std::string_view content, std::size_t place,
                std::size_t index) {
  Vec3 vertex;
  for (double& coordinate : vertex) {
    coordinate = static_cast<double>(std::bit_cast<float>(little_endian_at(content, place)));
    place += sizeof(float);
  }
  if (!vertex.allFinite()) {
    throw InputError(
        fmt::format("{}: vertex {} is not finite ({}, {}, {}); repair or export the mesh "
                    "again",
                    file, index, vertex.x(), vertex.y(), vertex.z()));
  }
  return vertex;
}

PolygonMesh read_binary_stl(const std::string& file, std::string_view content) {
  const std::size_t facets = little_endian_at(content, kStlTitle);
  const std::size_t room = (content.size() - kStlHead) / kStlFacet;
  if (room < facets && content.find('\0') == std::string_view::npos) {
    throw InputError(
        fmt::format("{}: is neither text nor binary STL; export the mesh again", file));
  }
  if (room < facets) {
    throw InputError(fmt::format("{}: declares {} facets, but has only {}; copy or export it again",
                                 file, facets, room));
  }
  PolygonMesh mesh;
  mesh.vertices.reserve(3 * facets);
  mesh.corners.reserve(3 * facets);
  for (std::size_t i = 0; i < facets; ++i) {
    std::array<Vec3, 3> facet;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t place = kStlHead + i * kStlFacet + kStlNormal * (k + 1);
      facet[k] = stl_vertex(file, content, place, 3 * i + k);
    }
    mesh.add_with_vertices(facet);
  }
  const std::size_t rest = content.size() - kStlHead - facets * kStlFacet;
  if (rest != 0) {
    mesh.notes.push_back(
        fmt::format("{}: {} bytes after the {} facets that the file declares are left "
                    "out; export it again if they belong to the mesh",
                    file, rest, facets));
  }
  return mesh;
}

bool is_binary_stl(std::string_view content) {
  return content.size() >= kStlHead &&
         content.size() == kStlHead + kStlFacet * std::size_t{little_endian_at(content, kStlTitle)};
}

// Returns true for text that begins with "solid". A zero in it would show a binary file with a
// title that begins so.
bool is_stl_text(std::string_view content) {
  const std::size_t begin = content.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos &&
         equals_in_lower_case(content.substr(begin, 5), "solid") &&
         content.find('\0') == std::string_view::npos;
}

}  // namespace

PolygonMesh read_stl(const std::string& file, std::string_view content) {
  if (!is_binary_stl(content) && is_stl_text(content)) {
    return StlText(file, content).read();
  }
  if (content.size() < kStlHead) {
    throw InputError(
        fmt::format("{}: is neither text nor binary STL; export the mesh again", file));
  }
  return read_binary_stl(file, content);
}

}  // namespace tactus::host
