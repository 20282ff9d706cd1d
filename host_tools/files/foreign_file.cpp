#include "host_tools/files/foreign_file.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace tactus::host {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kUnpack =
    "is a compressed archive or a spreadsheet; unpack it, or save it as plain text";
constexpr std::string_view kPicture = "is a picture or a document; name the right file";
constexpr std::string_view kUtf16 = "is UTF-16 text; save it as UTF-8";
constexpr std::string_view kWebPage =
    "is a web page and not the file itself; download the file that the page links to";

constexpr std::array kForeign{
    FileBeginning{"version https://git-lfs", "",
                  "is a Git LFS pointer and not the file itself; fetch it with: git lfs pull"},
    FileBeginning{"/annex/objects/", "",
                  "is a git-annex pointer and not the file itself; fetch it with: git annex get"},
    FileBeginning{"\xff\xfe"sv, "", kUtf16},
    FileBeginning{"\xfe\xff"sv, "", kUtf16},
    FileBeginning{"<!doctype html", "", kWebPage},
    FileBeginning{"<html", "", kWebPage},
    FileBeginning{"pk\x03\x04", ".3mf .zae .q3o .q3s .pk3", kUnpack},
    FileBeginning{"7z\xbc\xaf", "", kUnpack},
    FileBeginning{"rar!", "", kUnpack},
    FileBeginning{"\x1f\x8b"sv, "", "is compressed by gzip; unpack it with: gunzip"},
    FileBeginning{"bzh", "", "is compressed by bzip2; unpack it with: bunzip2"},
    FileBeginning{"\xfd\x37\x7a\x78\x7a"sv, "", "is compressed by xz; unpack it with: unxz"},
    FileBeginning{"%pdf", "", kPicture},
    FileBeginning{"\x89png", "", kPicture},
    FileBeginning{"\xff\xd8\xff"sv, "", kPicture},
    FileBeginning{"gif8", "", kPicture},
};

// Returns true if of the first bytes just those at even places, or just those at odd ones, are 0,
// as in UTF-16 without a mark.
bool alternates_with_zero(std::string_view content) {
  constexpr std::size_t kEnough = 16;
  const auto zeros_are_at = [&](std::size_t parity) {
    for (std::size_t i = 0; i < kEnough; ++i) {
      if ((content[i] == '\0') != (i % 2 == parity)) {
        return false;
      }
    }
    return true;
  };
  return content.size() >= kEnough && (zeros_are_at(0) || zeros_are_at(1));
}

// Returns true if `extensions` has this one among its words.
bool lists(std::string_view extensions, std::string_view extension) {
  while (!extensions.empty()) {
    const std::size_t end = std::min(extensions.find(' '), extensions.size());
    if (extensions.substr(0, end) == extension) {
      return true;
    }
    extensions.remove_prefix(std::min(end + 1, extensions.size()));
  }
  return false;
}

}  // namespace

bool begins_as(std::string_view content, std::string_view extension, const FileBeginning& kind) {
  content = without_byte_order_mark(content);
  content.remove_prefix(std::min(content.find_first_not_of(" \t\r\n\v\f"), content.size()));
  const bool same = content.size() >= kind.begins.size() &&
                    std::ranges::equal(content.substr(0, kind.begins.size()), kind.begins,
                                       [](unsigned char c, char lower) {
                                         return static_cast<char>(std::tolower(c)) == lower;
                                       });
  return same && !lists(kind.allowed, extension);
}

std::string_view foreign_content(std::string_view content, std::string_view extension) {
  for (const FileBeginning& kind : kForeign) {
    if (begins_as(content, extension, kind)) {
      return kind.message;
    }
  }
  if (alternates_with_zero(content)) {
    return kUtf16;
  }
  if (!content.empty() && content.find_first_not_of('\0') == std::string_view::npos) {
    return "has nothing but zeros; copy or download it again";
  }
  return {};
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) {
    text.remove_prefix(kMark.size());
  }
  return text;
}

}  // namespace tactus::host
