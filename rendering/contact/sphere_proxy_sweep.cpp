// How far the sphere may go on its way to the sub-goal, and what stops it.
//
// A distance is convex along the way, so what is out of reach at its end, by the tangent at its
// start, is out of reach all along. Of the others most lie behind the planes that hold the sphere:
// on a convex surface, all. Those that are near where it starts are swept first: where the proxy
// presses on something hollow they stop it soon, and few of the rest are within reach of there.
#include <algorithm>
#include <optional>
#include <span>

#include "rendering/contact/object_cast.h"
#include "rendering/contact/primitive_sweep.h"
#include "rendering/contact/sphere_proxy.h"

namespace tactus::rendering {
namespace {

// A triangle in contact that stops the sphere within this travel holds it already.
constexpr double kHeld_m = 1e-6;
// Among more candidates than this a cast would look at too many triangles to pay.
constexpr std::size_t kMostToCast = 24;
// And more work than this, in units of kMaxWork, would not.
constexpr std::size_t kMostCastWork = 240;

}  // namespace

// Shrinks to the first candidate that stops the sphere.
class SphereProxy::CandidateSweep {
 public:
  CandidateSweep(SphereProxy& proxy, const Scenery& scenery, const Way& way, const ProxyRest& rest)
      : of_(proxy.neighbourhood_),
        shells_(proxy.shells_),
        scenery_(scenery),
        sweep_(way.sweep),
        planes_(way.sweep.from, way.end),
        free_(way.length),
        end_(way.end) {
    for (std::size_t i = 0; i < rest.plane_count; ++i) {
      planes_.add(rest.planes[i].plane.normal);
    }
  }

  // False if the tick's work is done before the end is known.
  bool sweep_all() {
    std::span<const std::uint16_t> here;
    if (!shells_.is_point()) {  // which is near too few
      here = of_.within_reach_here();
    }
    return sweep_each(here, {}) && sweep_each(of_.within_reach(end_), here);
  }

  [[nodiscard]] double free() const { return free_; }
  [[nodiscard]] std::size_t stopped_by() const { return stopped_by_; }

 private:
  // But for those that were swept before; both ascend. False if that is too much for the tick.
  bool sweep_each(std::span<const std::uint16_t> numbers, std::span<const std::uint16_t> before) {
    auto swept = before.begin();
    for (const std::uint16_t i : numbers) {
      while (swept != before.end() && *swept < i) {
        ++swept;
      }
      const bool is_swept = swept != before.end() && *swept == i;
      if (!is_swept && !sweep(i)) {
        return false;
      }
    }
    return true;
  }

  bool sweep(std::size_t i) {
    if (stop_ && !of_.may_reach(i, *stop_)) {
      return true;
    }
    const Candidate& candidate = of_.candidate(i);
    const Shell& shell = shells_.of(candidate.point_tool);
    const Triangle* const triangle = of_.triangle(i, scenery_);
    if (triangle != nullptr && planes_.keep_off(*triangle, shell.inner_m)) {
      return true;
    }
    if (of_.must_wait(i)) {
      return false;
    }
    const Nearest& start = of_.nearest(i, scenery_);
    const double travel =
        candidate.primitive != nullptr
            ? travel_to_contact(*candidate.primitive, scenery_[candidate.object].sides, sweep_,
                                free_, shell, candidate.seen)
            : travel_to_contact(candidate.triangle, candidate.one_sided, sweep_, free_, shell,
                                start);
    if (travel < free_) {
      free_ = travel;
      stopped_by_ = i;
      end_ = sweep_.from + free_ * sweep_.direction;
      stop_.emplace(of_, end_);
      of_.work().add(kWorkOfAStop);
    }
    return true;
  }

  Neighbourhood& of_;
  const Shells& shells_;
  const Scenery& scenery_;
  const Sweep& sweep_;
  SeparatingPlanes planes_;
  double free_;  // m
  Vec3 end_;     // of that
  std::size_t stopped_by_ = kNothing;
  std::optional<Neighbourhood::Bounded> stop_;  // once there is one
};

// How much of the way the sphere may go. A move that leaves the trusted capsule is cut at its
// border, where the neighbourhood is gathered anew; one that leaves even a fresh one is asked of
// the hierarchy, as far as that is cheap.
SphereProxy::Advance SphereProxy::travel_toward(const Scenery& scenery, const Vec3& goal,
                                                const ProxyRest& rest) {
  const Vec3 move = goal - p_;
  const double length = move.norm();
  const Sweep sweep{.from = p_, .direction = move / length};
  const bool stays = neighbourhood_.trusts(goal);
  const double room =
      stays ? length : std::min(length, neighbourhood_.trust_along(p_, sweep.direction));
  const Way way{
      .sweep = sweep, .length = room, .end = stays ? goal : Vec3{p_ + room * sweep.direction}};
  CandidateSweep candidates(*this, scenery, way, rest);
  Advance advance{.direction = sweep.direction};
  if (!candidates.sweep_all()) {
    return advance;
  }
  advance.travel = candidates.free();
  advance.stopped_by = candidates.stopped_by();
  advance.is_known = stays && advance.travel >= length;
  if (!stays && neighbourhood_.is_fresh() && advance.travel >= room &&
      neighbourhood_.size() <= kMostToCast) {
    const std::size_t most_work = std::min(kMostCastWork, neighbourhood_.work().left());
    advance.travel = std::max(room, cast(scenery, sweep, length, most_work));
  }
  advance.arrived = advance.travel >= length;
  if (advance.stopped_by != kNothing && stopper_count_ < stoppers_.size() &&
      !has_stopped(advance.stopped_by)) {
    stoppers_[stopper_count_++] = advance.stopped_by;
  }
  if (advance.travel > kHeld_m) {
    advance.stopped_by = kNothing;
  }
  return advance;
}

double SphereProxy::cast(const Scenery& scenery, const Sweep& sweep, double length,
                         std::size_t most_work) {
  std::size_t room = most_work;
  const FirstHit hit =
      cast_on_all(scenery, shells_, sweep, length, room, neighbourhood_.left_out());
  neighbourhood_.work().add(most_work - room);
  if (hit.object != kNoObject) {  // should the tick end before it is measured there
    touched_ = {.object = hit.object, .triangle = hit.triangle, .normal_W = Vec3::Zero()};
  }
  return hit.travel_m;
}

void SphereProxy::go_straight(const Scenery& scenery, const Vec3& h_W) {
  const Vec3 move = h_W - p_;
  const double length = move.norm();
  if (length <= 0.0) {
    friction_ = FrictionState::free;
    return;
  }
  const Sweep sweep{.from = p_, .direction = move / length};
  const double travel = cast(scenery, sweep, length, kMaxCarryWork);
  if (travel > 0.0) {
    p_ = travel >= length ? h_W : Vec3{p_ + travel * sweep.direction};
    neighbourhood_.move_to(p_);
  }
}

}  // namespace tactus::rendering
