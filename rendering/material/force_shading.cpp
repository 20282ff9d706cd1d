// The fixed-point iteration for G. A pass with the stretch G ends with the normal n and the lean
// that the detail asks for there; the error is d (n + lean) - G. Its part along n is corrected at
// once. Of its part across, the residual, the relaxation's share is taken.
#include "rendering/material/force_shading.h"

#include <algorithm>

#include "rendering/geometry/tangential.h"

namespace tactus::rendering {
namespace {

// The offset is settled when it changes by less than this: a tenth of a millinewton at 1000 N/m.
constexpr double kShiftSettled_m = 1e-7;
// The depth of a lifted goal in tool radii, s. On an edge a pass leaves s / (1 - s) of the error.
constexpr double kDepthOfRadius = 0.25;
// The least depth of a lifted goal. An edge has no rounding for a point, and any depth is too deep
// there; this one is much deeper than rounding errors.
constexpr double kLeastDepth_m = 20e-6;

}  // namespace

void ForceShading::set_tool_radius(double tool_radius_m) {
  tool_radius_m_ = tool_radius_m;
  reset();
}

void ForceShading::reset() {
  const double tool_radius_m = tool_radius_m_;
  Relaxation relaxation = relaxation_;
  relaxation.restart();
  *this = {};
  tool_radius_m_ = tool_radius_m;
  relaxation_ = relaxation;
}

void ForceShading::begin(const Start& start, Passes passes) {
  relaxation_.begin_tick(start.moved_m, passes == Passes::one);
  if (is_at_rest()) {
    return;
  }
  const double depth = (start.proxy_W - start.tool_W).dot(normal_);
  const bool deep = depth > 0.0 && depth_m_ > 0.0;
  if (!deep) {
    reset();
    return;
  }
  // The stretch keeps its direction from tick to tick and follows the depth.
  stretch_ *= depth / depth_m_;
  set_offset(depth);
}

void ForceShading::set_offset(double depth_m) {
  const double most = std::max(kDepthOfRadius * tool_radius_m_, kLeastDepth_m);
  // The rest of the depth that the goal keeps below the plane.
  const double left = interpolated_ ? std::min(depth_m, most) : depth_m;
  depth_m_ = depth_m;
  lifted_from_m_ = left < depth_m ? depth_m : 0.0;
  offset_ = stretch_ - left * normal_;
}

bool ForceShading::lower() {
  const bool lifted = lifted_from_m_ > 0.0;
  lifted_from_m_ = 0.0;
  offset_ = stretch_ - depth_m_ * normal_;
  return lifted;
}

bool ForceShading::improve(const ShadedRest& rest) {
  if (!(rest.depth_m > 0.0)) {
    reset();
    return false;
  }
  // The proxy went straight to the tool, so the stretch of this pass was along n.
  if (!is_on()) {
    stretch_ = rest.depth_m * rest.normal_W;
  }
  const Vec3 error = rest.depth_m * (rest.normal_W + rest.lean) - stretch_;
  const Vec3 residual = tangential(error, rest.normal_W);
  stretch_ += error + (relaxation_.share_of(residual) - 1.0) * residual;
  normal_ = rest.normal_W;
  interpolated_ = rest.interpolated;
  const Vec3 before = offset_;
  set_offset(rest.depth_m);
  return (offset_ - before).squaredNorm() > kShiftSettled_m * kShiftSettled_m;
}

Vec3 lean_of(const Vec3& shading_normal, const Vec3& normal) {
  constexpr double kMostLean = 1.7320508075688772;  // tan 60 degrees
  // m / (m . n) - n = (m - (m . n) n) / (m . n): the part of m across n, over the part along it.
  const double facing = shading_normal.dot(normal);
  const Vec3 across = tangential(shading_normal, normal);
  const double length = across.norm();
  if (length <= kMostLean * facing) {
    return across / facing;
  }
  return length > 0.0 ? Vec3{kMostLean / length * across} : Vec3{Vec3::Zero()};
}

}  // namespace tactus::rendering
