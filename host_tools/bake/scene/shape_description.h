// The part of an [[object]] that says what is touched where that is no mesh.
#pragma once

#include <variant>
#include <vector>

#include "host_tools/bake/formula/formula_parser.h"
#include "host_tools/bake/scene/placement.h"
#include "host_tools/bake/toml/toml_section.h"
#include "rendering/objects/object.h"

namespace tactus::host {

struct ImplicitDescription {
  Formula formula;
  rendering::Box bounds_O;  // units of the formula
};

// Nothing: the object's mesh.
using ShapeDescription = std::variant<std::monostate, rendering::Primitive, ImplicitDescription>;

// The keys of the section that this reads.
inline constexpr std::array kShapeKeys{
    KeySpec{"primitive", ""}, KeySpec{"radius_m", "m"},      KeySpec{"height_m", "m"},
    KeySpec{"size_m", "m"},   KeySpec{"ring_radius_m", "m"}, KeySpec{"tube_radius_m", "m"},
    KeySpec{"formula", ""},   KeySpec{"bounds", ""},
};

// Throws InputError with the file and the line. The placement's scale is the formula's unit.
ShapeDescription read_shape(const TomlSection& section, const Placement& placement);

// The primitive of that name, with the dimensions that the section gives.
rendering::Primitive read_primitive(const TomlSection& section, const std::string& name,
                                    const Placement& placement);

// Throws InputError when the method does not go with the shape.
rendering::ContactMethod read_contact(const TomlSection& section, const ShapeDescription& shape);

// Returns a mesh of the shape for pictures. Throws InputError, without a file name, when the
// formula has no surface within its bounds.
TriangleMesh picture_of(const ShapeDescription& shape, const Placement& placement);

}  // namespace tactus::host
