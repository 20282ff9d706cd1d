// For a processor on which formulas are not compiled.
#include "tests/property/formula_of_shape.h"

namespace tactus::testing {

std::optional<FormulaOfShape> formula_of(const TouchedShape& /*shape*/, rendering::Sides /*sides*/,
                                         const rendering::Material& /*material*/) {
  return std::nullopt;
}

}  // namespace tactus::testing
