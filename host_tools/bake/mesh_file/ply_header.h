// Reads the header of a PLY file (Stanford polygon format).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/bake/mesh_file/mesh_text.h"

namespace tactus::host {

// The types of PLY numbers.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

// A number of each entry of an element, or a list of numbers.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  // The type of a list's length; nothing for a single number.
  std::optional<PlyType> list_length;
};

// A table of the file: `count` entries with the same properties.
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  // Returns true if a property is a list.
  [[nodiscard]] bool has_list() const;
};

// The encoding of the numbers below the header.
enum class PlyFormat { ascii, little_endian, big_endian };

// The whole header.
struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;

  // Returns the element of that name; nullptr if there is none.
  [[nodiscard]] const PlyElement* find(std::string_view name) const;
};

// Returns the header and leaves `text` at the line after it. Throws InputError `file:line: ...` for
// an unknown format or type, an element without a count, and a missing end.
PlyHeader read_ply_header(MeshText& text);

// Returns the bytes of a number of this type.
std::size_t size_of(PlyType type);

}  // namespace tactus::host
