// Finds the part of a formula's bounds in which its surface is. The baker calls it.
#pragma once

#include "rendering/surface/implicit_surface.h"

namespace tactus::host {

// Returns a box within the bounds that holds all zeros: the bounds without the slabs at their six
// sides in which interval arithmetic proves that there are none, and with a little room
// about it.
rendering::Box bounds_of_zeros(const rendering::FormulaView& formula, const rendering::Box& bounds);

}  // namespace tactus::host
