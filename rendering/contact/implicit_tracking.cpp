#include "rendering/contact/implicit_tracking.h"

#include "rendering/contact/implicit_tick.h"
#include "rendering/contact/tick_watcher.h"

namespace tactus::rendering {

void ImplicitTracker::place(const Vec3& p_W) {
  p_W_ = p_W;
  placed_ = false;
  state_ = {};
}

template <class Watch>
ImplicitRest ImplicitTracker::advance(const ImplicitSurface& surface, const Material& material,
                                      const Vec3& h_W, std::size_t budget, Watch watch) {
  ImplicitRest rest;
  if (!(h_W.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m)) {
    rest.proxy_W = p_W_;
    rest.flags = kTouchToolInvalid;
    return rest;
  }
  if (!placed_) {
    state_.p_O = surface.to_object(p_W_);
    placed_ = true;
  }
  rest = run_implicit_tick(state_, surface, material, surface.to_object(h_W), budget, watch);
  p_W_ = surface.to_world(state_.p_O);
  rest.proxy_W = p_W_;
  rest.friction = state_.friction;
  rest.depth_m = rest.planes > 0 ? (p_W_ - h_W).dot(rest.normal_W) : 0.0;
  return rest;
}

template ImplicitRest ImplicitTracker::advance(const ImplicitSurface&, const Material&, const Vec3&,
                                               std::size_t, Unwatched);
template ImplicitRest ImplicitTracker::advance(const ImplicitSurface&, const Material&, const Vec3&,
                                               std::size_t, ObjectWatched);

}  // namespace tactus::rendering
