// The straight ways of the proxy past an implicit surface, and how it comes to its height where one
// of them ends. In the object frame.
#pragma once

#include <optional>

#include "rendering/contact/first_crossing.h"

namespace tactus::rendering {

// The part of a straight way within a box, in shares of the way; none of it if enter > leave.
struct Inside {
  double enter = 0.0;
  double leave = 1.0;
};
Inside clip(const Box& box, const Vec3& from, const Vec3& segment);

// A way and what is first met on it.
struct SweptSegment {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  Crossing crossing;

  [[nodiscard]] Vec3 at(double share) const {
    return share == 1.0 ? to : Vec3{from + share * (to - from)};
  }
};

// Toward `to`, as far as the surface's bounds go. F(from) is >= 0.
SweptSegment look_along(ImplicitField& field, const Vec3& from, const Vec3& to);

// As far up from a free point as the proxy rests, if the way there is free.
std::optional<Vec3> risen(ImplicitField& field, const Vec3& from);

// The same in the bottom of a crease, where no double tells free from solid, at the end of a way
// from p: `up` from there, a unit vector, where the straight way from p is free; else half way to
// the stop.
Vec3 lifted(ImplicitField& field, const Vec3& p, const Vec3& stop, const Vec3& up);

}  // namespace tactus::rendering
