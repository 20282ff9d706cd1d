#include "host_tools/bake/scene/shape_description.h"

#include <fmt/format.h>

#include <algorithm>

#include "host_tools/input_error.h"
#include "host_tools/mesh/level_set.h"
#include "host_tools/mesh/primitive_mesh.h"

namespace tactus::host {
namespace {

using rendering::ContactMethod;
using rendering::Primitive;
using rendering::PrimitiveKind;

// The names of the primitives in TOML.
struct NamedKind {
  std::string_view name;
  PrimitiveKind kind;
};
constexpr std::array kKinds{
    NamedKind{"plane", PrimitiveKind::plane},     NamedKind{"sphere", PrimitiveKind::sphere},
    NamedKind{"box", PrimitiveKind::box},         NamedKind{"cylinder", PrimitiveKind::cylinder},
    NamedKind{"capsule", PrimitiveKind::capsule}, NamedKind{"cone", PrimitiveKind::cone},
    NamedKind{"torus", PrimitiveKind::torus},
};

// The names of the contact methods in TOML.
struct NamedMethod {
  std::string_view name;
  ContactMethod method;
};
constexpr std::array kMethods{
    NamedMethod{"sphere_proxy", ContactMethod::sphere_proxy},
    NamedMethod{"god_object", ContactMethod::god_object},
    NamedMethod{"potential_field", ContactMethod::potential_field},
    NamedMethod{"feature_walk", ContactMethod::feature_walk},
    NamedMethod{"tracking", ContactMethod::tracking},
};

// Returns the names in quotes with commas, for messages.
template <class Named>
std::string list(const Named& all) {
  std::string text;
  for (const auto& one : all) {
    text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", one.name);
  }
  return text;
}

// Returns a size above 0 that must be given, m.
double required(const TomlSection& section, std::string_view key, std::string_view kind) {
  const std::optional<double> value = section.number(key, kAboveZero);
  if (!value) {
    section.fail(key, fmt::format("a {} needs {}; write {} = 0.03", kind, key, key));
  }
  return *value;
}

// Returns the primitive's dimensions in the order of rendering::Primitive, where box, cylinder and
// capsule have half sizes.
std::array<double, 3> dimensions(const TomlSection& section, const NamedKind& kind) {
  const auto get = [&](std::string_view key) { return required(section, key, kind.name); };
  switch (kind.kind) {
    case PrimitiveKind::plane:
      return {};
    case PrimitiveKind::sphere:
      return {get("radius_m"), 0.0, 0.0};
    case PrimitiveKind::cone:
      return {get("radius_m"), get("height_m"), 0.0};
    case PrimitiveKind::torus:
      return {get("ring_radius_m"), get("tube_radius_m"), 0.0};
    case PrimitiveKind::box: {
      const auto size = section.numbers("size_m", 3);
      if (!size) {
        section.fail("size_m", "a box needs size_m; write size_m = [0.1, 0.05, 0.1]");
      }
      return {0.5 * (*size)[0], 0.5 * (*size)[1], 0.5 * (*size)[2]};
    }
    default:
      return {get("radius_m"), 0.5 * get("height_m"), 0.0};
  }
}

// Reads a formula and the box in which its surface is looked for.
ImplicitDescription read_implicit(const TomlSection& section, const std::string& text) {
  // In units of the formula, to each side.
  constexpr double kDefaultBound = 2.0;
  ImplicitDescription implicit;
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

Primitive read_primitive(const TomlSection& section, const std::string& name,
                         const Placement& placement) {
  const auto* const kind = std::ranges::find(kKinds, name, &NamedKind::name);
  if (kind == kKinds.end()) {
    section.fail("primitive",
                 fmt::format("no primitive \"{}\"; write one of {}", name, list(kKinds)));
  }
  const Primitive primitive{.kind = kind->kind,
                            .X_WO = {placement.rotation.toRotationMatrix(), placement.position_m},
                            .dimensions_m = dimensions(section, *kind)};
  if (!valid(primitive)) {
    section.fail("primitive", fmt::format("the {}'s dimensions must be above 0 and at most 100 m, "
                                          "and a torus's tube thinner than its ring; correct them",
                                          name));
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

ContactMethod read_contact(const TomlSection& section, const ShapeDescription& shape) {
  const bool implicit = std::holds_alternative<ImplicitDescription>(shape);
  const std::string name = section.text("contact").value_or(implicit ? "tracking" : "sphere_proxy");
  const auto* const method = std::ranges::find(kMethods, name, &NamedMethod::name);
  if (method == kMethods.end()) {
    section.fail("contact",
                 fmt::format("no contact method \"{}\"; write one of {}", name, list(kMethods)));
  }
  if (implicit != (method->method == ContactMethod::tracking)) {
    section.fail("contact", implicit
                                ? R"(a formula is touched by "tracking" alone; leave contact out)"
                                : R"("tracking" is for formulas; write "sphere_proxy")");
  }
  if (method->method == ContactMethod::feature_walk &&
      !std::holds_alternative<std::monostate>(shape)) {
    section.fail("contact", R"("feature_walk" is for meshes; write "sphere_proxy")");
  }
  return method->method;
}

TriangleMesh picture_of(const ShapeDescription& shape, const Placement& placement) {
  // Parts of the box along each side, for the picture.
  constexpr int kCells = 40;
  if (const auto* primitive = std::get_if<Primitive>(&shape)) {
    return primitive_mesh(*primitive);
  }
  const auto& implicit = std::get<ImplicitDescription>(shape);
  const rendering::FormulaView formula = implicit.formula.view();
  TriangleMesh mesh = mesh_level_set([&](const Vec3& p) { return evaluate(formula, p); },
                                     implicit.bounds_O.lower, implicit.bounds_O.upper, kCells);
  if (mesh.triangles.empty()) {
    throw InputError("the formula is nowhere 0 within its bounds; correct it, or widen bounds");
  }
  for (rendering::Float3& v : mesh.vertices) {
    const Vec3 p =
        placement.position_m + placement.rotation * (placement.scale * rendering::to_vec3(v));
    v = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  }
  return mesh;
}

}  // namespace tactus::host
