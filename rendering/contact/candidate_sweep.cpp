// The sweep of one move. Its cost is in measuring candidates, so each one passes three cheap tests
// first: its tangent shows it out of reach of the sweep's end; a plane that holds the sphere
// separates it from the whole segment; the tangent shows it out of reach of the end to which
// another candidate has shortened the sweep. Convexity makes the first and the last valid for the
// whole segment.
#include "rendering/contact/candidate_sweep.h"

#include <algorithm>
#include <optional>
#include <span>

#include "rendering/contact/primitive_sweep.h"

namespace tactus::rendering {
namespace {

// A triangle in contact that blocks the sphere within this travel counts as an active constraint.
constexpr double kBlockedTravel_m = 1e-6;
// Limits a sweep beyond the candidate set: with more candidates it would search too many triangles.
constexpr std::size_t kMaxCandidatesForLongSweep = 24;
// Limits the cost of a sweep beyond the candidate set, in cost units.
constexpr std::size_t kMaxLongSweepCost = 240;

// A straight move to sweep.
struct Segment {
  Sweep sweep;
  double length_m = 0.0;
  Vec3 end = Vec3::Zero();
};

// Shortens the segment to the first candidate that blocks the sphere.
class CandidateSweep {
 public:
  CandidateSweep(const NearbySurfaces& near, const Segment& segment, const ProxyRest& rest)
      : near_(near),
        sweep_(segment.sweep),
        planes_(segment.sweep.from, segment.end),
        free_m_(segment.length_m),
        end_(segment.end) {
    for (std::size_t i = 0; i < rest.plane_count; ++i) {
      planes_.add(rest.planes[i].plane.normal);
    }
  }

  // Sweeps against all candidates. Returns false if the tick's budget is spent before the end is
  // known.
  bool sweep_all() {
    std::span<const std::uint16_t> here;
    if (!near_.margins.is_point()) {  // a point is near few
      here = near_.candidates.within_reach_here();
    }
    return sweep_each(here, {}) && sweep_each(near_.candidates.within_reach(end_), here);
  }

  [[nodiscard]] double free_m() const { return free_m_; }
  [[nodiscard]] std::size_t blocked_by() const { return blocked_by_; }

 private:
  // Sweeps against the numbered candidates, except those that were swept before; both spans ascend,
  // so one pass over both finds the common numbers. Returns false if the tick's budget is spent.
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

  // Sweeps against candidate i, and shortens the free part of the segment if that blocks. Returns
  // false if the tick's budget is spent and the candidate is not measured yet.
  bool sweep(std::size_t i) {
    CandidateSet& candidates = near_.candidates;
    if (stop_ && !candidates.may_reach(i, *stop_)) {
      return true;
    }
    const Candidate& candidate = candidates.candidate(i);
    const ContactMargin& margin = near_.margins.of(candidate.point_tool);
    const Triangle* const triangle = candidates.triangle(i, near_.scene);
    if (triangle != nullptr && planes_.keep_off(*triangle, margin.inner_m)) {
      return true;
    }
    if (candidates.must_wait(i)) {
      return false;
    }
    const Nearest& start = candidates.nearest(i, near_.scene);
    const double travel =
        candidate.primitive != nullptr
            ? travel_to_contact(*candidate.primitive, near_.scene[candidate.object].sides, sweep_,
                                free_m_, margin, candidate.seen)
            : travel_to_contact(candidate.triangle, candidate.one_sided, sweep_, free_m_, margin,
                                start);
    if (travel < free_m_) {
      free_m_ = travel;
      blocked_by_ = i;
      end_ = sweep_.from + free_m_ * sweep_.direction;
      stop_ = candidates.bounds_at(end_);
      candidates.budget().spend(kCostOfStop);
    }
    return true;
  }

  const NearbySurfaces& near_;
  const Sweep& sweep_;
  SeparatingPlanes planes_;
  double free_m_;
  // The end of the free part; world frame, m.
  Vec3 end_;
  std::size_t blocked_by_ = kNoCandidate;
  std::optional<TangentBounds::Position>
      stop_;  // the end, once a candidate has shortened the sweep
};

}  // namespace

SweepResult sweep_toward(const NearbySurfaces& near, const Vec3& p, const Vec3& goal,
                         const ProxyRest& rest, ConstraintMemory& memory) {
  CandidateSet& candidates = near.candidates;
  const Vec3 move = goal - p;
  const double length = move.norm();
  const Sweep sweep{.from = p, .direction = move / length};
  const bool stays = candidates.trusts(goal);
  // The candidates are valid within the trusted capsule only: a longer move is cut at its border.
  const double room = stays ? length : std::min(length, candidates.trust_along(p, sweep.direction));
  const Segment segment{
      .sweep = sweep, .length_m = room, .end = stays ? goal : Vec3{p + room * sweep.direction}};
  CandidateSweep against(near, segment, rest);
  SweepResult result{.direction = sweep.direction};
  if (!against.sweep_all()) {
    return result;
  }
  result.travel_m = against.free_m();
  result.ends_at = against.blocked_by();
  result.is_known = stays && result.travel_m >= length;
  // A capsule that was gathered in this tick and is left again is too small for the tool's motion.
  // The sweep goes on against the hierarchies, if the place is sparse enough for that to be cheap.
  if (!stays && candidates.is_fresh() && result.travel_m >= room &&
      candidates.size() <= kMaxCandidatesForLongSweep) {
    const std::size_t max_cost = std::min(kMaxLongSweepCost, candidates.budget().left());
    result.beyond = sweep_beyond_candidates(near, sweep, length, max_cost);
    result.travel_m = std::max(room, result.beyond.travel_m);
  }
  result.arrived = result.travel_m >= length;
  if (result.ends_at != kNoCandidate) {
    memory.add_blocking(result.ends_at);
  }
  // A candidate that is met on the way becomes a plane at the next position, where it is measured
  // anew.
  if (result.travel_m <= kBlockedTravel_m) {
    result.blocked_by = result.ends_at;
  }
  return result;
}

FirstHit sweep_beyond_candidates(const NearbySurfaces& near, const Sweep& sweep, double length_m,
                                 std::size_t max_cost) {
  std::size_t cost_left = max_cost;
  const FirstHit hit = sweep_all_objects(near.scene, near.margins, sweep, length_m, cost_left,
                                         near.candidates.left_out());
  near.candidates.budget().spend(max_cost - cost_left);
  return hit;
}

}  // namespace tactus::rendering
