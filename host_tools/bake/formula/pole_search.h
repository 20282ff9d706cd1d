// Finds the poles of a formula: places where it divides by zero, or where it is too large for a
// double. At a pole a value tells nothing about the distance of the surface, so the proxy could be
// held there by a wall that nobody wrote.
#pragma once

#include <optional>

#include "rendering/surface/implicit_surface.h"

namespace tactus::host {

// Returns a place within the bounds, in the formula's own units, at or beside a pole that the proxy
// could reach. It returns nothing if interval arithmetic proves that there is none. A pole inside a
// one-sided solid, such as that of 1 - 1/(x^2 + y^2 + z^2), is out of the proxy's reach.
std::optional<Vec3> find_pole(const rendering::FormulaView& formula, const rendering::Box& bounds,
                              rendering::Sides sides);

}  // namespace tactus::host
