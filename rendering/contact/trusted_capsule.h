// The capsule in which the candidates are valid, and the plan of the next one.
#pragma once

#include "rendering/contact/capsule_plan.h"
#include "rendering/geometry/capsule.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Positions and lengths are in the world frame, m.
struct TrustedCapsule {
  // The proxy may be in here; empty if no candidates are valid.
  Capsule capsule;
  CapsulePlan plan;

  // Makes the capsule empty. Its start is kept: the plan takes the proxy's motion from it.
  void clear() { capsule.radius = -1.0; }
  // Returns true if no candidates are valid.
  [[nodiscard]] bool is_empty() const { return capsule.radius < 0.0; }
  // Returns true if the proxy at p need not gather. It counts as outside when it is nearer to the
  // border than a micrometre, so that no move is cut to less.
  [[nodiscard]] bool holds(const Vec3& p) const {
    constexpr double kBorder_m = 1e-6;
    return capsule.depth(p) >= kBorder_m;
  }

  // Returns the middle of the axis.
  [[nodiscard]] Vec3 middle() const { return capsule.start + 0.5 * capsule.axis; }

  // Returns the capsule of the next gathering, which starts at p (CapsulePlan::next).
  [[nodiscard]] Capsule next(const Vec3& p, bool again) {
    return plan.next(capsule.start, p, again);
  }
  // Returns a capsule of half the size about the same start.
  [[nodiscard]] Capsule half() const {
    return {.start = capsule.start, .axis = 0.5 * capsule.axis, .radius = 0.5 * capsule.radius};
  }
};

}  // namespace tactus::rendering
