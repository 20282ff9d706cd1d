// Decides whether a formula is 0 somewhere within its bounds, however thin or small the place is,
// and tells how near the search has looked if it is not. The baker calls it.
#pragma once

#include <cstdint>

#include "rendering/surface/implicit_surface.h"

namespace tactus::host {

// A part of the bounds of this size counts as a point, m. The tracker too does not tell a touch
// from a miss that is nearer (rendering/contact/first_crossing.h).
inline constexpr double kPoint_m = 1e-9;

enum class ZeroKind : std::uint8_t {
  // The formula is above 0 and below 0.
  crossed,
  // It is 0, to a point's size, and was not found to change its sign.
  touched,
  // It is 0 in a whole region, where the tracker has no slope to rest on, and was not found to
  // change its sign.
  flat,
  // Interval arithmetic proves that it is nowhere 0.
  none,
  // It was not found to be 0, and parts of the bounds are left of which nothing is proved.
  undecided,
};

// The result of a search. Places and lengths are in the formula's own units.
struct ZeroSearch {
  ZeroKind kind = ZeroKind::none;
  // A zero; if there is none, the place at which the formula was found to be nearest to 0.
  Vec3 place = Vec3::Zero();
  // The formula there, 0 if it is crossed.
  double value = 0.0;
  // True if the formula is below 0 where it was looked at first.
  bool is_below = false;
  // The longest side of the parts of which nothing is proved, and the middle of one of them; 0 if
  // it is not undecided.
  double undecided_size = 0.0;
  Vec3 undecided = Vec3::Zero();
};

// Searches the bounds, for a second or two at most. `unit_m` is the length of the formula's unit in
// m. The formula should have no pole within the bounds: there it changes its sign without a zero.
ZeroSearch search_zero(const rendering::FormulaView& formula, const rendering::Box& bounds,
                       double unit_m);

}  // namespace tactus::host
