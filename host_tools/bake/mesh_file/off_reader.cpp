#include "host_tools/bake/mesh_file/off_reader.h"

#include <fmt/format.h>

#include "host_tools/bake/mesh_file/mesh_text.h"

namespace tactus::host {
namespace {

constexpr char kOffComment = '#';

// The numbers of vertices and faces that the file declares.
struct OffCounts {
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

// Takes the words of a text one by one, however its lines break.
class FreeWords {
 public:
  explicit FreeWords(MeshText& text) : text_(text) {}

  // Returns the next word. Throws InputError at the end of the file, where `part` is missing.
  std::string_view next(const FilePart& part, std::size_t total) {
    std::string_view word = next_word(line_);
    if (word.empty()) {
      line_ = text_.require_line(part, total);
      word = next_word(line_);
    }
    return word;
  }

  [[nodiscard]] bool line_is_used_up() const {
    return line_.find_first_not_of(kBlanks) == std::string_view::npos;
  }

 private:
  MeshText& text_;
  std::string_view line_;
};

// Reads one OFF file.
class OffReader {
 public:
  OffReader(const std::string& file, std::string_view text)
      : source_(text), text_(file, text, kOffComment) {}

  PolygonMesh read() {
    const OffCounts counts = read_counts();
    if (breaks_lines_freely(counts)) {
      read_words(counts);
    } else {
      read_lines(counts);
    }
    const auto rest =
        text_.note_on_rest(fmt::format("the {} faces that the file declares", counts.faces));
    if (rest) {
      mesh_.notes.push_back(*rest);
    }
    return std::move(mesh_);
  }

 private:
  // Reads the header: the word OFF, which may be missing, and the counts on its line or on the
  // next.
  OffCounts read_counts() {
    std::string_view line = text_.require_line("the counts");
    std::string_view after_word = line;
    const std::string_view word = next_word(after_word);
    const bool has_word = word.ends_with("OFF");
    if (has_word) {
      is_plain_ = word == "OFF";
      if (word.find_first_of("4n") != std::string_view::npos) {
        text_.fail(fmt::format("{} has more than three dimensions and is not read", word));
      }
      std::string_view rest = after_word;
      line = next_word(rest).empty() ? text_.require_line("the counts") : after_word;
    }
    if (line.find("BINARY") != std::string_view::npos) {
      text_.fail("binary OFF is not read; save it as text");
    }
    const auto vertices = to_number<std::size_t>(next_word(line));
    const auto faces = to_number<std::size_t>(next_word(line));
    if (!vertices || !faces) {
      text_.fail(has_word ? "the line after OFF must hold the numbers of vertices, faces and edges"
                          : "an OFF file must begin with the word OFF or with its counts");
    }
    return {.vertices = *vertices, .faces = *faces};
  }

  // Returns true if the first line of vertices has one number, or more than three in a file that is
  // too short for a line a vertex and a face.
  [[nodiscard]] bool breaks_lines_freely(const OffCounts& counts) const {
    TextLines lines(source_);
    while (lines.number() < text_.number()) {
      lines.next();
    }
    std::optional<std::string_view> first = lines.next_with_content(kOffComment);
    std::size_t count = first ? 1 : 0;
    while (lines.next_with_content(kOffComment)) {
      ++count;
    }
    std::size_t words = 0;
    while (first && !next_word(*first).empty()) {
      ++words;
    }
    const bool is_short = count < counts.vertices + counts.faces;
    return is_plain_ && (words == 1 || (words > 3 && is_short));
  }

  void read_lines(const OffCounts& counts) {
    for (std::size_t i = 0; i < counts.vertices; ++i) {
      const FilePart part{.kind = "vertex", .index = i};
      std::string_view line = text_.require_line(part, counts.vertices);
      mesh_.vertices.push_back(text_.require_position(line, part));
    }
    for (std::size_t i = 0; i < counts.faces; ++i) {
      const FilePart part{.kind = "face", .index = i};
      std::string_view line = text_.require_line(part, counts.faces);
      add_face(part, [&] { return next_word(line); });
    }
  }

  void read_words(const OffCounts& counts) {
    FreeWords words(text_);
    for (std::size_t i = 0; i < counts.vertices; ++i) {
      const FilePart part{.kind = "vertex", .index = i};
      Vec3& vertex = mesh_.vertices.emplace_back();
      for (double& coordinate : vertex) {
        std::string_view word = words.next(part, counts.vertices);
        coordinate = text_.require_number(word, part);
      }
    }
    for (std::size_t i = 0; i < counts.faces; ++i) {
      const FilePart part{.kind = "face", .index = i};
      add_face(part, [&] { return words.next(part, counts.faces); });
    }
    if (!words.line_is_used_up()) {
      text_.fail("numbers follow after the last face");
    }
  }

  // Reads the number of corners, then as many indices.
  template <class NextWord>
  void add_face(const FilePart& part, NextWord next) {
    const std::int64_t corners = text_.require_integer(next(), part);
    if (corners < 1) {
      text_.fail(fmt::format("{} has {} corners", part.name(), corners));
    }
    corners_.clear();
    for (std::int64_t k = 0; k < corners; ++k) {
      corners_.push_back(text_.require_index(next(), mesh_.vertices.size(), part));
    }
    mesh_.add(corners_);
  }

  std::string_view source_;
  MeshText text_;
  bool is_plain_ = true;
  PolygonMesh mesh_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

PolygonMesh read_off(const std::string& file, std::string_view text) {
  return OffReader(file, text).read();
}

}  // namespace tactus::host
