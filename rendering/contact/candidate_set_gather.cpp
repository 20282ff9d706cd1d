// Gathers the candidates: plans a capsule, walks the hierarchies of the meshes near it, and adds
// every triangle within reach of it.
//
//   1. CapsulePlan chooses the capsule from the last one and from where the proxy left it.
//   2. GatherObjects visits the objects whose box comes near. It adds primitives at once and lists
//      the meshes.
//   3. walk_mesh() walks one mesh at a time. GatherTriangles tests four triangles of a leaf at once
//      against the capsule's axis (near_segment.h) and adds those within reach. The test gives each
//      of them a plane in front of it, which is its first lower bound (tangent_bounds.h).
//   4. If the set is full, everything begins again with a capsule of half the size.
//   5. If nothing is near, the capsule becomes the largest free ball (free_ball.h).
//
// A surface belongs to the set if it comes within the capsule's radius plus the contact margin's
// reach of the capsule's axis: no other one can touch a sphere whose centre is in the capsule.
//
// In a dense place this costs more than one tick's budget, and the proxy waits there. The rest
// of the walk is kept (Progress), and the next tick goes on. Near objects that move it does not
// wait, because the next tick would have to begin again.
#include <algorithm>
#include <cmath>

#include "rendering/contact/candidate_set.h"
#include "rendering/contact/free_ball.h"
#include "rendering/geometry/near_segment.h"

namespace tactus::rendering {
namespace {

// A tick that has spent more than this, in cost units, gathers nothing for the next one: the cost
// of gathering is spread over the ticks.
constexpr std::size_t kLookAheadBudget = 184;

}  // namespace

// Adds the triangles of one object within reach of the trusted capsule, until the set is full or
// the tick's budget is spent. Everything is in the object's frame. It is a visitor of the walks of
// geometry/hierarchy_walk.h.
struct CandidateSet::GatherTriangles {
  CandidateSet& to;
  const Object& object;
  std::uint32_t number;
  // The object's pose in this tick; nullptr for an object at rest.
  const Mover* mover;
  const MeshView& mesh;
  // The capsule's axis, which starts at `start`.
  NearSegment segment;
  const Vec3& start;
  // The distance from the start beyond which nothing comes within reach of the axis.
  double farthest_m;

  void boxes(std::uint32_t pairs) { to.budget_.spend(kCostOfBoxPairNear * pairs); }

  void leaf(const BvhNode& leaf) {
    to.progress_.tested += leaf.triangle_count;
    to.budget_.spend(kCostOfLeafTriangle * leaf.triangle_count);
    segment.find(mesh, leaf.first, leaf.triangle_count,
                 [&](std::uint32_t t, const NearSegment::Bound& bound) { take(t, bound); });
  }
  [[nodiscard]] bool exhausted() const { return to.progress_.is_full || to.is_budget_spent(); }

  // Returns true if the triangle is out of reach by an exact measurement. The segment test accepts
  // many long thin triangles around a common point that are not near. The exact test is made only
  // after the set was full once.
  [[nodiscard]] bool is_far(std::uint32_t t) {
    if (to.progress_.smaller == 0) {
      return false;
    }
    to.budget_.spend(kCostOfMeasurement);
    return triangle_of(mesh, t).nearest(start).distance > farthest_m;
  }

  // Adds a triangle with its bound: a plane in front of it, turned to the world frame. From the
  // start the triangle is at least -offset away, and farther by n . (p - start) at p.
  void take(std::uint32_t t, const NearSegment::Bound& bound) {
    if (is_far(t)) {
      return;
    }
    Candidate* const slot = to.add(object, number);
    if (slot == nullptr) {
      return;
    }
    slot->index = t;
    Float3 normal = bound.normal;
    if (mover != nullptr) {
      normal = to_float3(direction_from(mover, to_vec3(normal)));
    }
    to.reach_.bounds().set_at_origin(to.size_ - 1, normal, -static_cast<double>(bound.offset),
                                     to.shorter_reach(to.size_ - 1));
  }
};

// Visits objects: adds primitives, and lists meshes to walk. An object that is left out is skipped.
struct CandidateSet::GatherObjects {
  CandidateSet& to;
  const SceneObjects& scene;

  void operator()(std::uint32_t place) { take(scene.still_object(place)); }

  void take(std::uint32_t number) {
    if (to.left_out_.has(number)) {
      return;
    }
    const Object& object = scene[number];
    if (object.surface != SurfaceKind::primitive) {
      to.progress_.meshes[to.progress_.mesh_count++] = number;
      return;
    }
    const Capsule& trust = to.trust_.capsule;
    const double reach = to.margins_.of(is_point_tool(object)).reach_m + trust.radius;
    const Primitive& primitive = scene.primitive_W(number);
    const Vec3 middle = to.trust_.middle();
    // A distance field is 1-Lipschitz: a primitive that is farther from the middle than the reach
    // and half the axis is out of reach of the whole capsule.
    if (std::abs(sample(primitive, middle).distance_m) <= reach + 0.5 * trust.axis.norm()) {
      to.add_primitive(object, number, primitive);
    }
  }
};

// The slot may hold an older candidate; only its fields that are read before a measurement are set.
Candidate* CandidateSet::add(const Object& object, std::uint32_t number) {
  if (size_ == kMaxCandidates) {
    progress_.is_full = true;
    return nullptr;
  }
  Candidate& slot = slots_[size_++];
  slot.primitive = nullptr;
  slot.object = number;
  slot.prepared = false;
  slot.one_sided = object.sides == Sides::one;
  slot.point_tool = is_point_tool(object);
  slot.measured_at = 0;
  return &slot;
}

// A primitive is always within reach until it is measured: it has no leaf that gives a bound.
void CandidateSet::add_primitive(const Object& object, std::uint32_t number,
                                 const Primitive& primitive) {
  if (Candidate* const slot = add(object, number); slot != nullptr) {
    slot->primitive = &primitive;
    reach_.bounds().set_none(size_ - 1);
  }
}

// Begins with an empty set: visits the objects near the box about the capsule, adds the primitives
// and lists the meshes.
void CandidateSet::begin_gathering(const SceneObjects& scene, const Capsule& trust) {
  trust_.capsule = trust;
  reach_.bounds().start(trust.start, margins_.sphere.reach_m);
  size_ = 0;
  progress_.clear();
  progress_.tested = 0;
  GatherObjects visitor{.to = *this, .scene = scene};
  const Vec3 middle = trust_.middle();
  const double reach = margins_.sphere.reach_m + trust.radius;
  visit_all_near(scene.still_nodes(), middle, 0.5 * trust.axis.cwiseAbs(), reach, visitor);
  const double half_axis = 0.5 * trust.axis.norm();
  for (const Mover& mover : scene.movers()) {
    if (mover.is_near(middle, reach + half_axis) && meets_proxy(scene[mover.object])) {
      visitor.take(mover.object);
    }
  }
}

// Continues until everything is gathered, the set is full, or the tick's budget is spent.
void CandidateSet::go_on_gathering(const SceneObjects& scene) {
  while (progress_.mesh_count > 0 && !progress_.is_full) {
    walk_mesh(scene, progress_.meshes[progress_.mesh_count - 1]);
    if (progress_.left.count() > 0) {
      return;
    }
    --progress_.mesh_count;
  }
}

// Continues a walk that was interrupted, or begins one at the root. The reach is the capsule's
// radius and the object's own contact margin, and farther by the slack of a hierarchy that deforms.
void CandidateSet::walk_mesh(const SceneObjects& scene, std::uint32_t number) {
  const Object& object = scene[number];
  const Mover* const mover = scene.mover_of(number);
  const PlacedMesh placed = scene.mesh_O(number);
  const Capsule& trust = trust_.capsule;
  const double reach = margins_.of(is_point_tool(object)).reach_m + trust.radius;
  const Vec3 axis = direction_in(mover, trust.axis);
  const Vec3 start = point_in(mover, trust.start);
  const NearBox box(start + 0.5 * axis, 0.5 * axis.cwiseAbs(), reach + placed.slack_m);
  if (progress_.left.count() == 0) {
    begin_walk(placed.mesh.nodes, box, progress_.left);
  }
  GatherTriangles visitor{.to = *this,
                          .object = object,
                          .number = number,
                          .mover = mover,
                          .mesh = placed.mesh,
                          .segment = NearSegment(start, axis, reach),
                          .start = start,
                          .farthest_m = reach + axis.norm()};
  go_on_walking(placed.mesh.nodes, box, progress_.left, visitor);
}

// Ends a complete gathering: the plan learns from it. In free space the capsule gives way to the
// largest ball that is free, if that is larger.
void CandidateSet::end_gathering(const SceneObjects& scene) {
  reach_.bounds().fill_last_four(size_);
  counts_.peak = std::max(counts_.peak, size_);
  auto& [trust, plan] = trust_;
  plan.learn(progress_.tested, counts_.gatherings == counts_.first_of_tick);
  if (size_ == 0) {
    plan.shorten();
    const double ball = free_radius(scene, margins_, trust.start, trust.radius, budget_);
    if (ball > trust.radius) {
      trust = {.start = trust.start, .radius = ball};
    }
  }
}

CandidateSet::Gathering CandidateSet::ensure(const SceneObjects& scene,
                                             const ContactMargins& margins, const Vec3& p) {
  const bool is_valid = !is_begun() && trust_.holds(p);
  return is_valid ? Gathering::complete : gather(scene, margins, p);
}

void CandidateSet::look_ahead(const SceneObjects& scene, const ContactMargins& margins,
                              const Vec3& p, const Vec3& next) {
  // A point meets too few triangles to be late.
  const bool can_gather = !margins.is_point() && budget_.spent() <= kLookAheadBudget &&
                          progress_.may_pause && !is_begun() && progress_.smaller == 0;
  if (can_gather && !trust_.holds(next)) {
    gather(scene, margins, p);
  }
}

// Begins a gathering at p, or goes on with the one that was begun there. A set that is full halves
// the capsule, about the same start, until it would be the kMostSmaller-th time: a capsule of less
// than 1/128 of the planned size is not tried.
CandidateSet::Gathering CandidateSet::gather(const SceneObjects& scene,
                                             const ContactMargins& margins, const Vec3& p) {
  if (!is_begun() || p != trust_.capsule.start) {
    margins_ = margins;
    progress_.smaller = 0;
    const bool again = is_fresh();
    ++counts_.gatherings;
    budget_.spend(kCostOfGathering);
    begin_gathering(scene, trust_.next(p, again));
  }
  for (;;) {
    go_on_gathering(scene);
    if (!progress_.is_full) {
      break;
    }
    counts_.peak = kMaxCandidates;
    trust_.plan.halve();
    if (++progress_.smaller >= kMostSmaller) {
      clear();
      return Gathering::too_many;
    }
    begin_gathering(scene, trust_.half());
  }
  if (is_begun()) {
    return Gathering::begun;
  }
  end_gathering(scene);
  return Gathering::complete;
}

}  // namespace tactus::rendering
