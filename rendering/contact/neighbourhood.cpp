#include "rendering/contact/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rendering/contact/free_ball.h"
#include "rendering/geometry/hierarchy_query.h"
#include "rendering/geometry/near_way.h"

namespace tactus::rendering {
namespace {

// The trusted capsule is as long as makes it take about kWantedTests triangles to look at, so that
// a gathering serves many ticks on a coarse mesh and few on a fine one. A sphere at rest looks at
// some 100 already, whatever the length, so a shorter capsule than the least does not pay. These
// numbers were the best of four sets, by the median and the slowest ticks on the sphere of 1.3
// million triangles and the dragon, the tool 2 mm.
constexpr double kLeastTrust_m = 0.2e-3;
constexpr double kMostTrust_m = 2e-3;
constexpr double kWantedTests = 128.0;
// Its length is between 4 and 32 radii.
constexpr double kLeastRadius_m = 10e-6;
constexpr double kLeastSlimness = 4.0;
constexpr double kMostSlimness = 32.0;
constexpr double kStraight = 0.8;  // of the length
constexpr double kSlimmer = 1.4;
constexpr double kStouter = 0.7;

}  // namespace

// Collects the triangles of one object that come within reach of the trusted way; stops collecting,
// and says so, when there is no room. In the object's frame.
struct Neighbourhood::GatherTriangles {
  Neighbourhood& to;
  const Object& object;
  std::uint32_t number;
  const Mover* mover;
  const MeshView& mesh;
  NearWay way;
  std::size_t tested = 0;
  bool complete = true;

  void leaf(const BvhNode& leaf) {
    tested += leaf.triangle_count;
    way.find(mesh, leaf.first, leaf.triangle_count,
             [&](std::uint32_t t, const NearWay::Bound& bound) { take(t, bound); });
  }

  void take(std::uint32_t t, const NearWay::Bound& bound) {
    Candidate* const slot = complete ? to.add(object, number) : nullptr;
    if (slot == nullptr) {
      complete = false;
      return;
    }
    slot->index = t;
    to.set_bound(to.size_ - 1, direction_from(mover, to_vec3(bound.normal)),
                 -static_cast<double>(bound.offset), to.trust_.start);
  }
};

// Goes over objects.
struct Neighbourhood::Gather {
  Neighbourhood& to;
  const Scenery& scenery;
  std::size_t tested = 0;  // triangles
  bool complete = true;

  void operator()(std::uint32_t place) { take(scenery.still_object(place)); }

  void take(std::uint32_t number) {
    const Object& object = scenery[number];
    const Capsule& trust = to.trust_;
    const double reach = to.shells_.of(is_point_tool(object)).reach_m + trust.radius;
    if (object.surface == SurfaceKind::primitive) {
      const Primitive& primitive = scenery.primitive_W(number);
      const Vec3 middle = trust.start + 0.5 * trust.way;
      if (std::abs(sample(primitive, middle).distance_m) <= reach + 0.5 * trust.way.norm()) {
        complete = complete && to.add_primitive(object, number, primitive);
      }
      return;
    }
    const Mover* const mover = scenery.mover_of(number);
    const PlacedMesh placed = scenery.mesh_O(number);
    const Vec3 way = direction_in(mover, trust.way);
    const Vec3 start = point_in(mover, trust.start);
    GatherTriangles visitor{.to = to,
                            .object = object,
                            .number = number,
                            .mover = mover,
                            .mesh = placed.mesh,
                            .way = NearWay(start, way, reach)};
    visit_all_near(placed.mesh.nodes, start + 0.5 * way, 0.5 * way.cwiseAbs(),
                   reach + placed.slack_m, visitor);
    tested += visitor.tested;
    complete = complete && visitor.complete;
  }
};

Candidate* Neighbourhood::add(const Object& object, std::uint32_t number) {
  if (size_ == kMaxCandidates) {
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

bool Neighbourhood::add_primitive(const Object& object, std::uint32_t number,
                                  const Primitive& primitive) {
  Candidate* const slot = add(object, number);
  if (slot == nullptr) {
    return false;
  }
  slot->primitive = &primitive;
  set_no_bound(size_ - 1);
  return true;
}

bool Neighbourhood::gather(const Scenery& scenery, const Shells& shells, const Capsule& trust) {
  size_ = 0;
  ++gatherings_;
  trust_ = trust;
  shells_ = shells;
  Gather visitor{.to = *this, .scenery = scenery};
  const Vec3 middle = trust.start + 0.5 * trust.way;
  const double reach = shells.sphere.reach_m + trust.radius;
  visit_all_near(scenery.still_nodes(), middle, 0.5 * trust.way.cwiseAbs(), reach, visitor);
  for (const Mover& mover : scenery.movers()) {
    if (meets_proxy(scenery[mover.object]) &&
        mover.distance(middle) <= reach + 0.5 * trust.way.norm()) {
      visitor.take(mover.object);
    }
  }
  fill_last_four();
  tested_ = visitor.tested;
  work_ += work_to_gather();
  peak_ = std::max(peak_, size_);
  if (!visitor.complete) {
    clear();
  }
  return visitor.complete;
}

void Neighbourhood::begin_tick(const Scenery& scenery) {
  if (!scenery.anything_moved() || trust_.radius < 0.0) {
    return;
  }
  const Vec3 middle = trust_.start + 0.5 * trust_.way;
  const double reach = trust_.radius + 0.5 * trust_.way.norm() + shells_.sphere.reach_m;
  const bool disturbed = std::ranges::any_of(scenery.movers(), [&](const Mover& mover) {
    return mover.moved &&
           (mover.distance(middle) <= reach || mover.distance_before(middle) <= reach);
  });
  if (disturbed) {
    clear();
  }
}

// The proxy goes on as it came since the last gathering. Where it left the capsule through its
// side, the next is less slim, where it left through the end, slimmer.
Capsule Neighbourhood::plan(const Vec3& p) {
  const Vec3 came = p - trust_.start;
  const double distance = came.norm();
  const bool straight = distance > kStraight * wanted_length_m_;
  slimness_ =
      std::clamp(slimness_ * (straight ? kSlimmer : kStouter), kLeastSlimness, kMostSlimness);
  wanted_length_m_ = std::clamp(wanted_length_m_, kLeastTrust_m, kMostTrust_m);
  const double radius = std::max(kLeastRadius_m, wanted_length_m_ / slimness_);
  const bool known = distance > kLeastRadius_m && distance < kMostTrust_m;
  return {.start = p,
          .way = known ? Vec3{came * (wanted_length_m_ / distance)} : Vec3{Vec3::Zero()},
          .radius = radius};
}

bool Neighbourhood::ensure(const Scenery& scenery, const Shells& shells, const Vec3& p) {
  constexpr double kBorder_m = 1e-6;
  if (trust_from(p) >= kBorder_m) {
    return true;
  }
  constexpr int kShrinkings = 8;
  Capsule trust = plan(p);
  for (int k = 0; k < kShrinkings; ++k) {
    if (gather(scenery, shells, trust)) {
      wanted_length_m_ *= std::clamp(kWantedTests / (1.0 + static_cast<double>(tested_)), 0.5, 2.0);
      if (size_ == 0) {
        wanted_length_m_ = kLeastTrust_m;  // out of free space onto any mesh
        const double ball = free_radius(scenery, shells, p);
        if (ball > trust.radius) {
          trust_ = {.start = p, .radius = ball};
        }
      }
      return k == 0;
    }
    trust.way *= 0.5;
    trust.radius *= 0.5;
    wanted_length_m_ *= 0.5;
  }
  return false;
}

// Floats are four to a vector; what they round off is far less than the shell is thick. Heights
// count from the reach of the sphere, whoever the candidate's object takes for the tool.
void Neighbourhood::set_bound(std::size_t i, const Vec3& normal, double distance,
                              const Vec3& from) {
  const double nearer = shells_.sphere.reach_m - shells_.of(slots_[i].point_tool).reach_m;
  normal_x_[i] = static_cast<float>(normal.x());
  normal_y_[i] = static_cast<float>(normal.y());
  normal_z_[i] = static_cast<float>(normal.z());
  height_[i] = static_cast<float>(distance + nearer - normal.dot(from - trust_.start));
}

// Always measured.
void Neighbourhood::set_no_bound(std::size_t i) {
  normal_x_[i] = normal_y_[i] = normal_z_[i] = 0.0F;
  height_[i] = -1.0F;
}

void Neighbourhood::fill_last_four() {
  for (std::size_t i = size_; i % 4 != 0; ++i) {
    normal_x_[i] = normal_y_[i] = normal_z_[i] = 0.0F;
    height_[i] = std::numeric_limits<float>::infinity();
  }
}

Neighbourhood::Bounded::Bounded(const Neighbourhood& of, const Vec3& p)
    : x(static_cast<float>(p.x() - of.trust_.start.x())),
      y(static_cast<float>(p.y() - of.trust_.start.y())),
      z(static_cast<float>(p.z() - of.trust_.start.z())) {
  constexpr float kRounding = 1e-6F;  // of the largest length involved
  const auto reach = static_cast<float>(of.shells_.sphere.reach_m);
  most = reach + kRounding * (reach + std::abs(x) + std::abs(y) + std::abs(z));
}

void Neighbourhood::Within::find(const Neighbourhood& of, const Vec3& p) {
  static_assert(kMaxCandidates % 4 == 0);
  const Bounded at(of, p);
  const Floats most = all(at.most);
  count = 0;
  for (std::size_t first = 0; first < of.size_; first += 4) {
    const Floats bound = floats_at(&of.normal_x_[first]) * at.x +
                         floats_at(&of.normal_y_[first]) * at.y +
                         floats_at(&of.normal_z_[first]) * at.z + floats_at(&of.height_[first]);
    const Integers near = bound <= most;
    if (!any(near)) {
      continue;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      number[count] = static_cast<std::uint16_t>(first + k);
      count += near[k] != 0 ? 1U : 0U;
    }
  }
}

std::span<const std::uint16_t> Neighbourhood::within_reach_here() {
  if (here_place_ != places_ || here_gathering_ != gatherings_) {
    here_.find(*this, place_);
    here_place_ = places_;
    here_gathering_ = gatherings_;
  }
  return here_.numbers();
}

std::span<const std::uint16_t> Neighbourhood::within_reach(const Vec3& p) {
  there_.find(*this, p);
  return there_.numbers();
}

const Nearest& Neighbourhood::nearest(std::size_t i, const Scenery& scenery) {
  Candidate& slot = slots_[i];
  if (slot.measured_at == places_) {
    return slot.nearest;
  }
  slot.measured_at = places_;
  ++work_;
  if (slot.primitive != nullptr) {
    measure_primitive(i);
    return slot.nearest;
  }
  if (!slot.prepared) {
    slot.triangle = triangle_W(scenery, slot.object, slot.index);
    slot.prepared = true;
  }
  // On a border the height is rounding where the sphere stands beside the triangle; its neighbour
  // across the border, or this one, must hold the sphere, so a nanometre behind still counts as in
  // front. On a face it does not: that is the far side.
  constexpr double kBesideBorder_m = -1e-9;
  slot.nearest = slot.triangle.nearest(place_);
  slot.behind =
      slot.one_sided && slot.triangle.height(place_) <
                            (slot.nearest.feature == Feature::face ? 0.0 : kBesideBorder_m);
  set_bound(i, slot.nearest.normal, slot.nearest.distance, place_);
  return slot.nearest;
}

// Only of a convex solid, from outside, is the distance convex.
void Neighbourhood::measure_primitive(std::size_t i) {
  Candidate& slot = slots_[i];
  slot.seen = sample(*slot.primitive, place_);
  const bool inside = slot.seen.distance_m < 0.0;
  slot.behind = slot.one_sided && inside;
  slot.nearest = {.distance = std::abs(slot.seen.distance_m),
                  .normal = inside ? Vec3{-slot.seen.normal_W} : slot.seen.normal_W};
  if (!inside && convex(*slot.primitive)) {
    set_bound(i, slot.nearest.normal, slot.nearest.distance, place_);
  } else {
    set_no_bound(i);
  }
}

}  // namespace tactus::rendering
