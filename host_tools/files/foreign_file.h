// Recognises content that is not what its file's name says: a pointer in place of the file, a web
// page, an archive, text in UTF-16. The readers of meshes and tables use it.
#pragma once

#include <string_view>

namespace tactus::host {

// Returns what the content is and the remedy, for a sentence that begins "this file", if no text or
// binary file of this program's begins so; empty else. `extension` is the file's, in lower case
// with its point: formats that are archives pass.
std::string_view foreign_content(std::string_view content, std::string_view extension);

// Returns the text without the byte-order mark of UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

// The beginning of a kind of file, in lower case.
struct FileBeginning {
  std::string_view begins;
  // The extensions, separated by blanks, of files that may begin so.
  std::string_view allowed;
  // The kind and the remedy, for a sentence that begins "this file".
  std::string_view message;
};

// Returns true if the content begins so, with blanks before and capitals ignored, and the extension
// is not allowed to.
bool begins_as(std::string_view content, std::string_view extension, const FileBeginning& kind);

}  // namespace tactus::host
