#include "host_tools/bake/mesh_file/ply_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "host_tools/bake/mesh_file/ply_header.h"
#include "host_tools/bake/mesh_file/ply_numbers.h"

namespace tactus::host {
namespace {

// The names under which programs write texture coordinates of vertices.
constexpr std::array<std::string_view, 4> kPlyU{"u", "s", "texture_u", "texture_s"};
constexpr std::array<std::string_view, 4> kPlyV{"v", "t", "texture_v", "texture_t"};

bool is_corner_list(const PlyProperty& property) {
  return property.list_length &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

// Returns the content behind the line of end_header.
std::string_view body_of(std::string_view content) {
  constexpr std::string_view kEnd = "\nend_header";
  const std::size_t end = content.find('\n', content.find(kEnd) + kEnd.size());
  return end == std::string_view::npos ? std::string_view{} : content.substr(end + 1);
}

// Reads one PLY file.
class PlyReader {
 public:
  PlyReader(const std::string& file, std::string_view content)
      : text_(file, content, '\0'),
        header_(read_ply_header(text_)),
        numbers_(text_, body_of(content), header_.format) {}

  PolygonMesh read() {
    require_coordinates();
    for (const PlyElement& element : header_.elements) {
      // An element without properties has no content, whatever its count.
      const std::size_t count = element.properties.empty() ? 0 : element.count;
      for (std::size_t i = 0; i < count; ++i) {
        numbers_.start({.kind = element.name, .index = i}, element.count);
        read_entry(element);
      }
      note_if_left_out(element);
    }
    for (const std::optional<std::string>& note :
         {numbers_.note_on_lines(), numbers_.note_on_rest()}) {
      if (note) {
        mesh_.notes.push_back(*note);
      }
    }
    return std::move(mesh_);
  }

 private:
  void require_coordinates() {
    const PlyElement* vertex = header_.find("vertex");
    for (const std::string_view name : {"x", "y", "z"}) {
      if (vertex == nullptr || std::ranges::find(vertex->properties, name, &PlyProperty::name) ==
                                   vertex->properties.end()) {
        text_.fail(fmt::format("the header has no vertex with a property {}", name));
      }
    }
    vertex_count_ = vertex->count;
  }

  void read_entry(const PlyElement& element) {
    if (element.name == "vertex") {
      read_vertex(element);
    } else if (element.name == "face") {
      read_polygon(element);
      mesh_.add(corners_, places_of_face());
    } else if (element.name == "tristrips") {
      read_polygon(element);
      add_strips();
    } else {
      skip(element);
    }
  }

  void read_vertex(const PlyElement& element) {
    Vec3 position = Vec3::Zero();
    CornerPlace place{};
    for (const PlyProperty& property : element.properties) {
      if (property.list_length) {
        skip_list(property);
      } else if (property.name == "x" || property.name == "y" || property.name == "z") {
        position[property.name[0] - 'x'] = numbers_.next_finite(property.type);
      } else if (std::ranges::find(kPlyU, property.name) != kPlyU.end()) {
        place[0] = next_place(property.type);
        has_places_ = true;
      } else if (std::ranges::find(kPlyV, property.name) != kPlyV.end()) {
        place[1] = next_place(property.type);
      } else {
        numbers_.next(property.type);
      }
    }
    mesh_.vertices.push_back(position);
    vertex_places_.push_back(place);
  }

  // Returns a texture coordinate. A comparison with NaN is false, so NaN is refused too.
  float next_place(PlyType type) {
    const double value = numbers_.next(type);
    if (!(std::abs(value) <= static_cast<double>(rendering::kMostTexturePlace))) {
      numbers_.fail(fmt::format(": texture coordinate {}", value));
    }
    return static_cast<float>(value);
  }

  // Reads the corners of a face or of strips, and the texture places of a face's corners.
  void read_polygon(const PlyElement& element) {
    corners_.clear();
    own_places_.clear();
    const bool is_face = element.name == "face";
    for (const PlyProperty& property : element.properties) {
      if (is_corner_list(property)) {
        read_corners(property, is_face);
      } else if (is_face && property.list_length && property.name == "texcoord") {
        read_own_places(property);
      } else if (property.list_length) {
        skip_list(property);
      } else {
        numbers_.next(property.type);
      }
    }
  }

  // Reads indices. An index of -1 ends a strip, and stays as kStripEnd.
  void read_corners(const PlyProperty& property, bool is_face) {
    const std::int64_t count = length_of(property);
    if (is_face && count < 1) {
      numbers_.fail(fmt::format(" has {} corners", count));
    }
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t index = numbers_.next_whole(property.type);
      const bool ends_strip = !is_face && index == -1;
      if (!ends_strip && (index < 0 || index >= static_cast<std::int64_t>(vertex_count_))) {
        numbers_.fail(fmt::format(" names vertex {}, but vertices go from 0 to {}", index,
                                  static_cast<std::int64_t>(vertex_count_) - 1));
      }
      corners_.push_back(ends_strip ? kStripEnd : static_cast<std::uint32_t>(index));
    }
  }

  void read_own_places(const PlyProperty& property) {
    const std::int64_t count = length_of(property);
    for (std::int64_t k = 0; k < count; k += 2) {
      const float u = next_place(property.type);
      own_places_.push_back({u, k + 1 < count ? next_place(property.type) : 0.0F});
    }
  }

  // Returns the places of the face's corners: its own, those of its vertices, or none.
  std::span<const CornerPlace> places_of_face() {
    if (own_places_.size() == corners_.size()) {
      return own_places_;
    }
    if (!has_places_ || vertex_places_.size() != vertex_count_) {
      return {};
    }
    own_places_.clear();
    for (const std::uint32_t corner : corners_) {
      own_places_.push_back(vertex_places_[corner]);
    }
    return own_places_;
  }

  // Adds the triangles of the strips in `corners_`. Every second one of a strip is wound the other
  // way. A triangle that repeats a vertex joins two parts of a strip and has no surface.
  void add_strips() {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] == kStripEnd) {
        begin = i + 1;
      } else if (i >= begin + 2) {
        const bool is_odd = (i - begin) % 2 != 0;
        const std::uint32_t a = corners_[is_odd ? i - 1 : i - 2];
        const std::uint32_t b = corners_[is_odd ? i - 2 : i - 1];
        add_strip_triangle({a, b, corners_[i]});
      }
    }
  }

  void add_strip_triangle(const std::array<std::uint32_t, 3>& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      return;
    }
    const bool textured = has_places_ && vertex_places_.size() == vertex_count_;
    if (!textured) {
      mesh_.add(t);
      return;
    }
    mesh_.add(t, std::array{vertex_places_[t[0]], vertex_places_[t[1]], vertex_places_[t[2]]});
  }

  std::int64_t length_of(const PlyProperty& property) {
    const std::int64_t length = numbers_.next_whole(property.list_length.value_or(PlyType::uint8));
    if (length < 0) {
      numbers_.fail(fmt::format(" has a list of {} numbers", length));
    }
    return length;
  }

  void skip_list(const PlyProperty& property) {
    for (std::int64_t k = length_of(property); k > 0; --k) {
      numbers_.next(property.type);
    }
  }

  void skip(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (property.list_length) {
        skip_list(property);
      } else {
        numbers_.next(property.type);
      }
    }
  }

  // Tells of entries without a surface, and of lists, which may be one.
  void note_if_left_out(const PlyElement& element) {
    const bool is_read =
        element.name == "vertex" || ((element.name == "face" || element.name == "tristrips") &&
                                     std::ranges::any_of(element.properties, is_corner_list));
    if (element.name == "edge") {
      mesh_.lines_and_points += static_cast<std::uint32_t>(element.count);
    } else if (!is_read && element.count != 0 &&
               (element.has_list() || element.name == "face" || element.name == "tristrips")) {
      mesh_.notes.push_back(fmt::format(
          "{}: the {} entries of element '{}' are left out; export the surface as element 'face' "
          "with a list 'vertex_indices'",
          text_.file(), element.count, element.name));
    }
  }

  static constexpr std::uint32_t kStripEnd = 0xffffffff;

  MeshText text_;
  PlyHeader header_;
  PlyNumbers numbers_;
  PolygonMesh mesh_;
  std::size_t vertex_count_ = 0;
  bool has_places_ = false;
  std::vector<CornerPlace> vertex_places_;
  // The corners of the present entry and their own places.
  std::vector<std::uint32_t> corners_;
  std::vector<CornerPlace> own_places_;
};

}  // namespace

PolygonMesh read_ply(const std::string& file, std::string_view content) {
  return PlyReader(file, content).read();
}

}  // namespace tactus::host
