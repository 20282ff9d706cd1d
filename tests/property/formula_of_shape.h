// A primitive as a formula, where the program that compiles formulas is built.
#pragma once

#include <optional>
#include <vector>

#include "rendering/objects/object.h"
#include "rendering/surface/formula.h"
#include "tests/property/closed_form.h"

namespace tactus::testing {

// An object, and the formula that it points into.
struct FormulaOfShape {
  std::vector<rendering::Instruction> instructions;
  rendering::Object object;
};

// Returns the formula of the surface that the tool's centre cannot pass: the primitive's, less the
// radius of the tool, since a formula is touched by a point. Returns nothing if there is none, or
// if formulas cannot be compiled here.
std::optional<FormulaOfShape> formula_of(const TouchedShape& shape, rendering::Sides sides,
                                         const rendering::Material& material);

}  // namespace tactus::testing
