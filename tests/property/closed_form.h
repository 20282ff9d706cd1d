// The closed form of the place where a tool rests on a primitive: the oracle of
// same_shape_test.cpp. It shares no code with the primitives under test.
#pragma once

#include <cstdint>

#include "rendering/surface/primitive.h"

namespace tactus::testing {

// The side of the surface on which the proxy is.
enum class Side : std::uint8_t { outside, within };

// A primitive that is touched from one side by a sphere. World frame, m.
struct TouchedShape {
  rendering::Primitive primitive;
  double tool_radius_m = 0.0;
  Side side = Side::outside;
};

// The distance of the tool's centre from the surface that it cannot pass, and the direction away
// from there.
struct Clearance {
  // Above 0 where the tool is free, m.
  double distance_m = 0.0;
  // The unit gradient of the distance.
  Vec3 away_W = Vec3::Zero();
};

// Returns the clearance of a tool at p_W. `above_m` is added to the tool's radius.
Clearance clearance(const TouchedShape& shape, const Vec3& p_W, double above_m = 0.0);

// Returns where a tool at p_W rests without friction, `above_m` above the surface.
Vec3 resting_place(const TouchedShape& shape, const Vec3& p_W, double above_m);

// Returns how deep below the place that is nearest to p_W a tool has no other place as near, at
// most `most_m`. There it is on the medial axis, and the nearest place jumps.
double reach(const TouchedShape& shape, const Vec3& p_W, double most_m);

// A point that slides by Coulomb's law, in steps of micrometres: the friction is mu times the
// pressure and opposite to the sliding.
class SlidingPoint {
 public:
  SlidingPoint(const TouchedShape& shape, double mu, double above_m)
      : shape_(shape), mu_(mu), above_m_(above_m) {}

  // Moves the tool straight on to p_W, and returns where the point is then. The surface must be
  // smooth where it slides.
  Vec3 follow(const Vec3& p_W);

 private:
  // Slides until friction holds the point against a tool at p_W.
  void slide(const Vec3& p_W);

  const TouchedShape& shape_;
  double mu_;
  double above_m_;
  Vec3 tool_W_ = Vec3::Zero();
  Vec3 point_W_ = Vec3::Zero();
  bool is_placed_ = false;
  bool is_free_ = true;
};

}  // namespace tactus::testing
