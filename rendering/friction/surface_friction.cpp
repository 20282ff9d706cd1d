#include "rendering/friction/surface_friction.h"

#include <algorithm>

#include "rendering/friction/bristle_transport.h"
#include "rendering/geometry/tangential.h"

namespace tactus::rendering {
namespace {

// The grain along the contact plane; none where it stands on it.
Grain in_plane(const Grain& grain, const Vec3& normal) {
  constexpr double kUpright = 1e-6;
  const Vec3 flat = tangential(grain.direction, normal);
  const double length = flat.norm();
  if (length <= kUpright * grain.direction.norm()) {
    return {.direction = flat, .along = grain.across, .across = grain.across};
  }
  return {.direction = flat / length, .along = grain.along, .across = grain.across};
}

}  // namespace

void SurfaceFriction::turn_by(const Mat3& rotation) {
  memory_.elastic_force_N = rotation * memory_.elastic_force_N;
  normal_ = rotation * normal_;
}

void SurfaceFriction::begin_tick(const Vec3& tool_step, double tick_s) {
  is_held_ = ran_;
  ran_ = false;
  tool_step_ = tool_step;
  tick_s_ = tick_s;
}

Bristle SurfaceFriction::bristle(const Vec3& normal) const {
  if (!is_held_) {
    return {};
  }
  const Vec3& force_N = memory_.elastic_force_N;
  return {.force_N = normal == normal_ ? force_N : turned(force_N, normal_, normal),
          .stiffness_N_per_m = stiffness_N_per_m_};
}

void SurfaceFriction::set_bristle(const Bristle& bristle, const Vec3& normal) {
  if (!is_held_) {
    memory_ = {};
  }
  memory_.elastic_force_N = bristle.force_N;
  stiffness_N_per_m_ = bristle.stiffness_N_per_m;
  normal_ = normal;
  is_held_ = true;
}

FrictionLag SurfaceFriction::lag(const SlidingSurface& surface, const Vec3& normal,
                                 double normal_force_N) {
  const bool is_pressed = normal_force_N > 0.0 && surface.stiffness_N_per_m > 0.0;
  if (!is_pressed) {
    return {};
  }
  if (!ran_) {
    run(surface, normal, normal_force_N);
    ran_ = true;
  }
  if (normal != normal_) {
    turn_plane(surface, normal, depth_m_);
  }
  depth_m_ = surface.depth_m;
  Vec3 force_N = force_N_;
  if (surface.share < share_) {
    force_N *= surface.share / share_;
  }
  return {.lag_m = force_N / surface.stiffness_N_per_m, .state = state_};
}

double SurfaceFriction::twice_stored_J() const {
  return is_held_ && stiffness_N_per_m_ > 0.0
             ? memory_.elastic_force_N.squaredNorm() / stiffness_N_per_m_
             : 0.0;
}

void SurfaceFriction::turn_to(const Vec3& normal, double share) {
  memory_.elastic_force_N = share * turned(memory_.elastic_force_N, normal_, normal);
  force_N_ = share * turned(force_N_, normal_, normal);
  normal_ = normal;
}

void SurfaceFriction::turn_plane(const SlidingSurface& surface, const Vec3& normal,
                                 double before_m) {
  turn_to(normal, share_kept({.bristle_m2 = twice_stored_J() / surface.stiffness_N_per_m,
                              .before_m = before_m,
                              .now_m = surface.depth_m}));
}

void SurfaceFriction::run(const SlidingSurface& surface, const Vec3& normal,
                          double normal_force_N) {
  FrictionParameters friction = surface.friction;
  friction.stiffness_N_per_m = bristle_stiffness(surface);
  const Vec3& crease = surface.crease;
  Vec3 step = crease == Vec3::Zero() ? tangential(tool_step_, normal)
                                     : Vec3{crease.dot(tool_step_) * crease};
  if (is_held_) {
    if (normal != normal_) {
      turn_plane(surface, normal, moved_depth_m(depth_m_, normal_, crease, tool_step_));
    }
    change_stiffness(memory_, stiffness_N_per_m_, friction.stiffness_N_per_m);
  } else {
    memory_ = {};
    step = Vec3::Zero();
  }
  const bool has_grain = surface.grain.along != 1.0 || surface.grain.across != 1.0;
  const FrictionForce<Vec3> felt =
      has_grain ? update_friction(friction, in_plane(surface.grain, normal), memory_, step,
                                  normal_force_N, tick_s_)
                : update_friction(friction, memory_, step, normal_force_N, tick_s_);
  force_N_ = felt.force_N;
  state_ = felt.slipping ? FrictionState::slip : FrictionState::stick;
  normal_ = normal;
  stiffness_N_per_m_ = friction.stiffness_N_per_m;
  share_ = surface.share;
}

}  // namespace tactus::rendering
