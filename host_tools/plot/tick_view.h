// The two views in which ticks are drawn (tick_figure.h).
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "host_tools/plot/silhouette.h"
#include "host_tools/plot/tick_steps.h"

namespace tactus::host {

// A view of one or more ticks: across the surface, with the contact normal up and the tool's pull
// along the surface to the right; or from above, along the contact normal. The origin is the point
// of the surface under the proxy, or the tool in a tick without contact. Several ticks share the
// view: it has the middle of their normals up, the path of their proxy to the right, and the first
// contact's point as its origin.
class TickView {
 public:
  // There must be at least one tick.
  TickView(std::span<const TickSteps> ticks, bool from_above);

  // Returns a point in the picture, mm.
  [[nodiscard]] PlanePoint point(const Vec3& p_W) const {
    const Vec3 from = p_W - origin_W_;
    return {.right = 1e3 * from.dot(right_W_), .up = 1e3 * from.dot(up_W_)};
  }
  // Returns the two components of a vector that can be seen, in its own unit.
  [[nodiscard]] PlanePoint direction(const Vec3& d_W) const {
    return {.right = d_W.dot(right_W_), .up = d_W.dot(up_W_)};
  }
  // Returns how far a point is in front of the picture's plane, m.
  [[nodiscard]] double toward(const Vec3& p_W) const { return (p_W - origin_W_).dot(toward_W_); }
  // Returns the world's point in the picture's plane, the reverse of point().
  [[nodiscard]] Vec3 world(const PlanePoint& p_mm) const {
    return origin_W_ + 1e-3 * (p_mm.right * right_W_ + p_mm.up * up_W_);
  }
  // Returns a square window that holds what the ticks did, mm.
  [[nodiscard]] Window window(std::span<const TickSteps> ticks) const;

 private:
  Vec3 origin_W_ = Vec3::Zero();
  Vec3 right_W_ = Vec3::UnitX();
  Vec3 up_W_ = Vec3::UnitY();
  Vec3 toward_W_ = Vec3::UnitZ();
};

// Returns the radius of the tool, m; 0 without contact.
double tool_radius_m(const TickSteps& tick);

// Returns the radii of the tick's last friction circles, the static and the dynamic one, m; nothing
// without friction.
std::optional<std::pair<double, double>> circles_of(const TickSteps& tick);

// Returns the point that the proxy would take without friction: the tool, raised by the depth.
Vec3 without_friction_W(const TickSteps& tick);

}  // namespace tactus::host
