// The convex hulls of bodies and obstacles, where they are in a tick.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "rendering/bodies/placed_hull.h"
#include "rendering/bodies/solid_list.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// Lives in static storage; no heap. The hulls of solids that are not placed anew stay where they
// are.
class SolidHulls {
 public:
  // Places the hull of a solid that has one: of a body its parts, too.
  void place(const SolidList& solids, std::size_t solid);

  // Returns the hull of a solid. That of a body of several parts has their middle and their reach.
  [[nodiscard]] const PlacedHull& whole(std::size_t solid) const { return hulls_[solid]; }
  // Returns the hulls by which a solid meets others: one, or those of a body's parts.
  [[nodiscard]] std::span<const PlacedHull> parts_of(const SolidList& solids,
                                                     std::size_t solid) const;

 private:
  void place_body(const SolidList& solids, std::size_t body);

  std::array<PlacedHull, SolidList::kMostSolids> hulls_;
  std::array<PlacedHull, kMaxBodyParts> part_hulls_;
};

}  // namespace tactus::rendering
