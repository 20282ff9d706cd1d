#include "host_tools/bake/scene/shape_description.h"

#include <fmt/format.h>

#include <algorithm>

#include "host_tools/input_error.h"
#include "host_tools/mesh/primitive_mesh.h"

namespace tactus::host {
namespace {

using rendering::ContactMethod;
using rendering::DimensionKey;
using rendering::kContactMethods;
using rendering::kPrimitives;
using rendering::Primitive;
using rendering::PrimitiveTraits;

// Returns the names in quotes with commas, for messages.
template <class Named>
std::string list(const Named& all) {
  std::string text;
  for (const auto& one : all) {
    text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", one.name);
  }
  return text;
}

// Returns the numbers of a dimension's key. Throws InputError if they are missing.
std::vector<double> numbers_of(const TomlSection& section, const DimensionKey& dimension,
                               std::string_view primitive) {
  const bool is_list = dimension.count > 1;
  if (is_list) {
    if (const auto given = section.numbers(dimension.key, dimension.count)) {
      return *given;
    }
  } else if (const auto given = section.number(dimension.key, kAboveZero)) {
    return {*given};
  }
  section.fail(dimension.key, fmt::format("a {} needs {}; write {} = {}", primitive, dimension.key,
                                          dimension.key, is_list ? "[0.1, 0.05, 0.1]" : "0.03"));
}

// Returns the dimensions in the order of rendering::Primitive, where box, cylinder and capsule have
// half sizes.
rendering::PrimitiveDimensions dimensions(const TomlSection& section,
                                          const PrimitiveTraits& primitive) {
  rendering::PrimitiveDimensions result{};
  std::size_t next = 0;
  for (const DimensionKey& dimension : primitive.dimensions) {
    for (const double number : numbers_of(section, dimension, primitive.name)) {
      result[next++] = dimension.factor * number;
    }
  }
  return result;
}

// Returns the kind of surface that the method would touch. A formula is baked as a mesh for the
// methods that do not follow formulas.
rendering::SurfaceKind touched_surface(const ShapeDescription& shape, ContactMethod method) {
  if (std::holds_alternative<Primitive>(shape)) {
    return rendering::SurfaceKind::primitive;
  }
  const bool is_mesh =
      std::holds_alternative<std::monostate>(shape) || meshed_formula(shape, method) != nullptr;
  return is_mesh ? rendering::SurfaceKind::mesh : rendering::SurfaceKind::implicit;
}

std::string conditions() {
  std::string text;
  for (const PrimitiveTraits& primitive : kPrimitives) {
    if (!primitive.condition.empty()) {
      text += fmt::format(", and {}", primitive.condition);
    }
  }
  return text;
}

// Reads a formula and the box in which its surface is looked for.
ImplicitDescription read_implicit(const TomlSection& section, const std::string& text) {
  // In units of the formula, to each side.
  constexpr double kDefaultBound = 2.0;
  ImplicitDescription implicit;
  if (section.has("longest_side_m")) {
    section.fail("longest_side_m",
                 "longest_side_m is for mesh files; write scale, the length of the formula's unit "
                 "in m");
  }
  implicit.tolerance_m =
      section.number("tolerance_m", kAboveZero).value_or(kDefaultFormulaTolerance_m);
  try {
    implicit.formula = parse_formula(text);
  } catch (const InputError& error) {
    section.fail("formula", error.what());
  }
  implicit.bounds_O = {.lower = Vec3::Constant(-kDefaultBound),
                       .upper = Vec3::Constant(kDefaultBound)};
  if (const auto bounds = section.numbers("bounds", 6)) {
    const std::vector<double>& b = *bounds;
    implicit.bounds_O = {.lower = {b[0], b[1], b[2]}, .upper = {b[3], b[4], b[5]}};
    if (!((implicit.bounds_O.upper - implicit.bounds_O.lower).minCoeff() > 0.0)) {
      section.fail("bounds",
                   "bounds are empty; write the lower corner, then the upper one, as in "
                   "[-2.0, -2.0, -2.0, 2.0, 2.0, 2.0]");
    }
  }
  return implicit;
}

}  // namespace

std::vector<KeySpec> primitive_keys() {
  std::vector<KeySpec> keys{{"primitive", ""}};
  for (const PrimitiveTraits& primitive : kPrimitives) {
    for (const DimensionKey& dimension : primitive.dimensions) {
      if (std::ranges::find(keys, dimension.key, &KeySpec::name) == keys.end()) {
        keys.push_back({dimension.key, "m"});
      }
    }
  }
  return keys;
}

std::vector<KeySpec> shape_keys() {
  std::vector<KeySpec> keys = primitive_keys();
  keys.push_back({"formula", ""});
  keys.push_back({"bounds", ""});
  keys.push_back({"tolerance_m", "m"});
  return keys;
}

Primitive read_primitive(const TomlSection& section, const std::string& name,
                         const Placement& placement) {
  const auto* const kind = std::ranges::find(kPrimitives, name, &PrimitiveTraits::name);
  if (kind == kPrimitives.end()) {
    section.fail("primitive",
                 fmt::format("no primitive \"{}\"; write one of {}", name, list(kPrimitives)));
  }
  const Primitive primitive{.kind = kind->kind,
                            .X_WO = {placement.rotation.toRotationMatrix(), placement.position_m},
                            .dimensions_m = dimensions(section, *kind)};
  if (!valid(primitive)) {
    section.fail(
        "primitive",
        fmt::format("the {}'s dimensions must be above 0 and at most 100 m{}; correct them", name,
                    conditions()));
  }
  return primitive;
}

ShapeDescription read_shape(const TomlSection& section, const Placement& placement) {
  const auto primitive = section.text("primitive");
  const auto formula = section.text("formula");
  const int surfaces = (primitive ? 1 : 0) + (formula ? 1 : 0) + (section.has("mesh") ? 1 : 0);
  if (surfaces == 0) {
    section.fail("mesh",
                 "has no surface; write mesh = \"file.ply\", primitive = \"sphere\" or "
                 "formula = \"x^2 + y^2 + z^2 - 1\"");
  }
  if (surfaces > 1) {
    section.fail(primitive ? "primitive" : "formula",
                 "has more than one of mesh, primitive and formula; keep one, and make an "
                 "[[object]] of each other");
  }
  if (primitive) {
    return read_primitive(section, *primitive, placement);
  }
  return formula ? ShapeDescription{read_implicit(section, *formula)} : ShapeDescription{};
}

std::string_view surface_needed(ContactMethod method, const ShapeDescription& shape) {
  if (rendering::renders_surface(method, touched_surface(shape, method))) {
    return "";
  }
  return rendering::follows_formula(method) ? "formulas" : "meshes";
}

ContactMethod read_contact(const TomlSection& section, const ShapeDescription& shape) {
  const bool implicit = std::holds_alternative<ImplicitDescription>(shape);
  const std::string name = section.text("contact").value_or(implicit ? "tracking" : "sphere_proxy");
  const auto* const method =
      std::ranges::find(kContactMethods, name, &rendering::NamedContactMethod::name);
  if (method == kContactMethods.end()) {
    section.fail("contact", fmt::format("no contact method \"{}\"; write one of {}", name,
                                        list(kContactMethods)));
  }
  if (const std::string_view needs = surface_needed(method->method, shape); !needs.empty()) {
    section.fail("contact", fmt::format(R"("{}" is for {}; write "{}")", name, needs,
                                        implicit ? "tracking" : "sphere_proxy"));
  }
  if (section.has("push_out_mm") && !rendering::is_textbook_on_mesh(method->method)) {
    section.fail("push_out_mm",
                 "push_out_mm is for the contacts one_plane, three_sub_goals, three_step and "
                 "one_step; leave it out");
  }
  if (section.has("tolerance_m") && meshed_formula(shape, method->method) == nullptr) {
    section.fail("tolerance_m",
                 "tolerance_m is for a formula that is baked as a mesh; write contact = "
                 "\"sphere_proxy\" beside a formula, or leave it out");
  }
  return method->method;
}

const ImplicitDescription* meshed_formula(const ShapeDescription& shape, ContactMethod contact) {
  return rendering::follows_formula(contact) ? nullptr : std::get_if<ImplicitDescription>(&shape);
}

FormulaPicture picture_of(const ShapeDescription& shape, const Placement& placement,
                          rendering::Sides sides) {
  if (const auto* primitive = std::get_if<Primitive>(&shape)) {
    return {.mesh = primitive_mesh(*primitive), .notes = {}};
  }
  const auto& implicit = std::get<ImplicitDescription>(shape);
  FormulaPicture picture =
      draw_formula(implicit.formula.view(), implicit.bounds_O, placement.scale, sides);
  for (rendering::Float3& v : picture.mesh.vertices) {
    const Vec3 p =
        placement.position_m + placement.rotation * (placement.scale * rendering::to_vec3(v));
    v = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  }
  return picture;
}

}  // namespace tactus::host
