#include "rendering/world/tool_touch.h"

#include <algorithm>

#include "rendering/contact/tick_watcher.h"
#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Returns true if the tool is a number and within the world.
bool valid(const ToolState& tool) {
  // Comparisons with a value that is not a number are false.
  return tool.p_W.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m &&
         tool.v_W.allFinite();
}

}  // namespace

void ToolTouch::start(const SceneObjects& scene, double tool_radius_m, const NeedleScene& needle) {
  radius_m_ = tool_radius_m;
  needle_.start(scene, needle);
  proxy_.set_tool_radius(tool_radius_m);
  place(scene, last_proxy_W_);  // nothing of another scene is remembered
  reset();
}

void ToolTouch::place(const SceneObjects& scene, const Vec3& p_W) {
  proxy_.place(p_W);
  independent_.place(scene, p_W, radius_m_);
  last_proxy_W_ = p_W;
  placed_ = true;
}

template <class Watch>
Touch ToolTouch::touch(const SceneObjects& scene, const ToolState& tool, std::size_t limit,
                       Watch watch) {
  // The shared proxy comes first; half of the budget is kept for the other contacts, if there are
  // any.
  const bool has_others = placed_ && independent_.any_near(scene, tool.p_W);
  proxy_.start_tick_budget(has_others ? limit / 2 : limit);
  // The objects move also in a tick without a valid tool, so the proxy is carried first.
  const std::uint32_t moved = placed_ ? proxy_.begin_tick(scene) : kTouchClean;
  spent_ = proxy_.spent();
  if (!valid(tool)) {
    independent_.hold(scene);
    proxy_.let_go();
    return {.proxy_W = last_proxy_W_, .flags = moved | kTouchToolInvalid};
  }
  if (!placed_) {
    place(scene, tool.p_W);
  }
  Touch touch{.proxy_W = tool.p_W};
  if (scene.any_meets_proxy()) {
    touch = proxy_.touch(scene, tool, watch);
    if (touch.contact != ContactKind::none && scene[touch.object].deforms) {
      add_driven_power(touch, scene.tick_s());
    }
  }
  touch.flags |= moved;
  independent_.add_to(touch, scene, tool, limit - std::min(limit, proxy_.spent()), watch);
  spent_ = proxy_.spent() + independent_.spent();
  if (needle_.any()) {
    add_needle(touch, scene, tool);
  }
  last_proxy_W_ = touch.proxy_W;
  return touch;
}

// The needle is what is touched where the shared proxy and the independent contacts touch nothing.
// The god-object of a needle is at the surface that its tip presses in.
void ToolTouch::add_needle(Touch& touch, const SceneObjects& scene, const ToolState& tool) {
  const NeedleForce needle = needle_.advance(scene, tool);
  spent_ += kCostOfNeedleLayer * needle_.layers().size();
  touch.flags |= needle.has_left_out ? kTouchOverlap : kTouchClean;
  touch.force_W += needle.force_W;
  touch.parts.friction_W += needle.friction_W;
  touch.parts.driven_power += needle.driven_power;
  if (needle.object == kNoObject || touch.contact != ContactKind::none) {
    return;
  }
  touch.contact = ContactKind::face;
  touch.object = needle.object;
  touch.friction = needle.friction;
  touch.normal_W = -needle_.axis_W();
  touch.depth_m = needle.depth_m;
  touch.planes = 1;
  touch.proxy_W = tool.p_W - needle.depth_m * needle_.axis_W();
}

void ToolTouch::take_method(const SceneObjects& scene, std::uint32_t object, bool met_proxy) {
  if (!placed_) {
    return;  // the first touch places all proxies
  }
  const bool meets = meets_proxy(scene[object]);
  if (met_proxy || meets) {
    const Vec3 p_W = proxy_.position_W();
    proxy_.place(p_W);
  }
  if (!met_proxy && meets) {
    independent_.remove(scene, object);
  } else if (met_proxy && !meets) {
    independent_.insert(scene, object);
  } else if (!meets) {
    independent_.restart(scene, object);
  }
}

// Adds the power of surfaces that deform: the proxy slides along the surface and follows its motion
// along the normal.
void ToolTouch::add_driven_power(Touch& touch, double tick_s) const {
  const double out_m = (touch.proxy_W - last_proxy_W_).dot(touch.normal_W);
  touch.parts.driven_power += touch.force_W.dot(touch.normal_W) * out_m / tick_s;
}

template Touch ToolTouch::touch(const SceneObjects&, const ToolState&, std::size_t, Unwatched);
template Touch ToolTouch::touch(const SceneObjects&, const ToolState&, std::size_t, Watched);

}  // namespace tactus::rendering
