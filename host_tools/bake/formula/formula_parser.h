// Compiles the text of a formula, such as `(x^2+9/4*y^2+z^2-1)^3 - x^2*z^3 - 9/80*y^2*z^3`, into
// the instructions that the controller evaluates. The baker calls it. rendering/surface/README.md
// describes the language.
#pragma once

#include <string_view>
#include <vector>

#include "rendering/surface/formula.h"

namespace tactus::host {

// A compiled formula.
struct Formula {
  std::vector<rendering::Instruction> instructions;

  [[nodiscard]] rendering::FormulaView view() const { return {instructions}; }
};

// Returns a formula that passes rendering::check(). Throws InputError, one line: the column, what
// is wrong, the remedy, and the place in the text.
Formula parse_formula(std::string_view text);

}  // namespace tactus::host
