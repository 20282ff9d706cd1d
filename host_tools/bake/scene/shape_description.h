// Reads what is touched of an [[object]]: a mesh, a primitive or a formula, and by which method.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "host_tools/bake/formula/formula_mesh.h"
#include "host_tools/bake/formula/formula_parser.h"
#include "host_tools/bake/formula/formula_picture.h"
#include "host_tools/bake/scene/placement.h"
#include "host_tools/bake/toml/toml_section.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// A surface given by a formula.
struct ImplicitDescription {
  Formula formula;
  // The box in which the surface lies, in the formula's own frame and unit.
  rendering::Box bounds_O;
  // The largest distance of its mesh from the surface, if it is baked as a mesh, m.
  double tolerance_m = kDefaultFormulaTolerance_m;
};

// Nothing means that the object is a mesh.
using ShapeDescription = std::variant<std::monostate, rendering::Primitive, ImplicitDescription>;

// Returns the keys of the dimensions of all primitives, each once.
std::vector<KeySpec> primitive_keys();

// Returns the keys of the section that read_shape reads.
std::vector<KeySpec> shape_keys();

// Reads the shape. The placement's scale is the formula's unit in m. Throws InputError with the
// file and the line if the object has no surface or more than one.
ShapeDescription read_shape(const TomlSection& section, const Placement& placement);

// Returns the primitive of that name with the dimensions that the section gives, at the placement's
// pose. Throws InputError with the file and the line.
rendering::Primitive read_primitive(const TomlSection& section, const std::string& name,
                                    const Placement& placement);

// Returns the contact method, or the shape's default. Throws InputError if the method does not go
// with the shape.
rendering::ContactMethod read_contact(const TomlSection& section, const ShapeDescription& shape);

// Returns the surfaces that the method needs, "meshes" or "formulas", if the shape is not one of
// them; empty if the method can render the shape.
std::string_view surface_needed(rendering::ContactMethod method, const ShapeDescription& shape);

// Returns the formula that is baked as a mesh, because its contact is not that of formulas; nullptr
// for every other shape.
const ImplicitDescription* meshed_formula(const ShapeDescription& shape,
                                          rendering::ContactMethod contact);

// Returns a mesh of the shape in the world frame, m, for pictures and for the path of a simulated
// hand. Throws InputError, without a file name, if the formula has no surface within its bounds.
FormulaPicture picture_of(const ShapeDescription& shape, const Placement& placement,
                          rendering::Sides sides);

}  // namespace tactus::host
