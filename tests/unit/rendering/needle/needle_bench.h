// A needle in a block of layers, moved along given paths, with the work that the hand does.
#pragma once

#include <memory>
#include <vector>

#include "rendering/needle/needle_touch.h"
#include "rendering/objects/scene_objects.h"

namespace tactus::rendering {

// The tissue of tests/reference/needle_reference_trace.csv, in SI units. Its toughness is not
// given: it is taken as 0. The springs are stiffer than a device allows, since the trace has none.
inline Tissue reference_tissue() {
  return {.stiffness_N_per_m = 20.0,
          .stiffness_N_per_m2 = 8000.0,
          .puncture_force_N = 1.392,
          .residual_m = 0.004,
          .cutting_force_N = 0.94,
          .toughness_J_per_m2 = 0.0,
          .in = {.static_N_per_m = 18.45, .dynamic_N_per_m = 10.37, .viscous_Ns_per_m2 = 212.13},
          .out = {.static_N_per_m = 18.23, .dynamic_N_per_m = 10.57, .viscous_Ns_per_m2 = 293.08},
          .shaft_stiffness_N_per_m2 = 5e6,
          .relaxation_s = 1e-4};
}

// A tissue like muscle, of this project's own making, whose puncture frees nothing.
inline Tissue balanced_tissue(double scale = 1.0) {
  Tissue tissue{.stiffness_N_per_m = 100.0 * scale,
                .stiffness_N_per_m2 = 20000.0 * scale,
                .puncture_force_N = 1.5 * scale,
                .cutting_force_N = 0.7 * scale,
                .toughness_J_per_m2 = 500.0 * scale,
                .in = {.static_N_per_m = 15.0, .dynamic_N_per_m = 10.0, .viscous_Ns_per_m2 = 50.0},
                .out = {.static_N_per_m = 18.0, .dynamic_N_per_m = 12.0, .viscous_Ns_per_m2 = 60.0},
                .lateral_stiffness_N_per_m2 = 2e4};
  tissue.residual_m = balanced_residual_m(tissue);
  return tissue;
}

inline Object tissue_block(double top_m, std::size_t tissue, double bottom_m = -0.2) {
  Object object;
  object.surface = SurfaceKind::primitive;
  object.primitive = {.kind = PrimitiveKind::box,
                      .X_WO = {Mat3::Identity(), Vec3(0.0, 0.5 * (top_m + bottom_m), 0.0)},
                      .dimensions_m = {0.1, 0.5 * (top_m - bottom_m), 0.1}};
  object.tissue = static_cast<std::uint8_t>(tissue);
  return object;
}

// The needle points along -y.
class NeedleBench {
 public:
  NeedleBench(std::vector<Object> objects, std::vector<Tissue> tissues, Needle needle,
              double tick_s = 1e-3)
      : objects_(std::move(objects)), tissues_(std::move(tissues)), tick_s_(tick_s) {
    is_good_ = valid({needle, tissues_}, objects_) && scene_->set(objects_);
    scene_->begin_tick(0.0, tick_s);
    touch_.start(*scene_, {needle, tissues_});
  }

  [[nodiscard]] bool is_good() const { return is_good_; }

  // Moves the tip by one tick, and adds the work of the hand by the trapezoidal rule.
  const NeedleForce& to(const Vec3& p_W) {
    const Vec3 before_W = force_.force_W;
    const Vec3 step_W = has_begun_ ? Vec3{p_W - p_W_} : Vec3{Vec3::Zero()};
    scene_->begin_tick(0.0, tick_s_);
    force_ = touch_.advance(*scene_, {.p_W = p_W, .v_W = step_W / tick_s_});
    work_J_ -= 0.5 * (before_W + force_.force_W).dot(step_W);
    p_W_ = p_W;
    has_begun_ = true;
    return force_;
  }
  const NeedleForce& to_depth(double depth_m) { return to({0.0, -depth_m, 0.0}); }
  // Moves straight at a speed; the last step ends at the depth.
  const NeedleForce& go_to_depth(double depth_m, double v_m_per_s) {
    const double from_m = has_begun_ ? -p_W_.y() : depth_m;
    const long steps = std::lround(std::abs(depth_m - from_m) / (v_m_per_s * tick_s_));
    for (long i = 1; i <= steps; ++i) {
      to_depth(from_m + (depth_m - from_m) * static_cast<double>(i) / static_cast<double>(steps));
    }
    return force_;
  }
  // Takes a place as that of the last tick; the next step begins there.
  void stand_at(const Vec3& p_W) { p_W_ = p_W; }
  void hold(double time_s) {
    const long ticks = std::lround(time_s / tick_s_);
    for (long i = 0; i < ticks; ++i) {
      to(p_W_);
    }
  }

  // The force against the motion inward, N.
  [[nodiscard]] double axial_N() const { return force_.force_W.y(); }
  [[nodiscard]] double work_J() const { return work_J_; }
  // All energy that the account knows of.
  [[nodiscard]] double accounted_J() const {
    const NeedleEnergy& energy = touch_.energy();
    return energy.fracture_J + energy.friction_J + energy.freed_J + touch_.stored_J();
  }
  [[nodiscard]] const NeedleTouch& touch() const { return touch_; }
  [[nodiscard]] NeedleTouch& touch() { return touch_; }
  [[nodiscard]] SceneObjects& scene() { return *scene_; }

 private:
  std::vector<Object> objects_;
  std::vector<Tissue> tissues_;
  std::unique_ptr<SceneObjects> scene_ = std::make_unique<SceneObjects>();
  NeedleTouch touch_;
  NeedleForce force_;
  Vec3 p_W_ = Vec3::Zero();
  double tick_s_;
  double work_J_ = 0.0;
  bool has_begun_ = false;
  bool is_good_ = false;
};

}  // namespace tactus::rendering
