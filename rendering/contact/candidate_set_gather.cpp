// How the candidates are gathered: a capsule is planned, the hierarchies of the meshes near it are
// walked, and every triangle that comes within reach of it becomes a candidate. In a dense place
// that takes more than one tick's work; the proxy waits there meanwhile. Where objects move it does
// not wait: the next tick would have to begin anew.
#include <algorithm>
#include <cmath>

#include "rendering/contact/candidate_set.h"
#include "rendering/contact/free_ball.h"
#include "rendering/geometry/near_segment.h"

namespace tactus::rendering {
namespace {

// The trusted capsule is as long as makes it take about kWantedTests triangles to look at, so that
// a gathering serves many ticks on a coarse mesh and few on a fine one. A sphere at rest looks at
// some 100 already, whatever the length, so a shorter capsule than the least does not pay. These
// numbers were the best of four sets, by the median and the slowest ticks on the sphere of 1.3
// million triangles and the dragon, the tool 2 mm. It grows beyond kLongTrust_m only where it did
// not last for one tick and takes few tests: a tool jumps over a coarse mesh.
constexpr double kLeastTrust_m = 0.2e-3;
constexpr double kMostTrust_m = 16e-3;
constexpr double kWantedTests = 128.0;
constexpr double kFewTests = 24.0;
// Its length is between 4 and 32 radii.
constexpr double kLeastRadius_m = 10e-6;
constexpr double kLeastSlimness = 4.0;
constexpr double kMostSlimness = 32.0;
constexpr double kStraight = 0.8;  // of the length
constexpr double kSlimmer = 1.4;
constexpr double kStouter = 0.7;
// Nearer to the border of the capsule the proxy has left it.
constexpr double kBorder_m = 1e-6;
constexpr std::size_t kLookAheadBudget = kUsualTickBudget / 2;

}  // namespace

// Collects the triangles of one object that come within reach of the trusted way, until there is
// no room, or the tick's work is done. In the object's frame.
struct CandidateSet::GatherTriangles {
  CandidateSet& to;
  const Object& object;
  std::uint32_t number;
  const Mover* mover;
  const MeshView& mesh;
  NearSegment segment;
  const Vec3& start;
  double farthest_m;  // from the start, of what comes within reach of the way

  void boxes(std::uint32_t pairs) { to.budget_.spend(kCostOfBoxPairNear * pairs); }

  void leaf(const BvhNode& leaf) {
    to.tested_ += leaf.triangle_count;
    to.budget_.spend(kCostOfLeafTriangle * leaf.triangle_count);
    segment.find(mesh, leaf.first, leaf.triangle_count,
                 [&](std::uint32_t t, const NearSegment::Bound& bound) { take(t, bound); });
  }
  [[nodiscard]] bool exhausted() const { return to.is_full_ || to.is_budget_spent(); }

  // Of long thin triangles that meet in a point the way sees many that are not near it. Where there
  // was no room for all, each is measured.
  [[nodiscard]] bool is_far(std::uint32_t t) {
    if (to.smaller_ == 0) {
      return false;
    }
    to.budget_.spend(kCostOfMeasurement);
    return triangle_of(mesh, t).nearest(start).distance > farthest_m;
  }

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
    to.store_bound(to.size_ - 1, normal, -static_cast<double>(bound.offset));
  }
};

// Goes over objects: takes primitives, and notes meshes.
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
      to.to_walk_.meshes[to.to_walk_.count++] = number;
      return;
    }
    const Capsule& trust = to.trust_;
    const double reach = to.margins_.of(is_point_tool(object)).reach_m + trust.radius;
    const Primitive& primitive = scene.primitive_W(number);
    const Vec3 middle = trust.start + 0.5 * trust.axis;
    if (std::abs(sample(primitive, middle).distance_m) <= reach + 0.5 * trust.axis.norm()) {
      to.add_primitive(object, number, primitive);
    }
  }
};

Candidate* CandidateSet::add(const Object& object, std::uint32_t number) {
  if (size_ == kMaxCandidates) {
    is_full_ = true;
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

void CandidateSet::add_primitive(const Object& object, std::uint32_t number,
                                 const Primitive& primitive) {
  if (Candidate* const slot = add(object, number); slot != nullptr) {
    slot->primitive = &primitive;
    set_no_bound(size_ - 1);
  }
}

void CandidateSet::begin_gathering(const SceneObjects& scene, const Capsule& trust) {
  trust_ = trust;
  size_ = 0;
  tested_ = 0;
  is_full_ = false;
  to_walk_.count = 0;
  to_walk_.left.clear();
  GatherObjects visitor{.to = *this, .scene = scene};
  const Vec3 middle = trust.start + 0.5 * trust.axis;
  const double reach = margins_.sphere.reach_m + trust.radius;
  visit_all_near(scene.still_nodes(), middle, 0.5 * trust.axis.cwiseAbs(), reach, visitor);
  for (const Mover& mover : scene.movers()) {
    if (meets_proxy(scene[mover.object]) &&
        mover.distance(middle) <= reach + 0.5 * trust.axis.norm()) {
      visitor.take(mover.object);
    }
  }
}

// Until all is gathered, or there is no room, or the tick's work is done.
void CandidateSet::go_on_gathering(const SceneObjects& scene) {
  while (to_walk_.count > 0 && !is_full_) {
    walk_mesh(scene, to_walk_.meshes[to_walk_.count - 1]);
    if (to_walk_.left.count() > 0) {
      return;
    }
    --to_walk_.count;
  }
}

// From where it was left, or from the top.
void CandidateSet::walk_mesh(const SceneObjects& scene, std::uint32_t number) {
  const Object& object = scene[number];
  const Mover* const mover = scene.mover_of(number);
  const PlacedMesh placed = scene.mesh_O(number);
  const double reach = margins_.of(is_point_tool(object)).reach_m + trust_.radius;
  const Vec3 axis = direction_in(mover, trust_.axis);
  const Vec3 start = point_in(mover, trust_.start);
  const NearBox box(start + 0.5 * axis, 0.5 * axis.cwiseAbs(), reach + placed.slack_m);
  if (to_walk_.left.count() == 0) {
    begin_walk(placed.mesh.nodes, box, to_walk_.left);
  }
  GatherTriangles visitor{.to = *this,
                          .object = object,
                          .number = number,
                          .mover = mover,
                          .mesh = placed.mesh,
                          .segment = NearSegment(start, axis, reach),
                          .start = start,
                          .farthest_m = reach + axis.norm()};
  go_on_walking(placed.mesh.nodes, box, to_walk_.left, visitor);
}

void CandidateSet::end_gathering(const SceneObjects& scene) {
  fill_last_four();
  peak_ = std::max(peak_, size_);
  const double tests = 1.0 + static_cast<double>(tested_);
  const double length = wanted_length_m_ * std::clamp(kWantedTests / tests, 0.5, 2.0);
  const bool lasted = gatherings_ == first_gathering_;
  const double sparse = wanted_length_m_ * std::clamp(kFewTests / tests, 0.5, lasted ? 1.0 : 2.0);
  wanted_length_m_ = std::max(std::min(length, kLongTrust_m), sparse);
  if (size_ == 0) {
    wanted_length_m_ = kLeastTrust_m;  // out of free space onto any mesh
    const double ball = free_radius(scene, margins_, trust_.start, trust_.radius, budget_);
    if (ball > trust_.radius) {
      trust_ = {.start = trust_.start, .radius = ball};
    }
  }
}

// The proxy goes on as it came since the last gathering. Where it left the capsule through its
// side, the next is less slim, where it left through the end, slimmer.
Capsule CandidateSet::plan(const Vec3& p) {
  const Vec3 came = p - trust_.start;
  const double distance = came.norm();
  const bool straight = distance > kStraight * wanted_length_m_;
  slimness_ =
      std::clamp(slimness_ * (straight ? kSlimmer : kStouter), kLeastSlimness, kMostSlimness);
  wanted_length_m_ = std::clamp(wanted_length_m_, kLeastTrust_m, kMostTrust_m);
  const double radius = std::max(kLeastRadius_m, wanted_length_m_ / slimness_);
  const bool known = distance > kLeastRadius_m && distance < kMostTrust_m;
  return {.start = p,
          .axis = known ? Vec3{came * (wanted_length_m_ / distance)} : Vec3{Vec3::Zero()},
          .radius = radius};
}

CandidateSet::Gathering CandidateSet::ensure(const SceneObjects& scene,
                                             const ContactMargins& margins, const Vec3& p) {
  const bool is_valid = !is_begun() && trust_.depth(p) >= kBorder_m;
  return is_valid ? Gathering::complete : gather(scene, margins, p);
}

void CandidateSet::look_ahead(const SceneObjects& scene, const ContactMargins& margins,
                              const Vec3& p, const Vec3& next) {
  // A point meets too few triangles to be late.
  const bool can_gather = !margins.is_point() && budget_.spent() <= kLookAheadBudget &&
                          may_pause_ && !is_begun() && smaller_ == 0;
  if (can_gather && trust_.depth(next) < kBorder_m) {
    gather(scene, margins, p);
  }
}

CandidateSet::Gathering CandidateSet::gather(const SceneObjects& scene,
                                             const ContactMargins& margins, const Vec3& p) {
  if (!is_begun() || p != trust_.start) {
    margins_ = margins;
    smaller_ = 0;
    ++gatherings_;
    budget_.spend(kCostOfGathering);
    begin_gathering(scene, plan(p));
  }
  for (;;) {
    go_on_gathering(scene);
    if (!is_full_) {
      break;
    }
    peak_ = kMaxCandidates;
    wanted_length_m_ *= 0.5;
    if (++smaller_ >= kMostSmaller) {
      clear();
      return Gathering::too_many;
    }
    begin_gathering(
        scene, {.start = trust_.start, .axis = 0.5 * trust_.axis, .radius = 0.5 * trust_.radius});
  }
  if (is_begun()) {
    return Gathering::begun;
  }
  end_gathering(scene);
  return smaller_ == 0 ? Gathering::complete : Gathering::smaller;
}

}  // namespace tactus::rendering
