// Finds the cells of a tree in which the surface of a formula is finer than the cell.
#pragma once

#include <optional>

#include "host_tools/bake/formula/cell_tree.h"

namespace tactus::host {

// Returns true if the surface may be finer than the cell, so that a vertex is too little for it:
// the corners on one side of the surface are not connected by edges, or the sign changes well
// within the cell and at none of its corners.
bool is_too_coarse(const rendering::FormulaView& formula, const CellTree& tree, const Leaf& leaf);

// Splits the cells in which the surface is finer than the cell, down to a size in steps of the
// finest grid. Returns a place of those that are left, in the formula's units.
std::optional<Vec3> split_unclear(const rendering::FormulaView& formula, CellTree& tree,
                                  int least_size);

}  // namespace tactus::host
