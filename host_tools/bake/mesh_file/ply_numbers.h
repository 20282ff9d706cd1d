// Gives out the numbers behind the header of a PLY file, written as text or in binary.
#pragma once

#include <string>
#include <string_view>

#include "host_tools/bake/mesh_file/mesh_text.h"
#include "host_tools/bake/mesh_file/ply_header.h"

namespace tactus::host {

// The numbers of one file. Errors are InputError with the file and, in text, the line.
class PlyNumbers {
 public:
  // `text` is behind the header; `body` is the content from there on.
  PlyNumbers(MeshText& text, std::string_view body, PlyFormat format)
      : text_(text), body_(body), format_(format) {}

  // Goes to the next entry: in text it has a line of its own. `total` is the number of its like.
  void start(const FilePart& part, std::size_t total);
  // Returns the entry's next number, which may be infinite or NaN.
  double next(PlyType type);
  // Returns the entry's next number. Throws InputError unless it is finite.
  double next_finite(PlyType type);
  // Returns the entry's next number. Throws InputError unless it is whole.
  std::int64_t next_whole(PlyType type);

  // Throws InputError about the present entry: `what` follows its name.
  [[noreturn]] void fail(const std::string& what) const;

  // Returns a note on lines with more numbers than their entries have, for after the last entry;
  // nothing if there are none.
  std::optional<std::string> note_on_lines();
  // Returns a note on content that is left; nothing if there is none.
  std::optional<std::string> note_on_rest();

 private:
  // Counts the present line if words of it are left.
  void count_unused_words();

  MeshText& text_;
  std::string_view body_;
  PlyFormat format_;
  FilePart part_;
  std::size_t total_ = 0;
  // Text: the rest of the entry's line.
  std::string_view line_;
  std::size_t lines_with_more_ = 0;
  std::size_t first_with_more_ = 0;
};

}  // namespace tactus::host
