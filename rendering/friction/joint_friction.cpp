#include "rendering/friction/joint_friction.h"

#include <algorithm>
#include <cmath>

#include "rendering/friction/friction_model.h"

namespace tactus::rendering {
namespace {

// Sets every surface's share of the bristle: the share of what it can hold.
void set_shares(std::span<JointSurface> surfaces) {
  const auto held_N = [](const JointSurface& surface) {
    return holding_level(surface.sliding.friction) * surface.normal_force_N;
  };
  double sum_N = 0.0;
  for (const JointSurface& surface : surfaces) {
    sum_N += held_N(surface);
  }
  for (JointSurface& surface : surfaces) {
    surface.sliding.share = sum_N > 0.0 ? held_N(surface) / sum_N : 1.0;
  }
}

// The bristles of a contact together.
struct JointBristle {
  Vec3 force_N = Vec3::Zero();
  double stiffness_N_per_m = 0.0;
  double twice_energy_J = 0.0;

  void add(const Bristle& bristle) {
    if (bristle.stiffness_N_per_m > 0.0) {
      force_N += bristle.force_N;
      stiffness_N_per_m += bristle.stiffness_N_per_m;
      twice_energy_J += bristle.force_N.squaredNorm() / bristle.stiffness_N_per_m;
    }
  }
};

// Returns the factor by which the bristles `after` a change are scaled.
double scale_of(const JointBristle& before, const JointBristle& after) {
  if (!(after.twice_energy_J > 0.0)) {
    return 1.0;
  }
  const double by_energy = std::sqrt(before.twice_energy_J / after.twice_energy_J);
  const double force_N = after.force_N.norm();
  return force_N > 0.0 ? std::min(by_energy, before.force_N.norm() / force_N) : by_energy;
}

}  // namespace

void JointFriction::turn_by(const Mat3& rotation) {
  if (is_in_use_) {
    normal_ = rotation * normal_;
    for (SurfaceFriction& model : models_) {
      model.turn_by(rotation);
    }
  }
}

void JointFriction::begin_tick(const Vec3& tool_step, double tick_s) {
  tool_step_ = tool_step;
  tick_s_ = tick_s;
  if (!is_in_use_) {
    return;
  }
  is_in_use_ = has_run();
  begin_models();
}

void JointFriction::begin_models() {
  for (SurfaceFriction& model : models_) {
    model.begin_tick(tool_step_, tick_s_);
  }
}

void JointFriction::turn_models(const SlidingSurface& sliding, const Vec3& normal) {
  double twice_energy_J = 0.0;
  for (const SurfaceFriction& model : models_) {
    twice_energy_J += model.twice_stored_J();
  }
  const double before_m =
      has_run() ? depth_m_ : moved_depth_m(depth_m_, normal_, sliding.crease, tool_step_);
  const double share = share_kept({.bristle_m2 = twice_energy_J / sliding.stiffness_N_per_m,
                                   .before_m = before_m,
                                   .now_m = sliding.depth_m});
  for (SurfaceFriction& model : models_) {
    if (model.recency() > 0) {
      model.turn_to(normal, share);
    }
  }
}

FrictionLag JointFriction::lag(std::span<JointSurface> surfaces, const Vec3& normal) {
  set_shares(surfaces);
  if (!is_in_use_) {
    is_in_use_ = true;
    begin_models();
  }
  const bool is_first = !has_run();
  if (normal != normal_) {
    turn_models(surfaces.front().sliding, normal);
    normal_ = normal;
  }
  depth_m_ = surfaces.front().sliding.depth_m;
  give_models(surfaces, is_first);
  if (is_first && surfaces.size() > 1) {
    share_bristles(surfaces, normal);
  }
  FrictionLag joint;
  for (const JointSurface& surface : surfaces) {
    const std::size_t place = place_of(surface.number);
    if (place == kMost) {
      continue;
    }
    const FrictionLag lag = models_[place].lag(surface.sliding, normal, surface.normal_force_N);
    joint.lag_m += lag.lag_m;
    joint.state = lag.state == FrictionState::slip ? lag.state : joint.state;
  }
  return joint;
}

bool JointFriction::has_run() const {
  return std::ranges::any_of(models_, &SurfaceFriction::has_run);
}

// Returns the place of the surface's model; kMost if it has none yet.
std::size_t JointFriction::place_of(std::uint32_t surface) const {
  return static_cast<std::size_t>(std::ranges::find(surfaces_, surface) - surfaces_.begin());
}

// Gives each of the surfaces a model. A new one takes that of a surface that is not among them: the
// one that has run in this tick, or else in the last. If not `to_all`, it takes no other.
void JointFriction::give_models(std::span<const JointSurface> surfaces, bool to_all) {
  const auto recency = [&](std::size_t i) {
    const bool holds =
        std::ranges::find(surfaces, surfaces_[i], &JointSurface::number) != surfaces.end();
    return holds ? -1 : models_[i].recency();
  };
  for (const JointSurface& surface : surfaces) {
    if (place_of(surface.number) < kMost) {
      continue;
    }
    std::size_t latest = 0;
    for (std::size_t i = 1; i < kMost; ++i) {
      latest = recency(i) > recency(latest) ? i : latest;
    }
    if (to_all || models_[latest].has_run()) {
      surfaces_[latest] = surface.number;
    }
  }
}

void JointFriction::share_bristles(std::span<const JointSurface> surfaces, const Vec3& normal) {
  std::array<Bristle, kMost> bristles;
  JointBristle before;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    bristles[i] = models_[place_of(surfaces[i].number)].bristle(normal);
    before.add(bristles[i]);
  }
  if (!(before.twice_energy_J > 0.0)) {
    return;
  }
  const Vec3 mean_m = before.force_N / before.stiffness_N_per_m;
  JointBristle after;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Bristle& old = bristles[i];
    const double stiffness = bristle_stiffness(surfaces[i].sliding);
    const Vec3 deflection_m =
        old.stiffness_N_per_m > 0.0 ? Vec3{old.force_N / old.stiffness_N_per_m} : mean_m;
    bristles[i] = {.force_N = stiffness * deflection_m, .stiffness_N_per_m = stiffness};
    after.add(bristles[i]);
  }
  const double scale = scale_of(before, after);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    bristles[i].force_N *= scale;
    models_[place_of(surfaces[i].number)].set_bristle(bristles[i], normal);
  }
}

}  // namespace tactus::rendering
