#include "rendering/contact/textbook/plain_tracking.h"

#include "rendering/contact/tick_watcher.h"
#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Returns the side of the surface on which p is: the sign of f, 1 for 0. An object with an inside
// ends at its box: outside the box the side is 1.
double side_at(const ImplicitSurface& surface, const Vec3& p_O) {
  const bool counts = surface.sides == Sides::two || surface.bounds_O.contains(p_O);
  return counts && evaluate(surface.formula, p_O) < 0.0 ? -1.0 : 1.0;
}

}  // namespace

Seed seed(const FormulaView& formula, const Vec3& start) {
  constexpr int kMostSeedSteps = 50;
  constexpr double kSmallestSeedStep = 1e-13;
  Seed result{.point = start};
  for (; result.steps < kMostSeedSteps; ++result.steps) {
    const ValueAndGradient f = evaluate_gradient(formula, result.point);
    const Vec3 move = f.value / f.gradient.squaredNorm() * f.gradient;
    if (!move.allFinite()) {
      return result;
    }
    result.point -= move;
    if (move.norm() < kSmallestSeedStep) {
      result.converged = true;
      return result;
    }
  }
  return result;
}

Seed plain_tracking_step(const FormulaView& formula, const Vec3& contact, const Vec3& tool) {
  const Vec3 gradient = evaluate_gradient(formula, contact).gradient;
  const double squared = gradient.squaredNorm();
  if (!(squared > 0.0)) {
    return {.point = contact};
  }
  return seed(formula, tool - gradient.dot(tool - contact) / squared * gradient);
}

void PlainTracker::place(const Vec3& p_W) {
  p_W_ = p_W;
  side_ = 0.0;
  in_contact_ = false;
}

// The tool in front of the tangent plane ends the contact, whatever is there.
Seed PlainTracker::track(const ImplicitSurface& surface, const Vec3& contact, const Vec3& tool) {
  const Vec3 outward = side_ * evaluate_gradient(surface.formula, contact).gradient;
  in_contact_ = !(outward.dot(tool - contact) > 0.0) && surface.bounds_O.contains(tool);
  return in_contact_ ? plain_tracking_step(surface.formula, contact, tool) : Seed{.point = tool};
}

Seed PlainTracker::look_for_contact(const ImplicitSurface& surface, const Vec3& before,
                                    const Vec3& tool, std::uint32_t& flags) {
  Seed found{.point = tool};
  if (surface.sides == Sides::two && !surface.bounds_O.contains(tool)) {
    // There is no surface: the tool may come back on either side.
    side_ = 0.0;
    return found;
  }
  if (side_ == 0.0) {
    side_ = side_at(surface, before);
  }
  const double here = side_at(surface, tool);
  if (surface.sides == Sides::one && side_ < 0.0) {
    // A tool that began inside feels nothing until it has been outside.
    side_ = here;
    flags |= here < 0.0 ? kTouchOverlap : kTouchClean;
  } else if (here != side_) {
    found = seed(surface.formula, tool);
    in_contact_ = found.converged;
  }
  return found;
}

template <class Watch>
PlainRest PlainTracker::advance(const ImplicitSurface& surface, const Vec3& tool_W, Watch watch) {
  if (!tool_W.allFinite() || tool_W.cwiseAbs().maxCoeff() > kWorldBound_m) {
    return {.proxy_W = p_W_, .flags = kTouchToolInvalid};
  }
  const Vec3 tool = surface.to_object(tool_W);
  const Vec3 before = surface.to_object(p_W_);
  PlainRest rest{.proxy_W = tool_W};
  const Seed found = in_contact_ ? track(surface, before, tool)
                                 : look_for_contact(surface, before, tool, rest.flags);
  rest.steps = found.steps;
  rest.in_contact = in_contact_;
  if (in_contact_) {
    const Vec3 outward = side_ * evaluate_gradient(surface.formula, found.point).gradient;
    rest.proxy_W = surface.to_world(found.point);
    rest.normal_W = surface.R_WO * outward.stableNormalized();
    rest.depth_m = (rest.proxy_W - tool_W).dot(rest.normal_W);
    rest.flags = found.converged ? kTouchClean : kTouchIterationsExhausted;
  }
  watch.see(WatchedFormulaStep{.surface = surface,
                               .side = side_,
                               .from_O = before,
                               .goal_O = tool,
                               .to_O = found.point,
                               .planes = static_cast<std::uint8_t>(in_contact_ ? 1 : 0),
                               .friction = FrictionState::free,
                               .flags = rest.flags});
  p_W_ = rest.proxy_W;
  return rest;
}

template PlainRest PlainTracker::advance(const ImplicitSurface&, const Vec3&, Unwatched);
template PlainRest PlainTracker::advance(const ImplicitSurface&, const Vec3&, ObjectWatched);

}  // namespace tactus::rendering
