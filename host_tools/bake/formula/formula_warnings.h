// Tells what is odd about a formula within its bounds and can still be touched.
#pragma once

#include <string>
#include <vector>

#include "rendering/surface/implicit_surface.h"

namespace tactus::host {

// Returns a sentence with a place and a remedy for each function whose argument lies outside its
// domain, and one if the inside and the outside of a one-sided surface seem swapped. It looks at
// the points of a grid in the bounds.
std::vector<std::string> formula_warnings(const rendering::FormulaView& formula,
                                          const rendering::Box& bounds, rendering::Sides sides);

// Returns a sentence that says why a formula without a surface has none: on which side of 0 it is,
// and how near it comes.
std::string why_nowhere_zero(const rendering::FormulaView& formula, const rendering::Box& bounds);

// Returns a place within the bounds as "(0.5, 0, -1)"; what is 0 but for rounding becomes 0.
std::string place_text(const Vec3& place, const rendering::Box& bounds);

}  // namespace tactus::host
