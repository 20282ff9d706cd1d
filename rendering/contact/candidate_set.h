// The candidate set: the triangles and primitives near the tool, cached from tick to tick.
//
// The cache is valid while the proxy stays inside the trusted capsule. The capsule starts where the
// candidates were gathered and extends in the direction in which the proxy moved. No surface
// outside the candidate set can touch the sphere there, so the hierarchies are not searched again.
// A sphere of radius R that moves aside by at most w can touch a surface only within sqrt(2 R w) of
// its path, so a slim capsule contains far fewer triangles than a ball of the same length.
//
// Each candidate keeps the tangent of its last measurement, which is a lower bound of its distance
// (tangent_bounds.h); before the first measurement it has a plane in front of its corners. Only
// candidates whose bound is within reach are measured.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/contact/candidate.h"
#include "rendering/contact/left_out.h"
#include "rendering/contact/reach_memory.h"
#include "rendering/contact/sphere_sweep.h"
#include "rendering/contact/trusted_capsule.h"
#include "rendering/geometry/hierarchy_query.h"
#include "rendering/geometry/triangle.h"
#include "rendering/limits.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"
#include "rendering/tick_budget.h"

namespace tactus::rendering {

// The set of one proxy. It also owns the tick budget, since nearly all of a tick's cost is in
// gathering and measuring candidates, and the objects that are left out, since those give no
// candidates.
//
// A tick: begin_tick(), start_tick_budget(), then per sub-goal ensure(), within_reach_here() and
// nearest() for the planes, within_reach() and nearest() for the sweep, move_to(); look_ahead() at
// the end.
class CandidateSet {
 public:
  // Removes all candidates; the next `ensure` gathers them again.
  void clear() {
    trust_.clear();
    size_ = 0;
    reach_.forget();
    progress_.clear();
  }
  // Resets the set to its initial state, including the learnt size of the capsule.
  void start_over() {
    clear();
    trust_ = {};
    progress_.smaller = 0;
    left_out_ = {};
  }

  // Return the objects that give no candidates. Call clear() after a change.
  [[nodiscard]] LeftOut& left_out() { return left_out_; }
  [[nodiscard]] const LeftOut& left_out() const { return left_out_; }

  // Removes all candidates if an object moved near the trusted capsule.
  void begin_tick(const SceneObjects& scene);

  // The outcome of a gathering.
  enum class Gathering : std::uint8_t {
    complete,  // the candidates are valid about p
    begun,     // the tick's budget is spent: the next `ensure` for the same p goes on
    too_many,  // more than kMaxCandidates even in the smallest capsule
  };
  // Makes the candidates valid at p, in this tick or over several ticks.
  Gathering ensure(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p);
  // Gathers candidates ahead of need at the end of a tick. It does so if the proxy, now at p, would
  // leave the trusted capsule on its move to `next`, and this tick used little of its budget. A
  // tick then seldom has to gather and to move among many new candidates.
  void look_ahead(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p,
                  const Vec3& next);
  // Returns true if a gathering was begun and is not complete.
  [[nodiscard]] bool is_begun() const { return progress_.mesh_count > 0; }

  // Returns true if the candidates are valid at p and on the segment from the proxy to p.
  [[nodiscard]] bool trusts(const Vec3& p) const { return trust_.capsule.depth(p) >= 0.0; }

  // Returns how far, in metres, the proxy may move from p along a unit direction before the
  // candidates must be gathered again. `p` must be inside the trusted capsule.
  [[nodiscard]] double trust_along(const Vec3& p, const Vec3& direction) const {
    return trust_.capsule.room_along(p, direction);
  }

  // Sets the position from which `nearest` measures.
  void move_to(const Vec3& p) { place_.move_to(p); }

  // Return the numbers of the candidates whose distance may be below the contact margin's
  // `reach_m`, measured from the position of `move_to` or from p. `farther_m` is added to the
  // reach. All other candidates are farther away. The span is valid until the next call of the same
  // function.
  std::span<const std::uint16_t> within_reach_here();
  std::span<const std::uint16_t> within_reach(const Vec3& p, double farther_m = 0.0);

  // Does the same as `move_to` for the p of the last `within_reach` call, and reuses its result.
  void move_to_end(const Vec3& p);

  // A position in the form that `may_reach` uses. It is valid until the candidates change.
  [[nodiscard]] TangentBounds::Position bounds_at(const Vec3& p) const {
    return reach_.bounds().at(p);
  }
  // Returns false if the tangent shows that candidate i is out of reach of the position.
  [[nodiscard]] bool may_reach(std::size_t i, const TangentBounds::Position& at) const {
    return reach_.bounds().may_reach(i, at);
  }

  // Returns the nearest point of candidate i from the position of `move_to`. It is measured once
  // per position.
  const Nearest& nearest(std::size_t i, const SceneObjects& scene);
  // Returns true if candidate i was measured from the position of `move_to`.
  [[nodiscard]] bool is_measured(std::size_t i) const {
    return slots_[i].measured_at == place_.number;
  }

  // Returns the triangle of candidate i for a test that is cheaper than a measurement, or nullptr
  // if the candidate is a primitive.
  const Triangle* triangle(std::size_t i, const SceneObjects& scene) {
    Candidate& slot = slots_[i];
    if (slot.primitive != nullptr) {
      return nullptr;
    }
    budget_.spend(kCostOfSeparation);
    prepare(slot, scene);
    return &slot.triangle;
  }

  // Returns the number of candidates.
  [[nodiscard]] std::size_t size() const { return size_; }
  // Returns candidate i. Its `triangle` is set after a call of `nearest` or `triangle`.
  [[nodiscard]] const Candidate& candidate(std::size_t i) const { return slots_[i]; }

  // Returns the largest number of candidates so far.
  [[nodiscard]] std::size_t peak() const { return counts_.peak; }

  // Returns how often the set was gathered. Candidate numbers are valid until it grows.
  [[nodiscard]] std::size_t gatherings() const { return counts_.gatherings; }

  // Returns true if the set was gathered since the last `start_tick_budget`.
  [[nodiscard]] bool is_fresh() const { return counts_.gatherings >= counts_.first_of_tick; }

  // Starts the budget of a new tick, in cost units.
  void start_tick_budget(std::size_t limit) {
    budget_.begin_tick(limit);
    place_.begin_tick();
    counts_.first_of_tick = counts_.gatherings + 1;
  }
  // Returns the tick's budget, which gathering and measuring spend.
  [[nodiscard]] TickBudget& budget() { return budget_; }
  [[nodiscard]] const TickBudget& budget() const { return budget_; }
  // Returns true if the gathering must pause because the tick's budget is spent. It never pauses
  // near objects that moved, because the result would not be valid in the next tick.
  [[nodiscard]] bool is_budget_spent() const {
    return progress_.may_pause && budget_.is_exhausted();
  }
  // Returns true if the proxy has not moved since the last tick began. That tick ran out of budget,
  // so this one may exceed its budget up to the first move: no place can hold the proxy for ever.
  // Near objects that moved nothing is kept for the next tick, and the result is always true.
  [[nodiscard]] bool has_waited() const { return !progress_.may_pause || place_.has_waited(); }
  // Returns true if candidate i may only be measured in the next tick. Measurements are kept.
  [[nodiscard]] bool must_wait(std::size_t i) const {
    return is_budget_spent() && !has_waited() && !is_measured(i);
  }

  // Saves the state to the archive, or restores it; the scene and the margins must be the same.
  void transfer(StateArchive& archive, const SceneObjects& scene, const ContactMargins& margins);

 private:
  // A gathering, which may take several ticks.
  struct Progress {
    // The numbers of the objects whose meshes are yet to be searched, the first `mesh_count`.
    std::array<std::uint32_t, kMaxObjects> meshes{};
    std::size_t mesh_count = 0;
    // The rest of the walk of the last of them, if that was begun.
    WalkLeft left;
    // The number of triangles tested, from which the plan of the capsules learns.
    std::size_t tested = 0;
    // How often the gathering was begun anew, for want of room.
    std::size_t smaller = 0;
    // True if there was no room for a candidate.
    bool is_full = false;
    // True if no object moved here in this tick, so that a gathering may go on in the next one.
    bool may_pause = true;

    void clear() {
      mesh_count = 0;
      left.clear();
      is_full = false;
    }
  };

  // The position from which candidates are measured.
  struct Place {
    // The position; world frame, m.
    Vec3 p = Vec3::Zero();
    // The position's number, which grows with every move.
    std::uint64_t number = 1;
    // The number at the last `start_tick_budget`.
    std::uint64_t first_of_tick = 0;
    // True if the number was the same at the call before: the last tick made no move.
    bool waited = false;

    void move_to(const Vec3& to) {
      p = to;
      ++number;
    }
    void begin_tick() {
      waited = first_of_tick == number;
      first_of_tick = number;
    }
    // Returns true if neither the last tick nor this one has made a move.
    [[nodiscard]] bool has_waited() const { return waited && number == first_of_tick; }
  };

  // The counts of gatherings.
  struct Counts {
    // The largest number of candidates so far.
    std::size_t peak = 0;
    // The number of gatherings that were begun, and the first one since the last
    // `start_tick_budget`.
    std::size_t gatherings = 0;
    std::size_t first_of_tick = 0;  // the first gathering since the last `start_tick_budget`
  };

  // Visitors of the walks, in candidate_set_gather.cpp.
  struct GatherObjects;
  struct GatherTriangles;
  // A gathering that would be begun anew so often, each time with half the capsule, gives up.
  static constexpr std::size_t kMostSmaller = 8;

  // The parts of `ensure`: gather runs or continues a gathering, begin_gathering lists what to
  // search, go_on_gathering searches until the budget is spent, walk_mesh does so for one mesh,
  // end_gathering takes stock.
  Gathering gather(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p);
  void begin_gathering(const SceneObjects& scene, const Capsule& trust);
  void go_on_gathering(const SceneObjects& scene);
  void walk_mesh(const SceneObjects& scene, std::uint32_t number);
  void end_gathering(const SceneObjects& scene);
  // Returns the next free slot, or nullptr if the set is full.
  Candidate* add(const Object& object, std::uint32_t number);
  void add_primitive(const Object& object, std::uint32_t number, const Primitive& primitive);
  // Builds the triangle of a candidate, unless that is done.
  static void prepare(Candidate& slot, const SceneObjects& scene) {
    if (!slot.prepared) {
      build(slot, scene);
    }
  }
  static void build(Candidate& slot, const SceneObjects& scene);
  void measure_primitive(std::size_t i);
  void transfer_walk(StateArchive& archive, const SceneObjects& scene);
  void transfer_candidate(StateArchive& archive, const SceneObjects& scene, std::size_t i);
  // Returns how much shorter the reach of candidate i is than the sphere's, m.
  [[nodiscard]] double shorter_reach(std::size_t i) const {
    return margins_.sphere.reach_m - margins_.of(slots_[i].point_tool).reach_m;
  }
  // Returns the key of the current position and candidates.
  [[nodiscard]] ReachMemory::Key now() const {
    return {.place = place_.number, .gathering = counts_.gatherings};
  }

  // The position from which candidates are measured.
  Place place_;
  TrustedCapsule trust_;
  // The contact margins of the last gathering.
  ContactMargins margins_{0.0};
  std::size_t size_ = 0;
  Counts counts_;
  Progress progress_;
  TickBudget budget_;
  LeftOut left_out_;
  // The lower bounds of the candidates' distances, and those within reach.
  ReachMemory reach_;
  std::array<Candidate, kMaxCandidates> slots_{};
};

}  // namespace tactus::rendering
