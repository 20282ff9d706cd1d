// The triangles and primitives near the tool, kept from tick to tick: as long as the proxy stays
// within the trusted capsule, which goes from the place where they were gathered in the direction
// in which the proxy came there, no others can touch the sphere and the hierarchies need not be
// asked again. A sphere of radius R that may move aside by w can touch a surface only within
// sqrt(2 R w) of its way, so that a slim capsule meets far fewer triangles than a ball that lasts
// as long.
//
// Distance to a convex shape is a convex function, so its tangent at any point bounds it from below
// everywhere. Each candidate keeps the tangent of its last measurement (before the first, a plane
// in front of its corners): one dot product tells nearly always that it cannot be met, and only the
// few others are measured.
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
#include "rendering/state/state_archive.h"
#include "rendering/world/scene_objects.h"

namespace tactus::rendering {

// Most are found and never measured: what finding writes comes first, in one cache line.
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
  // Forgets everything; the next `ensure` gathers.
  void clear() {
    trust_.radius = -1.0;
    size_ = 0;
    here_place_ = 0;
    to_walk_.count = 0;
    to_walk_.left.clear();
    is_full_ = false;
  }
  // The same, and what it has learnt about how to gather: as if it were new.
  void start_over() {
    clear();
    trust_ = {};
    wanted_length_m_ = 0.0;
    slimness_ = 1.0;
    smaller_ = 0;
    budget_ = {};
    left_out_ = {};
  }

  // Objects that give no candidates. A change takes clear() to come about.
  [[nodiscard]] LeftOut& left_out() { return left_out_; }

  // Forgets everything if an object moved that is near enough to matter.
  void begin_tick(const SceneObjects& scene);

  enum class Gathering : std::uint8_t {
    complete,  // the candidates are valid about p
    smaller,   // the same, but more triangles than kMaxCandidates made the capsule smaller
    begun,     // the tick's work is done: the next `ensure` for the same p goes on
    too_many,  // more than kMaxCandidates even in the smallest capsule
  };
  // Makes the candidates valid about p, at once or over several ticks.
  Gathering ensure(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p);
  // The same for a proxy that is at p at a tick's end and will be at `next` after another, if it
  // would leave what is valid, and the tick had little work: so that few ticks both gather and move
  // among what was gathered.
  void look_ahead(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p,
                  const Vec3& next);
  // Whether the next `ensure` has more to do.
  [[nodiscard]] bool is_begun() const { return to_walk_.count > 0; }

  // Whether the candidates are valid about p, and on the straight way there from where they are.
  [[nodiscard]] bool trusts(const Vec3& p) const { return trust_.depth(p) >= 0.0; }

  // How far the proxy may move from p, which is inside, along a unit direction before the
  // candidates must be gathered again.
  [[nodiscard]] double trust_along(const Vec3& p, const Vec3& direction) const {
    return trust_.room_along(p, direction);
  }

  // From now on `nearest` measures from p.
  void move_to(const Vec3& p) {
    place_ = p;
    ++places_;
  }

  // The candidates that may be within the contact margin's reach of the place of `move_to`, or of
  // p, where `farther_m` adds to the reach; all others are not. Valid until the next call of the
  // same.
  std::span<const std::uint16_t> within_reach_here();
  std::span<const std::uint16_t> within_reach(const Vec3& p, double farther_m = 0.0);

  // The same, where p is what `within_reach` was last asked for: of others it need not be asked.
  void move_to_end(const Vec3& p);

  // A place, as the tangents take it; while the candidates are the same.
  struct Bounded {
    Bounded(const CandidateSet& of, const Vec3& p);
    float x, y, z;
    float most;  // a larger bound is out of reach
  };
  // Whether candidate i is one of those, for the place.
  [[nodiscard]] bool may_reach(std::size_t i, const Bounded& at) const {
    return normal_x_[i] * at.x + normal_y_[i] * at.y + normal_z_[i] * at.z + height_[i] <= at.most;
  }

  // The nearest point of candidate i from the place of `move_to`, measured once a place.
  const Nearest& nearest(std::size_t i, const SceneObjects& scene);
  [[nodiscard]] bool is_measured(std::size_t i) const { return slots_[i].measured_at == places_; }

  // The triangle of candidate i, to look whether it must be measured; nullptr of a primitive.
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
  // Its triangle is there once `nearest` or `triangle` was asked.
  [[nodiscard]] const Candidate& candidate(std::size_t i) const { return slots_[i]; }

  [[nodiscard]] std::size_t peak() const { return peak_; }

  // Grows whenever the candidates change, and with them the meaning of their numbers.
  [[nodiscard]] std::size_t gatherings() const { return gatherings_; }

  // Whether that was so since the last `start_tick_budget`.
  [[nodiscard]] bool is_fresh() const { return gatherings_ >= first_gathering_; }

  // What has been done since the last `start_tick_budget`.
  void start_tick_budget() {
    budget_.begin_tick();
    waited_ = first_place_ == places_;
    first_place_ = places_;
    first_gathering_ = gatherings_ + 1;
  }
  [[nodiscard]] TickBudget& budget() { return budget_; }
  [[nodiscard]] const TickBudget& budget() const { return budget_; }
  // Whether that is all for this tick. Not where objects moved: what was found would be lost.
  [[nodiscard]] bool is_budget_spent() const { return may_pause_ && budget_.is_exhausted(); }
  // Whether the proxy still is where the last tick's work began: what that had too much to do for,
  // this one does, up to its first move, so that no place holds the proxy. Where objects moved
  // nothing is kept for the next tick, and that holds at once.
  [[nodiscard]] bool has_waited() const {
    return !may_pause_ || (waited_ && places_ == first_place_);
  }
  // Whether candidate i must wait for the next tick; what was measured is kept.
  [[nodiscard]] bool must_wait(std::size_t i) const {
    return is_budget_spent() && !has_waited() && !is_measured(i);
  }

  // What it remembers, to bytes or back; of the same scene and shells.
  void transfer(StateArchive& archive, const SceneObjects& scene, const ContactMargins& margins);

 private:
  // Meshes whose triangles are not all looked at yet, by the number of the object.
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
  // The next capsule to trust, from p on.
  [[nodiscard]] Capsule plan(const Vec3& p);
  void begin_gathering(const SceneObjects& scene, const Capsule& trust);
  void go_on_gathering(const SceneObjects& scene);
  void walk_mesh(const SceneObjects& scene, std::uint32_t number);
  void end_gathering(const SceneObjects& scene);
  // The next free candidate, or nullptr.
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
  // At least that far from the capsule's start, and farther along the normal.
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
  // The tangents: distance from p is at least normal . (p - trust_.start) + height.
  // Those of the last four that are no candidates are out of reach.
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
