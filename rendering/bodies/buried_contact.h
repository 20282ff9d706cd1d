// The contacts of a part that the other parts of its solid hide.
#pragma once

#include <span>

#include "rendering/bodies/manifold.h"
#include "rendering/bodies/placed_hull.h"

namespace tactus::rendering {

// Returns true if a part is touched where nothing can touch it: at a face or an edge that lies
// within another part of the solid, or flush with its surface. `sign` is 1 where the solid is A of
// the manifold, and -1 where it is B. A body that slides over the seam of two parts would catch
// there. A face that rises above the other part, as a wall does above a floor, is not hidden.
bool is_buried(std::span<const PlacedHull> parts, const PlacedHull& part, const Manifold& manifold,
               double sign);

}  // namespace tactus::rendering
