// Straight segments of the proxy past an implicit surface, and its return to the rest height at the
// end of one. Everything is in the object frame.
#pragma once

#include <optional>

#include "rendering/contact/first_crossing.h"

namespace tactus::rendering {

// The part of a segment within a box, as shares of its length; empty if enter > leave.
struct Inside {
  // The share at which the segment enters the box, 0 if it begins inside.
  double enter = 0.0;
  // The share at which it leaves the box, 1 if it ends inside.
  double leave = 1.0;
};
// Returns the part of the segment from `from` to from + segment that is within the box.
Inside clip(const Box& box, const Vec3& from, const Vec3& segment);

// A segment and its first crossing of the surface.
struct SweptSegment {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  Crossing crossing;

  // Returns the point at a share of the length; exactly `to` at 1, without rounding.
  [[nodiscard]] Vec3 at(double share) const {
    return share == 1.0 ? to : Vec3{from + share * (to - from)};
  }
};

// Sweeps from `from` toward `to`, within the bounds of the surface. F(from) must be >= 0;
// `value_from` is F(from) where the caller has evaluated it.
SweptSegment sweep_segment(ImplicitField& field, const Vec3& from, const Vec3& to,
                           std::optional<double> value_from = {});

// Returns a free point moved up to the rest height along the gradient. Returns nothing if that is
// farther than 0.4 um, outside the bounds, or if the segment there is not free.
std::optional<Vec3> raised_to_rest(ImplicitField& field, const Vec3& from);

// Moves the end of a segment in the bottom of a crease to the rest height, where no double tells
// free from solid. `p` is the start of the segment, `stop` its end and `up` a unit vector. Returns
// the raised point if the segment from p to it is free, else the middle between p and `stop`.
Vec3 raised_from_crease(ImplicitField& field, const Vec3& p, const Vec3& stop, const Vec3& up);

}  // namespace tactus::rendering
