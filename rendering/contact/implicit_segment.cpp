#include "rendering/contact/implicit_segment.h"

#include <algorithm>
#include <cstddef>

#include "rendering/contact/implicit_sample.h"

namespace tactus::rendering {

// The slabs of the box, axis by axis (Kay and Kajiya, SIGGRAPH 1986). A segment along a slab is in
// it or not, whatever its length.
Inside clip(const Box& box, const Vec3& from, const Vec3& segment) {
  Inside inside;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = box.lower[axis] - from[axis];
    const double upper = box.upper[axis] - from[axis];
    if (segment[axis] == 0.0) {
      inside.leave = lower <= 0.0 && upper >= 0.0 ? inside.leave : -1.0;
      continue;
    }
    const double one = lower / segment[axis];
    const double other = upper / segment[axis];
    inside.enter = std::max(inside.enter, std::min(one, other));
    inside.leave = std::min(inside.leave, std::max(one, other));
  }
  return inside;
}

SweptSegment sweep_segment(ImplicitField& field, const Vec3& from, const Vec3& to,
                           std::optional<double> value_from) {
  // The segment ends where it is known to be free if it would take more intervals.
  constexpr std::size_t kMostRanges = 64;
  // A part of the segment beyond the bounds is cut off: the caller goes on from the border, where
  // nothing blocks it.
  const Vec3 whole = to - from;
  const double leave = clip(field.surface().bounds_O, from, whole).leave;
  SweptSegment segment{.from = from,
                       .to = leave < 1.0 ? Vec3{from + std::max(leave, 0.0) * whole} : to,
                       .crossing = {}};
  // A segment that leaves the bounds at once is free: it stands on the wall of the box.
  if (leave > 0.0) {
    segment.crossing =
        first_crossing(field, from, segment.to, kMostRanges, {.from = value_from, .to = {}});
  }
  return segment;
}

// A longer rise would be no correction but a move: the caller then takes another way.
std::optional<Vec3> raised_to_rest(ImplicitField& field, const Vec3& from) {
  constexpr double kMostRise = 4.0 * kImplicitRest_m;
  constexpr std::size_t kFewRanges = 8;
  const ImplicitSurface& surface = field.surface();
  const auto up = settle_at_rest(field, from, kMostRise / surface.scale_m);
  const bool can_rise =
      up && surface.bounds_O.contains(up->point) && up->value >= 0.0 &&
      first_crossing(field, from, up->point, kFewRanges, {.from = {}, .to = up->value}).state ==
          SegmentState::free;
  return can_rise ? std::optional(up->point) : std::nullopt;
}

// If the lifted point cannot be reached, the middle of the segment serves: the segment is free up
// to `stop`, and halfway back it is farther from the walls.
Vec3 raised_from_crease(ImplicitField& field, const Vec3& p, const Vec3& stop, const Vec3& up) {
  constexpr double kLift = 2.0 * kImplicitRest_m;
  constexpr std::size_t kFewRanges = 16;
  const ImplicitSurface& surface = field.surface();
  const Vec3 to = stop + kLift / surface.scale_m * up;
  const bool can_lift = surface.bounds_O.contains(to) &&
                        first_crossing(field, p, to, kFewRanges).state == SegmentState::free;
  return can_lift ? to : Vec3{0.5 * (p + stop)};
}

}  // namespace tactus::rendering
