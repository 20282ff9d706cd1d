// Sweeps the sphere to the sub-goal and finds the candidate that blocks it.
//
// A distance is convex along the segment, so a candidate that the tangent at the start shows out of
// reach at the end is out of reach all along. Most of the others lie behind the planes that hold
// the sphere, on a convex surface all of them. The candidates near the start are swept first: in a
// hollow they block the sphere soon, and few of the rest are within reach of there.
#include <algorithm>
#include <optional>
#include <span>

#include "rendering/contact/object_sweep.h"
#include "rendering/contact/primitive_sweep.h"
#include "rendering/contact/sphere_proxy.h"

namespace tactus::rendering {
namespace {

// A triangle in contact that blocks the sphere within this travel counts as an active constraint.
constexpr double kBlockedTravel_m = 1e-6;
// Limits a sweep beyond the candidate set: with more candidates it would search too many triangles.
constexpr std::size_t kMaxCandidatesForLongSweep = 24;
// Limits the cost of a sweep beyond the candidate set, in cost units.
constexpr std::size_t kMaxLongSweepCost = 240;

}  // namespace

// Shortens the segment to the first candidate that blocks the sphere.
class SphereProxy::CandidateSweep {
 public:
  CandidateSweep(SphereProxy& proxy, const SceneObjects& scene, const Segment& segment,
                 const ProxyRest& rest)
      : of_(proxy.candidate_set_),
        margins_(proxy.margins_),
        scene_(scene),
        sweep_(segment.sweep),
        planes_(segment.sweep.from, segment.end),
        free_(segment.length),
        end_(segment.end) {
    for (std::size_t i = 0; i < rest.plane_count; ++i) {
      planes_.add(rest.planes[i].plane.normal);
    }
  }

  // Sweeps against all candidates. Returns false if the tick's budget is spent before the end is
  // known.
  bool sweep_all() {
    std::span<const std::uint16_t> here;
    if (!margins_.is_point()) {  // a point is near few
      here = of_.within_reach_here();
    }
    return sweep_each(here, {}) && sweep_each(of_.within_reach(end_), here);
  }

  [[nodiscard]] double free() const { return free_; }
  [[nodiscard]] std::size_t blocked_by() const { return blocked_by_; }

 private:
  // Sweeps against the numbered candidates, except those that were swept before; both spans ascend.
  // Returns false if the tick's budget is spent.
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
    const ContactMargin& margin = margins_.of(candidate.point_tool);
    const Triangle* const triangle = of_.triangle(i, scene_);
    if (triangle != nullptr && planes_.keep_off(*triangle, margin.inner_m)) {
      return true;
    }
    if (of_.must_wait(i)) {
      return false;
    }
    const Nearest& start = of_.nearest(i, scene_);
    const double travel =
        candidate.primitive != nullptr
            ? travel_to_contact(*candidate.primitive, scene_[candidate.object].sides, sweep_, free_,
                                margin, candidate.seen)
            : travel_to_contact(candidate.triangle, candidate.one_sided, sweep_, free_, margin,
                                start);
    if (travel < free_) {
      free_ = travel;
      blocked_by_ = i;
      end_ = sweep_.from + free_ * sweep_.direction;
      stop_.emplace(of_, end_);
      of_.budget().spend(kCostOfStop);
    }
    return true;
  }

  CandidateSet& of_;
  const ContactMargins& margins_;
  const SceneObjects& scene_;
  const Sweep& sweep_;
  SeparatingPlanes planes_;
  double free_;  // m
  Vec3 end_;     // of that
  std::size_t blocked_by_ = kNoCandidate;
  std::optional<CandidateSet::Bounded> stop_;  // once there is one
};

// Returns how far the sphere may move toward the goal. A move that leaves the trusted capsule is
// cut at its border, where the candidate set is gathered again. One that leaves even a fresh
// capsule is swept against the hierarchies, as far as that is cheap.
SphereProxy::SweepResult SphereProxy::sweep_toward(const SceneObjects& scene, const Vec3& goal,
                                                   const ProxyRest& rest) {
  const Vec3 move = goal - p_;
  const double length = move.norm();
  const Sweep sweep{.from = p_, .direction = move / length};
  const bool stays = candidate_set_.trusts(goal);
  const double room =
      stays ? length : std::min(length, candidate_set_.trust_along(p_, sweep.direction));
  const Segment segment{
      .sweep = sweep, .length = room, .end = stays ? goal : Vec3{p_ + room * sweep.direction}};
  CandidateSweep candidates(*this, scene, segment, rest);
  SweepResult result{.direction = sweep.direction};
  if (!candidates.sweep_all()) {
    return result;
  }
  result.travel = candidates.free();
  result.blocked_by = candidates.blocked_by();
  result.is_known = stays && result.travel >= length;
  if (!stays && candidate_set_.is_fresh() && result.travel >= room &&
      candidate_set_.size() <= kMaxCandidatesForLongSweep) {
    const std::size_t max_cost = std::min(kMaxLongSweepCost, candidate_set_.budget().left());
    result.travel = std::max(room, sweep_objects(scene, sweep, length, max_cost));
  }
  result.arrived = result.travel >= length;
  if (result.blocked_by != kNoCandidate && blocking_count_ < blocking_candidates_.size() &&
      !is_blocking(result.blocked_by)) {
    blocking_candidates_[blocking_count_++] = result.blocked_by;
  }
  if (result.travel > kBlockedTravel_m) {
    result.blocked_by = kNoCandidate;
  }
  return result;
}

double SphereProxy::sweep_objects(const SceneObjects& scene, const Sweep& sweep, double length,
                                  std::size_t max_cost) {
  std::size_t cost_left = max_cost;
  const FirstHit hit =
      sweep_all_objects(scene, margins_, sweep, length, cost_left, candidate_set_.left_out());
  candidate_set_.budget().spend(max_cost - cost_left);
  if (hit.object != kNoObject) {  // should the tick end before it is measured there
    last_contact_ = {.object = hit.object, .triangle = hit.triangle, .normal_W = Vec3::Zero()};
  }
  return hit.travel_m;
}

void SphereProxy::sweep_to_tool(const SceneObjects& scene, const Vec3& h_W) {
  const Vec3 move = h_W - p_;
  const double length = move.norm();
  if (length <= 0.0) {
    friction_ = FrictionState::free;
    return;
  }
  const Sweep sweep{.from = p_, .direction = move / length};
  const double travel = sweep_objects(scene, sweep, length, kMaxCarryBudget);
  if (travel > 0.0) {
    p_ = travel >= length ? h_W : Vec3{p_ + travel * sweep.direction};
    candidate_set_.move_to(p_);
  }
}

}  // namespace tactus::rendering
