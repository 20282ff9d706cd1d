#include "host_tools/bake/mesh_file/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tactus::host {
namespace {

// The two names that each type has.
struct PlyTypeName {
  std::string_view name;
  std::string_view other_name;
  PlyType type;
  std::size_t bytes;
};
constexpr std::array kPlyTypes{
    PlyTypeName{"char", "int8", PlyType::int8, 1},
    PlyTypeName{"uchar", "uint8", PlyType::uint8, 1},
    PlyTypeName{"short", "int16", PlyType::int16, 2},
    PlyTypeName{"ushort", "uint16", PlyType::uint16, 2},
    PlyTypeName{"int", "int32", PlyType::int32, 4},
    PlyTypeName{"uint", "uint32", PlyType::uint32, 4},
    PlyTypeName{"float", "float32", PlyType::float32, 4},
    PlyTypeName{"double", "float64", PlyType::float64, 8},
};

PlyType ply_type(const MeshText& text, std::string_view word) {
  const auto* const found = std::ranges::find_if(
      kPlyTypes, [&](const PlyTypeName& t) { return t.name == word || t.other_name == word; });
  if (found == kPlyTypes.end()) {
    text.fail(fmt::format("'{}' is no type of PLY", word));
  }
  return found->type;
}

PlyFormat ply_format(const MeshText& text, std::string_view word) {
  if (word == "ascii") {
    return PlyFormat::ascii;
  }
  if (word == "binary_little_endian") {
    return PlyFormat::little_endian;
  }
  if (word != "binary_big_endian") {
    text.fail(fmt::format("'{}' is no format of PLY", word));
  }
  return PlyFormat::big_endian;
}

PlyElement ply_element(const MeshText& text, std::string_view rest) {
  PlyElement element{.name = std::string(next_word(rest)), .count = 0, .properties = {}};
  const std::optional<std::size_t> count = to_number<std::size_t>(next_word(rest));
  if (!count) {
    text.fail(fmt::format("element {} has no count", element.name));
  }
  element.count = *count;
  return element;
}

PlyProperty ply_property(const MeshText& text, std::string_view rest) {
  PlyProperty property;
  std::string_view word = next_word(rest);
  if (word == "list") {
    property.list_length = ply_type(text, next_word(rest));
    word = next_word(rest);
  }
  property.type = ply_type(text, word);
  property.name = next_word(rest);
  return property;
}

}  // namespace

bool PlyElement::has_list() const {
  return std::ranges::any_of(properties,
                             [](const PlyProperty& p) { return p.list_length.has_value(); });
}

const PlyElement* PlyHeader::find(std::string_view name) const {
  const auto found = std::ranges::find(elements, name, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

std::size_t size_of(PlyType type) {
  return std::ranges::find(kPlyTypes, type, &PlyTypeName::type)->bytes;
}

PlyHeader read_ply_header(MeshText& text) {
  PlyHeader header;
  const std::optional<std::string_view> first = text.next_raw_line();
  std::string_view magic = first.value_or("");
  if (next_word(magic) != "ply") {
    text.fail("a PLY file begins with the word ply");
  }
  while (std::optional<std::string_view> line = text.next_raw_line()) {
    const std::string_view word = next_word(*line);
    if (word == "end_header") {
      return header;
    }
    if (word == "format") {
      header.format = ply_format(text, next_word(*line));
    } else if (word == "element") {
      header.elements.push_back(ply_element(text, *line));
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(ply_property(text, *line));
    }
  }
  text.fail("the file ends before end_header");
}

}  // namespace tactus::host
