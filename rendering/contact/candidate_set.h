// The candidate set: the triangles and primitives near the tool, cached from tick to tick.
//
// The cache is valid while the proxy stays inside the trusted capsule. The capsule starts where the
// candidates were gathered and extends in the direction in which the proxy moved. No surface
// outside the candidate set can touch the sphere there, so the hierarchies are not searched again.
// A sphere of radius R that moves aside by at most w can touch a surface only within sqrt(2 R w) of
// its path, so a slim capsule contains far fewer triangles than a ball of the same length.
//
// The distance to a convex shape is a convex function, so its tangent plane at any point is a lower
// bound everywhere. Each candidate keeps the tangent of its last measurement (before the first one,
// a plane in front of its corners). One dot product then shows for most candidates that they are
// out of reach, and only the others are measured.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/contact/left_out.h"
#include "rendering/contact/sphere_sweep.h"
#include "rendering/contact/tick_budget.h"
#include "rendering/geometry/capsule.h"
#include "rendering/geometry/floats.h"
#include "rendering/geometry/hierarchy_query.h"
#include "rendering/geometry/triangle.h"
#include "rendering/limits.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// One member of the set. Most candidates are gathered and never measured, so the fields that
// gathering writes come first, in one cache line.
struct alignas(64) Candidate {
  const Primitive* primitive = nullptr;  // of an object without a mesh
  std::uint64_t measured_at = 0;         // CandidateSet::move_to's count
  std::uint32_t object = 0;
  std::uint32_t index = 0;  // of the triangle in its mesh
  bool prepared = false;    // `triangle` is built
  bool one_sided = true;
  bool point_tool = false;  // to this object the tool is its centre
  bool behind = false;      // one-sided, and the place is on its far side
  Nearest nearest;          // from the place of `measured_at`
  Triangle triangle;        // of a mesh, once it was measured
  SurfaceSample seen;       // of the primitive, from the place of `measured_at`
};

class CandidateSet {
 public:
  // Removes all candidates; the next `ensure` gathers them again.
  void clear() {
    trust_.radius = -1.0;
    size_ = 0;
    here_place_ = 0;
    to_walk_.count = 0;
    to_walk_.left.clear();
    is_full_ = false;
  }
  // Resets the set to its initial state, including the learnt size of the capsule.
  void start_over() {
    clear();
    trust_ = {};
    wanted_length_m_ = 0.0;
    slimness_ = 1.0;
    smaller_ = 0;
    budget_ = {};
    left_out_ = {};
  }

  // Returns the objects that give no candidates. Call clear() after a change.
  [[nodiscard]] LeftOut& left_out() { return left_out_; }

  // Removes all candidates if an object moved near the trusted capsule.
  void begin_tick(const SceneObjects& scene);

  enum class Gathering : std::uint8_t {
    complete,  // the candidates are valid about p
    smaller,   // the same, but more triangles than kMaxCandidates made the capsule smaller
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
  [[nodiscard]] bool is_begun() const { return to_walk_.count > 0; }

  // Returns true if the candidates are valid at p and on the segment from the proxy to p.
  [[nodiscard]] bool trusts(const Vec3& p) const { return trust_.depth(p) >= 0.0; }

  // Returns how far, in metres, the proxy may move from p along a unit direction before the
  // candidates must be gathered again. `p` must be inside the trusted capsule.
  [[nodiscard]] double trust_along(const Vec3& p, const Vec3& direction) const {
    return trust_.room_along(p, direction);
  }

  // Sets the position from which `nearest` measures.
  void move_to(const Vec3& p) {
    place_ = p;
    ++places_;
  }

  // Return the numbers of the candidates whose distance may be below the contact margin's
  // `reach_m`, measured from the position of `move_to` or from p. `farther_m` is added to the
  // reach. All other candidates are farther away. The span is valid until the next call of the same
  // function.
  std::span<const std::uint16_t> within_reach_here();
  std::span<const std::uint16_t> within_reach(const Vec3& p, double farther_m = 0.0);

  // Does the same as `move_to` for the p of the last `within_reach` call, and reuses its result.
  void move_to_end(const Vec3& p);

  // A position in the form that the tangent test uses. It is valid until the candidates change.
  struct Bounded {
    Bounded(const CandidateSet& of, const Vec3& p);
    float x, y, z;
    float most;  // a larger bound is out of reach
  };
  // Returns false if the tangent shows that candidate i is out of reach of the position.
  [[nodiscard]] bool may_reach(std::size_t i, const Bounded& at) const {
    return normal_x_[i] * at.x + normal_y_[i] * at.y + normal_z_[i] * at.z + height_[i] <= at.most;
  }

  // Returns the nearest point of candidate i from the position of `move_to`. It is measured once
  // per position.
  const Nearest& nearest(std::size_t i, const SceneObjects& scene);
  [[nodiscard]] bool is_measured(std::size_t i) const { return slots_[i].measured_at == places_; }

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

  [[nodiscard]] std::size_t size() const { return size_; }
  // Returns candidate i. Its `triangle` is set after a call of `nearest` or `triangle`.
  [[nodiscard]] const Candidate& candidate(std::size_t i) const { return slots_[i]; }

  [[nodiscard]] std::size_t peak() const { return peak_; }

  // Returns how often the set was gathered. Candidate numbers are valid until it grows.
  [[nodiscard]] std::size_t gatherings() const { return gatherings_; }

  // Returns true if the set was gathered since the last `start_tick_budget`.
  [[nodiscard]] bool is_fresh() const { return gatherings_ >= first_gathering_; }

  // Starts the budget of a new tick.
  void start_tick_budget() {
    budget_.begin_tick();
    waited_ = first_place_ == places_;
    first_place_ = places_;
    first_gathering_ = gatherings_ + 1;
  }
  [[nodiscard]] TickBudget& budget() { return budget_; }
  [[nodiscard]] const TickBudget& budget() const { return budget_; }
  // Returns true if the gathering must pause because the tick's budget is spent. It never pauses
  // near objects that moved, because the result would not be valid in the next tick.
  [[nodiscard]] bool is_budget_spent() const { return may_pause_ && budget_.is_exhausted(); }
  // Returns true if the proxy has not moved since the last tick began. That tick ran out of budget,
  // so this one may exceed its budget up to the first move: no place can hold the proxy for ever.
  // Near objects that moved nothing is kept for the next tick, and the result is always true.
  [[nodiscard]] bool has_waited() const {
    return !may_pause_ || (waited_ && places_ == first_place_);
  }
  // Returns true if candidate i may only be measured in the next tick. Measurements are kept.
  [[nodiscard]] bool must_wait(std::size_t i) const {
    return is_budget_spent() && !has_waited() && !is_measured(i);
  }

  // Saves the state to the archive, or restores it; the scene and the margins must be the same.
  void transfer(StateArchive& archive, const SceneObjects& scene, const ContactMargins& margins);

 private:
  // The meshes that a begun gathering has yet to search, by object number.
  struct ToWalk {
    std::array<std::uint32_t, kMaxObjects> meshes{};
    std::size_t count = 0;
    WalkLeft left;  // of the last of them, if its walk was begun
  };

  struct GatherObjects;
  struct GatherTriangles;
  static constexpr std::size_t kMostSmaller = 8;
  static constexpr double kLongTrust_m = 2.5e-3;  // longer only where triangles are few
  struct Within {
    std::array<std::uint16_t, kMaxCandidates> number{};
    std::size_t count = 0;

    void find(const CandidateSet& of, const Vec3& p, double farther_m);
    [[nodiscard]] std::span<const std::uint16_t> numbers() const { return {number.data(), count}; }
  };

  Gathering gather(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p);
  // Returns the capsule of the next gathering, which starts at p.
  [[nodiscard]] Capsule plan(const Vec3& p);
  void begin_gathering(const SceneObjects& scene, const Capsule& trust);
  void go_on_gathering(const SceneObjects& scene);
  void walk_mesh(const SceneObjects& scene, std::uint32_t number);
  void end_gathering(const SceneObjects& scene);
  // Returns the next free slot, or nullptr if the set is full.
  Candidate* add(const Object& object, std::uint32_t number);
  void add_primitive(const Object& object, std::uint32_t number, const Primitive& primitive);
  static void prepare(Candidate& slot, const SceneObjects& scene) {
    if (!slot.prepared) {
      build(slot, scene);
    }
  }
  static void build(Candidate& slot, const SceneObjects& scene);
  void measure_primitive(std::size_t i);
  void set_no_bound(std::size_t i);
  void fill_last_four();
  void transfer_walk(StateArchive& archive, const SceneObjects& scene);
  void transfer_here(StateArchive& archive);
  void transfer_candidate(StateArchive& archive, const SceneObjects& scene, std::size_t i);
  // Stores a lower bound of the distance of candidate i: `distance` (m) at the start of the
  // capsule, and growing along the normal.
  void store_bound(std::size_t i, const Float3& normal, double distance);
  void set_bound(std::size_t i, const Vec3& normal, double distance, const Vec3& from);

  Vec3 place_ = Vec3::Zero();
  Capsule trust_;
  double wanted_length_m_ = 0.0;
  double slimness_ = 1.0;  // of the capsule: its radius is its length over this
  ContactMargins margins_{0.0};
  std::uint64_t places_ = 1;
  std::size_t size_ = 0;
  std::size_t tested_ = 0;  // triangles, at the last gathering
  std::size_t peak_ = 0;
  std::size_t gatherings_ = 0;
  std::size_t first_gathering_ = 0;  // since the last `start_tick_budget`
  ToWalk to_walk_;                   // of a gathering that was begun
  std::size_t smaller_ = 0;          // how often it was begun anew, for want of room
  bool is_full_ = false;             // there was no room for a candidate
  bool may_pause_ = true;            // no object moved here in this tick
  std::uint64_t first_place_ = 0;    // at the last `start_tick_budget`
  bool waited_ = false;              // and it was so at the one before
  TickBudget budget_;
  LeftOut left_out_;
  // The tangents: the distance from p is at least normal . (p - trust_.start) + height. The arrays
  // are padded to a multiple of four with entries that are always out of reach.
  alignas(Floats) std::array<float, kMaxCandidates> normal_x_{};
  alignas(Floats) std::array<float, kMaxCandidates> normal_y_{};
  alignas(Floats) std::array<float, kMaxCandidates> normal_z_{};
  alignas(Floats) std::array<float, kMaxCandidates> height_{};
  Within here_;
  Within there_;
  std::uint64_t here_place_ = 0;
  std::size_t here_gathering_ = 0;
  std::array<Candidate, kMaxCandidates> slots_{};
};

}  // namespace tactus::rendering
