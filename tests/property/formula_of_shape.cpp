// The ready shapes of formulas run along z, the primitives along y.
//
// Less r, `sphere`, `capsule`, `torus` and `plane` are what a sphere of radius r touches. `box`,
// `cylinder` and `cone` are so on their faces only, since less r their edges stay sharp, where the
// sphere rolls round them: from outside a sphere touches the lengths below instead. From within
// there are no edges to roll round, and all of them are exact.
#include "tests/property/formula_of_shape.h"

#include <sstream>
#include <string>

#include "host_tools/bake/formula/formula_parser.h"

namespace tactus::testing {
namespace {

using rendering::PrimitiveKind;

// A distance with more digits than the surface needs.
class Text {
 public:
  Text() { text_.precision(17); }
  template <class... Parts>
  std::string of(const Parts&... parts) {
    (text_ << ... << parts);
    return text_.str();
  }

 private:
  std::ostringstream text_;
};

// Returns the distance from a solid outside of it; empty if no short formula gives it.
std::string distance_outside(const TouchedShape& shape) {
  const auto& [a, b, c] = shape.primitive.dimensions_m;
  switch (shape.primitive.kind) {
    case PrimitiveKind::box:
      return Text().of("length(max(abs(x) - ", a, ", 0), max(abs(y) - ", c, ", 0), max(abs(z) - ",
                       b, ", 0))");
    case PrimitiveKind::cylinder:
      return Text().of("length(max(length(x, y) - ", a, ", 0), max(abs(z) - ", b, ", 0))");
    default:
      return {};
  }
}

std::string ready_shape(const TouchedShape& shape) {
  const auto& [a, b, c] = shape.primitive.dimensions_m;
  switch (shape.primitive.kind) {
    case PrimitiveKind::plane:
      return "plane(0, 0, 1, 0)";
    case PrimitiveKind::sphere:
      return Text().of("sphere(", a, ")");
    case PrimitiveKind::box:
      return Text().of("box(", 2.0 * a, ", ", 2.0 * c, ", ", 2.0 * b, ")");
    case PrimitiveKind::cylinder:
      return Text().of("cylinder(", a, ", ", 2.0 * b, ")");
    case PrimitiveKind::capsule:
      return Text().of("capsule(", a, ", ", 2.0 * b, ")");
    case PrimitiveKind::cone:
      return Text().of("cone(", a, ", ", b, ")");
    case PrimitiveKind::torus:
      return Text().of("torus(", a, ", ", b, ")");
  }
  return {};
}

std::string text_of(const TouchedShape& shape) {
  const PrimitiveKind kind = shape.primitive.kind;
  const bool has_edges =
      kind == PrimitiveKind::box || kind == PrimitiveKind::cylinder || kind == PrimitiveKind::cone;
  const bool rolls = has_edges && shape.side == Side::outside && shape.tool_radius_m > 0.0;
  const std::string distance = rolls ? distance_outside(shape) : ready_shape(shape);
  const char* const sign = shape.side == Side::outside ? " - " : " + ";
  return distance.empty() ? distance : Text().of(distance, sign, shape.tool_radius_m);
}

}  // namespace

std::optional<FormulaOfShape> formula_of(const TouchedShape& shape, rendering::Sides sides,
                                         const rendering::Material& material) {
  constexpr double kRoom_m = 0.3;
  const std::string text = text_of(shape);
  if (text.empty()) {
    return std::nullopt;
  }
  const rendering::RigidPose& X_WO = shape.primitive.X_WO;
  Mat3 z_to_y;
  z_to_y << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  FormulaOfShape formula{.instructions = host::parse_formula(text).instructions};
  formula.object = {.surface = rendering::SurfaceKind::implicit,
                    .method = rendering::ContactMethod::tracking,
                    .implicit = {.formula = {formula.instructions},
                                 .bounds_O = {.lower = Vec3::Constant(-kRoom_m),
                                              .upper = Vec3::Constant(kRoom_m)},
                                 .R_WO = X_WO.rotation * z_to_y,
                                 .p_WO = X_WO.translation,
                                 .sides = sides},
                    .sides = sides,
                    .material = material};
  return formula;
}

}  // namespace tactus::testing
