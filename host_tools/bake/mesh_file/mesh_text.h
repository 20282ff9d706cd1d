// Steps through the text of a mesh file and takes numbers off its lines, with the file and the line
// in every error. The readers of text formats use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "host_tools/bake/toml/text_lines.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// A part of a file, as errors name it, for example "vertex 3".
struct FilePart {
  std::string_view kind;
  std::size_t index = 0;

  [[nodiscard]] std::string name() const;
};

// The lines of one file. Every error is an InputError `file:line: what; remedy`.
class MeshText {
 public:
  // `comment` begins a comment, which ends with its line; '\0' for a format without comments.
  MeshText(std::string file, std::string_view text, char comment)
      : file_(std::move(file)), lines_(text), comment_(comment) {}

  [[noreturn]] void fail(std::size_t line, const std::string& what) const;
  [[noreturn]] void fail(const std::string& what) const { fail(lines_.number(), what); }

  // Returns the next line with content, without its comment; nothing at the end.
  std::optional<std::string_view> next_line() { return lines_.next_with_content(comment_); }
  // Returns the same. Throws InputError at the end, where `what` is missing.
  std::string_view require_line(std::string_view what);
  std::string_view require_line(const FilePart& part, std::size_t total);
  // Returns the next line as it is, empty ones too.
  std::optional<std::string_view> next_raw_line() { return lines_.next(); }

  // Takes a finite number off the line. `part` is its owner.
  double require_number(std::string_view& line, const FilePart& part) const;
  // Takes three finite numbers off the line.
  Vec3 require_position(std::string_view& line, const FilePart& part) const;
  // Returns a whole number.
  [[nodiscard]] std::int64_t require_integer(std::string_view word, const FilePart& part) const;
  // Returns an index of one of `vertices` vertices, counted from 0.
  [[nodiscard]] std::uint32_t require_index(std::string_view word, std::size_t vertices,
                                            const FilePart& part) const;

  // Returns a note on lines with content that are left, which a reader does not need: `what` it has
  // read. Nothing if there are none.
  std::optional<std::string> note_on_rest(const std::string& what);

  // Returns the number of the line that was given out last.
  [[nodiscard]] std::size_t number() const { return lines_.number(); }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string file_;
  TextLines lines_;
  char comment_;
};

// Returns the number that makes up the whole word, also if it is too large or too small for a
// double; then it is infinite or 0.
std::optional<double> any_number(std::string_view word);

}  // namespace tactus::host
