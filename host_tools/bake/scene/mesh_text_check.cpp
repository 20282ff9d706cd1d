#include "host_tools/bake/scene/mesh_text_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "host_tools/bake/toml/text_lines.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// The most corners of a face that Assimp's OFF reader takes; it leaves out larger faces silently.
constexpr std::int64_t kMaxOffCorners = 9;
constexpr std::int64_t kAnyCorners = std::numeric_limits<std::int64_t>::max();

// Reads a text mesh line by line and throws InputError at the first error. It checks only what the
// formats demand of numbers and indices; unusual forms are left to Assimp.
class Checker {
 public:
  Checker(std::string path, std::string_view text) : path_(std::move(path)), lines_(text) {}

  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}; repair or export the mesh again", path_, line, what));
  }
  [[noreturn]] void fail(const std::string& what) const { fail(lines_.number(), what); }

  // Returns the next line with content; `what` is missing if the file ends.
  std::string_view require_line(const std::string& what) {
    const std::optional<std::string_view> line = lines_.next_with_content(comment_);
    if (!line) {
      fail(lines_.number(), fmt::format("the file ends before {}", what));
    }
    return *line;
  }

  // Takes a number off the line. A number that is too large for a float counts as not finite, since
  // the mesh is stored in floats.
  double require_coordinate(std::string_view& line, std::size_t vertex) const {
    const std::string_view word = next_word(line);
    const std::optional<double> value = to_number<double>(word);
    if (!value) {
      fail(word.empty() ? fmt::format("vertex {} has too few numbers", vertex)
                        : fmt::format("vertex {}: '{}' is not a number", vertex, word));
    }
    if (!std::isfinite(static_cast<float>(*value))) {
      fail(fmt::format("vertex {} is not finite ({})", vertex, word));
    }
    return *value;
  }

  void require_position(std::string_view line, std::size_t vertex) const {
    for (int k = 0; k < 3; ++k) {
      require_coordinate(line, vertex);
    }
  }

  std::int64_t require_integer(std::string_view word, std::size_t face) const {
    const std::optional<std::int64_t> value = to_number<std::int64_t>(word);
    if (!value) {
      fail(word.empty() ? fmt::format("face {} has too few numbers", face)
                        : fmt::format("face {}: '{}' is not a whole number", face, word));
    }
    return *value;
  }

  // Checks a face in the form of OFF and PLY: the number of corners, then as many indices, from 0.
  void require_face(std::string_view line, std::size_t face, std::size_t vertices,
                    std::int64_t most_corners) const {
    const std::int64_t corners = require_integer(next_word(line), face);
    if (corners < 1) {
      fail(fmt::format("face {} has {} corners", face, corners));
    }
    if (corners > most_corners) {
      fail(fmt::format("face {} has {} corners, where at most {} are read", face, corners,
                       most_corners));
    }
    for (std::int64_t k = 0; k < corners; ++k) {
      const std::int64_t index = require_integer(next_word(line), face);
      if (index < 0 || index >= static_cast<std::int64_t>(vertices)) {
        fail(fmt::format("face {} names vertex {}, but vertices go from 0 to {}", face, index,
                         static_cast<std::int64_t>(vertices) - 1));
      }
    }
  }

  void off();
  void obj();
  void ply();
  void stl();

 private:
  struct PlyElement {
    std::string name;
    std::size_t count = 0;
    // The properties' names, "list" for a list.
    std::vector<std::string> properties;
  };
  std::vector<PlyElement> ply_header();
  void ply_vertices(const PlyElement& element);
  void obj_face(std::string_view line, std::size_t vertices);

  std::string path_;
  TextLines lines_;
  char comment_ = '#';
  // OBJ: the largest index of any face. A face may name vertices that come later in the file, so
  // the comparison waits for the end.
  std::int64_t largest_index_ = 0;
  std::size_t largest_index_line_ = 0;
  std::size_t obj_faces_ = 0;
};

void Checker::off() {
  std::string_view line = require_line("the counts");
  std::string_view after_word = line;
  const std::string_view word = next_word(after_word);
  if (word.ends_with("OFF")) {
    if (word.find_first_of("4n") != std::string_view::npos) {
      return;  // homogeneous or n-dimensional: left to Assimp
    }
    std::string_view rest = after_word;
    line = next_word(rest).empty() ? require_line("the counts") : after_word;
  }
  if (line.find("BINARY") != std::string_view::npos) {
    return;
  }
  const auto vertices = to_number<std::size_t>(next_word(line));
  const auto faces = to_number<std::size_t>(next_word(line));
  if (!vertices || !faces) {
    fail("the line after OFF must hold the numbers of vertices, faces and edges");
  }
  for (std::size_t i = 0; i < *vertices; ++i) {
    require_position(require_line(fmt::format("vertex {} of {}", i, *vertices)), i);
  }
  for (std::size_t i = 0; i < *faces; ++i) {
    require_face(require_line(fmt::format("face {} of {}", i, *faces)), i, *vertices,
                 kMaxOffCorners);
  }
}

// An index counts from 1; a negative one counts back from the last vertex so far.
void Checker::obj_face(std::string_view line, std::size_t vertices) {
  const std::size_t face = obj_faces_++;
  if (line.ends_with('\\') || line.ends_with("\\\r")) {
    return;  // continued on the next line: left to Assimp
  }
  std::size_t corners = 0;
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
    const std::int64_t index = require_integer(word.substr(0, word.find('/')), face);
    if (index == 0 || -index > static_cast<std::int64_t>(vertices)) {
      fail(fmt::format("face {} names vertex {}, but there are {} so far", face, index, vertices));
    }
    if (index > largest_index_) {
      largest_index_ = index;
      largest_index_line_ = lines_.number();
    }
    ++corners;
  }
  if (corners == 0) {
    fail(fmt::format("face {} has no corners", face));
  }
}

void Checker::obj() {
  std::size_t vertices = 0;
  while (std::optional<std::string_view> line = lines_.next_with_content(comment_)) {
    const std::string_view word = next_word(*line);
    if (word == "v") {
      require_position(*line, ++vertices);
    } else if (word == "f") {
      obj_face(*line, vertices);
    }
  }
  if (largest_index_ > static_cast<std::int64_t>(vertices)) {
    fail(largest_index_line_, fmt::format("a face names vertex {}, but vertices go from 1 to {}",
                                          largest_index_, vertices));
  }
}

std::vector<Checker::PlyElement> Checker::ply_header() {
  std::vector<PlyElement> elements;
  while (std::optional<std::string_view> line = lines_.next()) {
    const std::string_view word = next_word(*line);
    if (word == "end_header") {
      return elements;
    }
    if (word == "format" && next_word(*line) != "ascii") {
      return {};  // Assimp finds binary files that are cut short
    }
    if (word == "element") {
      PlyElement element{.name = std::string(next_word(*line)), .count = 0, .properties = {}};
      const std::optional<std::size_t> count = to_number<std::size_t>(next_word(*line));
      if (!count) {
        fail(fmt::format("element {} has no count", element.name));
      }
      element.count = *count;
      elements.push_back(std::move(element));
    }
    if (word == "property" && !elements.empty()) {
      const std::string_view type = next_word(*line);
      const std::string_view name = next_word(*line);
      elements.back().properties.emplace_back(type == "list" ? type : name);
    }
  }
  fail("the file ends before end_header");
}

void Checker::ply_vertices(const PlyElement& element) {
  for (std::size_t i = 0; i < element.count; ++i) {
    std::string_view line = require_line(fmt::format("vertex {} of {}", i, element.count));
    for (const std::string& property : element.properties) {
      if (property == "x" || property == "y" || property == "z") {
        require_coordinate(line, i);
      } else {
        next_word(line);
      }
    }
  }
}

void Checker::ply() {
  comment_ = '\0';  // PLY has comments in its header alone
  std::optional<std::size_t> vertices;
  for (const PlyElement& element : ply_header()) {
    const bool has_list = std::ranges::find(element.properties, "list") != element.properties.end();
    if (element.name == "vertex" && !has_list) {
      vertices = element.count;
      ply_vertices(element);
      continue;
    }
    const bool is_face_list =
        element.name == "face" && has_list && element.properties.front() == "list";
    for (std::size_t i = 0; i < element.count; ++i) {
      const std::string_view line =
          require_line(fmt::format("{} {} of {}", element.name, i, element.count));
      if (is_face_list && vertices) {
        require_face(line, i, *vertices, kAnyCorners);
      }
    }
  }
}

void Checker::stl() {
  comment_ = '\0';
  std::size_t vertices = 0;
  bool ended = false;
  while (std::optional<std::string_view> line = lines_.next_with_content(comment_)) {
    const std::string_view word = next_word(*line);
    ended = ended || word == "endsolid";
    if (word == "vertex") {
      require_position(*line, vertices++);
    }
  }
  if (!ended) {
    fail("the file ends before endsolid");
  }
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// A binary STL may begin with "solid" too. It has a header of 80 bytes and the number of triangles;
// if that number fits the size of the file, at 50 bytes a triangle, the file is binary.
bool is_ascii_stl(std::string_view text) {
  constexpr std::size_t kHeader = 84;
  if (!text.starts_with("solid")) {
    return false;
  }
  if (text.size() < kHeader) {
    return true;
  }
  std::uint64_t triangles = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    triangles |= std::uint64_t{static_cast<unsigned char>(text[80 + k])} << (8 * k);
  }
  return text.size() != kHeader + 50 * triangles;
}

}  // namespace

void check_mesh_text(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".off" && extension != ".obj" && extension != ".ply" && extension != ".stl") {
    return;
  }
  const std::string text = read_file(path);
  Checker checker(path.string(), text);
  if (extension == ".off") {
    checker.off();
  } else if (extension == ".obj") {
    checker.obj();
  } else if (extension == ".ply") {
    checker.ply();
  } else if (is_ascii_stl(text)) {
    checker.stl();
  }
}

}  // namespace tactus::host
