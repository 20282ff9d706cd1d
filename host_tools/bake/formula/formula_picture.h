// Draws a formula: the mesh by which it is shown, and round which a simulated hand moves. It is
// touched without it.
#pragma once

#include <string>
#include <vector>

#include "host_tools/mesh/triangle_mesh.h"
#include "rendering/surface/implicit_surface.h"

namespace tactus::host {

// A picture in the formula's frame and units.
struct FormulaPicture {
  TriangleMesh mesh;
  // Sentences that say what the picture does not show as it is.
  std::vector<std::string> notes;
};

// Returns the picture. `unit_m` is the length of the formula's unit in m. Throws InputError,
// without a file name, if the formula is not 0 anywhere within its bounds (zero_search.h).
FormulaPicture draw_formula(const rendering::FormulaView& formula, const rendering::Box& bounds,
                            double unit_m, rendering::Sides sides);

}  // namespace tactus::host
