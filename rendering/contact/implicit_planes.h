// The planes that hold a proxy on an implicit surface at one position. ImplicitTick
// (implicit_tick.cpp) collects them. Everything is in the object frame, in the formula's own unit
// of length.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/contact/implicit_sample.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Returns the tangent plane of the surface under a proxy in contact, at the rest height.
Plane tangent_plane(const ImplicitSurface& surface, const ImplicitSample& here);

// Returns the plane of the surface that blocks a segment at `blocked_O`: its tangent plane there,
// at the rest height. At a singular point, which has no normal, the direction of `from_tool`, the
// vector from the tool to the proxy, serves.
Plane blocking_plane(ImplicitField& field, const Vec3& blocked_O, const Vec3& from_tool);

// The joint push of the planes that keep a point from the tool.
struct ImplicitPush {
  // The point nearest to the tool on the positive side of all planes; object frame.
  PlaneProjection projection;
  // The sum of pressure times plane normal, made unit; world frame. Zero without contact.
  Vec3 normal_W = Vec3::Zero();
  // The sum of the pressures, m.
  double depth_m = 0.0;
  // The direction of the crease if two planes push, unit; zero otherwise; world frame.
  Vec3 crease_W = Vec3::Zero();
};

// At most kMostPlanes planes.
class ImplicitPlanes {
 public:
  // Removes all planes.
  void clear() { count_ = holding_count_ = 0; }

  // Returns the number of planes.
  [[nodiscard]] std::size_t size() const { return count_; }

  // Adds a plane. Beyond kMostPlanes it replaces one that did not push at the last
  // call of push(). Returns false if an equal plane is there that bounds the proxy as far.
  bool add(const Plane& plane);

  // Returns the push of the planes against the tool `h`.
  ImplicitPush push(const Vec3& h, const ImplicitSurface& surface);

  // Returns the point nearest to `h` on the positive side of all planes.
  [[nodiscard]] PlaneProjection project(const Vec3& h) const {
    return project_on_planes(h, std::span(planes_).first(count_));
  }

 private:
  // Three planes can hold a point, and one more is on trial.
  static constexpr std::size_t kMostPlanes = 4;

  // Returns the index of a plane that did not push.
  [[nodiscard]] std::size_t idle() const;

  std::array<Plane, kMostPlanes> planes_;
  std::size_t count_ = 0;
  // The indices of the planes that pushed last, the first `holding_count_`.
  std::array<std::uint8_t, 3> holding_{};
  std::size_t holding_count_ = 0;
};

}  // namespace tactus::rendering
