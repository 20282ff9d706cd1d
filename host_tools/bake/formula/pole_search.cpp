// The search halves the bounds along the longest side, again and again. A part is left behind if no
// divisor is 0 in it and the formula's range is finite, or if that is below 0 and solid. A part
// that is still neither when it is too small to be halved is reported: its pole, if it is none, is
// so narrow that no tick could tell.
#include "host_tools/bake/formula/pole_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tactus::host {
namespace {

using rendering::Box;

// The smallest part, as a share of the longest side of the bounds.
constexpr double kSmallestShare = 1e-7;
// A search that takes longer than this reports the part that it has come to.
constexpr std::size_t kMostParts = 200'000;

// Returns true if a range holds 0, or reaches so near to it that a quotient changes beyond measure.
bool nears_zero(const rendering::Interval& range) {
  constexpr double kNear = 1e-6;
  const double least = std::max(range.lower(), -range.upper());
  return !(least > kNear * std::max(std::abs(range.lower()), std::abs(range.upper())));
}

// Returns true if a divisor may be 0 within the box. The instructions up to a divisor are a formula
// of their own. The quotient's range need not show in the whole formula's, as in exp(1/x).
bool may_divide_by_zero(const rendering::FormulaView& formula, const Box& box) {
  return std::ranges::any_of(formula.instructions, [&](const rendering::Instruction& i) {
    if (i.opcode != rendering::Opcode::divide) {
      return false;
    }
    const rendering::FormulaView divisor{formula.instructions.first(i.b + std::size_t{1})};
    return nears_zero(evaluate_box(divisor, box.lower, box.upper));
  });
}

bool may_hold_pole(const rendering::FormulaView& formula, const Box& box, rendering::Sides sides) {
  const rendering::Interval range = evaluate_box(formula, box.lower, box.upper);
  const bool is_solid = sides == rendering::Sides::one && range.upper() < 0.0;
  const bool is_finite = std::isfinite(range.lower()) && std::isfinite(range.upper());
  return !is_solid && (!is_finite || may_divide_by_zero(formula, box));
}

}  // namespace

std::optional<Vec3> find_pole(const rendering::FormulaView& formula, const Box& bounds,
                              rendering::Sides sides) {
  const double smallest = kSmallestShare * (bounds.upper - bounds.lower).maxCoeff();
  std::vector<Box> parts{bounds};
  for (std::size_t looked_at = 0; !parts.empty(); ++looked_at) {
    const Box part = parts.back();
    parts.pop_back();
    if (!may_hold_pole(formula, part, sides)) {
      continue;
    }
    int axis = 0;
    const double side = (part.upper - part.lower).maxCoeff(&axis);
    const double middle = 0.5 * (part.lower[axis] + part.upper[axis]);
    if (side <= smallest || looked_at >= kMostParts) {
      return 0.5 * (part.lower + part.upper);
    }
    Box& low = parts.emplace_back(part);
    low.upper[axis] = middle;
    Box& high = parts.emplace_back(part);
    high.lower[axis] = middle;
  }
  return std::nullopt;
}

}  // namespace tactus::host
