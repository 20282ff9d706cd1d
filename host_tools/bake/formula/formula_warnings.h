// Tells what is odd about a formula within its bounds and can still be touched.
#pragma once

#include <string>
#include <vector>

#include "host_tools/bake/formula/zero_search.h"
#include "rendering/surface/implicit_surface.h"

namespace tactus::host {

// Returns a sentence with a place and a remedy for each function whose argument lies outside its
// domain, and one if the inside and the outside of a one-sided surface seem swapped. It looks at
// the points of a grid in the bounds.
std::vector<std::string> formula_warnings(const rendering::FormulaView& formula,
                                          const rendering::Box& bounds, rendering::Sides sides);

// Returns a sentence that says why a formula has no surface with an inside, from what a search of
// its bounds has found: on which side of 0 it is, how near it comes and down to which size it was
// searched. `unit_m` is the length of its unit in m.
std::string why_nowhere_zero(const ZeroSearch& zero, const rendering::Box& bounds, double unit_m);

// Returns a place within the bounds as "(0.5, 0, -1)"; what is 0 but for rounding becomes 0.
std::string place_text(const Vec3& place, const rendering::Box& bounds);

}  // namespace tactus::host
