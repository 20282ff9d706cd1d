#include "host_tools/bake/mesh_file/obj_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host_tools/bake/mesh_file/mesh_text.h"

namespace tactus::host {
namespace {

// Keywords without a surface of their own: normals, names, materials, and the parameters of
// free-form surfaces, which are told by `surf`.
constexpr std::array<std::string_view, 39> kObjIgnored{
    "vn",       "vp",         "g",         "o",     "s",      "mg",  "usemtl", "mtllib",
    "usemap",   "maplib",     "bevel",     "lod",   "cstype", "deg", "bmat",   "step",
    "parm",     "trim",       "hole",      "scrv",  "sp",     "end", "con",    "c_interp",
    "d_interp", "shadow_obj", "trace_obj", "ctech", "stech",  "res", "ka",     "kd",
    "ks",       "newmtl",     "illum",     "ns",    "ni",     "d",   "tr"};

// Lines that are left out, and the first of them.
struct LeftOut {
  std::size_t count = 0;
  std::size_t line = 0;
  std::string word;

  void add(std::size_t at, std::string_view keyword) {
    if (count++ == 0) {
      line = at;
      word = keyword;
    }
  }
};

// Reads one OBJ file.
class ObjReader {
 public:
  ObjReader(const std::string& file, std::string_view text) : text_(file, text, '#') {}

  PolygonMesh read() {
    while (const std::optional<std::string_view> line = next_whole_line()) {
      std::string_view rest = *line;
      read_line(next_word(rest), rest);
    }
    require_known_vertices();
    note(
        "{}:{}: {} free-form curves and surfaces are left out, the first is a '{}'; export the "
        "surface as polygons",
        free_form_);
    note("{}:{}: {} lines with an unknown keyword are left out, the first has '{}'", unknown_);
    return std::move(mesh_);
  }

 private:
  // Returns the next line with the lines that continue it after a backslash at the end.
  std::optional<std::string_view> next_whole_line() {
    std::optional<std::string_view> line = text_.next_line();
    if (!line || !continues(*line)) {
      return line;
    }
    joined_.clear();
    while (line && continues(*line)) {
      joined_ += line->substr(0, line->rfind('\\'));
      joined_ += ' ';
      // The very next line continues this one, though it may be empty.
      line = text_.next_raw_line();
      line = line ? line->substr(0, line->find('#')) : line;
    }
    joined_ += line.value_or("");
    return joined_;
  }

  static bool continues(std::string_view line) {
    const std::size_t last = line.find_last_not_of(kBlanks);
    return last != std::string_view::npos && line[last] == '\\';
  }

  void read_line(std::string_view keyword, std::string_view rest) {
    if (keyword == "v") {
      read_vertex(rest);
    } else if (keyword == "vt") {
      read_place(rest);
    } else if (keyword == "f" || keyword == "fo") {
      read_face(rest);
    } else if (keyword == "l" || keyword == "p") {
      ++mesh_.lines_and_points;
    } else if (keyword == "surf" || keyword == "curv" || keyword == "curv2" || keyword == "call") {
      free_form_.add(text_.number(), keyword);
    } else if (std::ranges::find(kObjIgnored, keyword) == kObjIgnored.end()) {
      unknown_.add(text_.number(), keyword);
    }
  }

  // Reads a vertex: three coordinates, then nothing, a weight that divides them, or a colour.
  void read_vertex(std::string_view rest) {
    const FilePart part{.kind = "vertex", .index = mesh_.vertices.size() + 1};
    Vec3 position = text_.require_position(rest, part);
    const std::string_view weight_word = next_word(rest);
    if (!weight_word.empty() && next_word(rest).empty()) {
      const double weight = any_number(weight_word).value_or(1.0);
      position /= weight == 0.0 ? 1.0 : weight;
    }
    mesh_.vertices.push_back(position);
  }

  // Reads a texture coordinate: u, and v unless it is 0. A NaN compares as false and is refused.
  void read_place(std::string_view rest) {
    CornerPlace place{};
    for (float& coordinate : place) {
      const std::string_view word = next_word(rest);
      const double value =
          any_number(word.empty() ? "0" : word).value_or(std::numeric_limits<double>::quiet_NaN());
      if (!(std::abs(value) <= static_cast<double>(rendering::kMostTexturePlace))) {
        text_.fail(fmt::format("texture coordinate {} is '{}'", places_.size() + 1, word));
      }
      coordinate = static_cast<float>(value);
    }
    places_.push_back(place);
  }

  // Reads a face. A corner is `vertex`, `vertex/texture` or `vertex/texture/normal`.
  void read_face(std::string_view rest) {
    corners_.clear();
    corner_places_.clear();
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
      const std::size_t slash = word.find('/');
      corners_.push_back(vertex_of(word.substr(0, slash)));
      if (slash != std::string_view::npos) {
        const std::string_view after = word.substr(slash + 1);
        add_corner_place(after.substr(0, after.find('/')));
      }
    }
    if (corners_.empty()) {
      text_.fail(fmt::format("face {} has no corners", face_));
    }
    const bool is_textured = corner_places_.size() == corners_.size();
    mesh_.add(corners_, is_textured ? std::span<const CornerPlace>(corner_places_)
                                    : std::span<const CornerPlace>());
    ++face_;
  }

  // Returns the number of a vertex from 0. An index counts from 1; a negative one counts back from
  // the last vertex so far. A face may name vertices that come later in the file.
  std::uint32_t vertex_of(std::string_view word) {
    const FilePart part{.kind = "face", .index = face_};
    const std::int64_t index = text_.require_integer(word, part);
    const auto count = static_cast<std::int64_t>(mesh_.vertices.size());
    if (index == 0 || -index > count || index > std::numeric_limits<std::uint32_t>::max()) {
      text_.fail(
          fmt::format("{} names vertex {}, but there are {} so far", part.name(), index, count));
    }
    if (index > largest_index_) {
      largest_index_ = index;
      largest_index_line_ = text_.number();
    }
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
  }

  // Appends the texture place that a corner names; nothing if it names none.
  void add_corner_place(std::string_view word) {
    if (word.empty()) {
      return;
    }
    const FilePart part{.kind = "face", .index = face_};
    const std::int64_t index = text_.require_integer(word, part);
    const auto count = static_cast<std::int64_t>(places_.size());
    const std::int64_t from_0 = index > 0 ? index - 1 : count + index;
    if (index == 0 || from_0 < 0 || from_0 >= count) {
      text_.fail(fmt::format("{} names texture coordinate {}, but there are {} so far", part.name(),
                             index, count));
    }
    corner_places_.push_back(places_[static_cast<std::size_t>(from_0)]);
  }

  void require_known_vertices() const {
    const auto count = static_cast<std::int64_t>(mesh_.vertices.size());
    if (largest_index_ > count) {
      text_.fail(largest_index_line_,
                 fmt::format("a face names vertex {}, but vertices go from 1 to {}", largest_index_,
                             count));
    }
  }

  void note(fmt::format_string<std::string, std::size_t, std::size_t, std::string> text,
            const LeftOut& left_out) {
    if (left_out.count != 0) {
      mesh_.notes.push_back(fmt::format(text, std::string(text_.file()), std::size_t(left_out.line),
                                        std::size_t(left_out.count), std::string(left_out.word)));
    }
  }

  MeshText text_;
  std::string joined_;
  PolygonMesh mesh_;
  std::vector<CornerPlace> places_;
  std::vector<std::uint32_t> corners_;
  std::vector<CornerPlace> corner_places_;
  std::size_t face_ = 0;
  // The largest index of any face, and its line.
  std::int64_t largest_index_ = 0;
  std::size_t largest_index_line_ = 0;
  LeftOut free_form_;
  LeftOut unknown_;
};

}  // namespace

PolygonMesh read_obj(const std::string& file, std::string_view text) {
  return ObjReader(file, text).read();
}

}  // namespace tactus::host
