#include "rendering/contact/neighbourhood.h"

#include <algorithm>
#include <cmath>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// The trust ball is as wide as makes it hold about kWantedCandidates, so that a gathering serves
// many ticks on a coarse mesh and few on a fine one.
constexpr double kLeastTrust_m = 50e-6;
constexpr double kMostTrust_m = 1e-3;
constexpr double kWantedCandidates = 128.0;
// In free space the ball reaches to the surface, but no farther than this.
constexpr double kMostClearance_m = 0.1;
// Two triangles put into the candidates cost about as much as one measured.
constexpr std::size_t kGatheredPerWork = 2;

// From the nearest point of the triangle's box to p.
Vec3 offset_from_box(const MeshView& mesh, std::uint32_t t, const Vec3& p) {
  const TriangleIndices& corners = mesh.triangles[t];
  const Float3& a = mesh.vertices[corners[0]];
  const Float3& b = mesh.vertices[corners[1]];
  const Float3& c = mesh.vertices[corners[2]];
  const auto axis = [](float u, float v, float w, double x) {
    const auto lower = static_cast<double>(std::min({u, v, w}));
    const auto upper = static_cast<double>(std::max({u, v, w}));
    return std::max(x - upper, 0.0) - std::max(lower - x, 0.0);
  };
  return {axis(a.x, b.x, c.x, p.x()), axis(a.y, b.y, c.y, p.y()), axis(a.z, b.z, c.z, p.z())};
}

// In free space a ball half as large as could be is found at a fraction of the cost.
constexpr double kEasyPart = 0.5;

// Shrinks to the distance of a triangle's box that is the nearest or at most 1 / kEasyPart as far.
struct Clearance {
  const Vec3& p;
  double nearest;
  const MeshView* mesh = nullptr;
  double slack_m = 0.0;

  [[nodiscard]] double reach() const { return kEasyPart * nearest + slack_m; }
  void operator()(std::uint32_t t) {
    nearest = std::min(nearest, offset_from_box(*mesh, t, p).norm());
  }
};

// Shrinks to what is certainly free about p beyond the reach of the proxy. Goes over objects.
struct FreeBall {
  const Scenery& scenery;
  const Shells& shells;
  const Vec3& p;
  double free;

  [[nodiscard]] double reach() const { return free + shells.sphere.reach_m; }
  void operator()(std::uint32_t place) { take(scenery.still_object(place)); }

  void take(std::uint32_t number) {
    const Object& object = scenery[number];
    const double own_reach = shells.of(is_point_tool(object)).reach_m;
    if (object.surface == SurfaceKind::primitive) {
      const double distance = std::abs(sample(scenery.primitive_W(number), p).distance_m);
      free = std::min(free, distance - own_reach);
      return;
    }
    const Mover* const mover = scenery.mover_of(number);
    const Vec3 p_O = mover == nullptr ? p : mover->X_WO.point_in(p);
    const PlacedMesh placed = scenery.mesh_O(number);
    Clearance visitor{.p = p_O,
                      .nearest = (free + own_reach) / kEasyPart,
                      .mesh = &placed.mesh,
                      .slack_m = placed.slack_m};
    visit_near(placed.mesh.nodes, p_O, visitor);
    free = kEasyPart * visitor.nearest - own_reach;
  }
};

// No surface that the proxy minds is nearer to p than this, beyond its reach.
double clearance(const Scenery& scenery, const Shells& shells, const Vec3& p) {
  FreeBall ball{.scenery = scenery, .shells = shells, .p = p, .free = kMostClearance_m};
  visit_near(scenery.still_nodes(), p, ball);
  for (const Mover& mover : scenery.movers()) {
    if (meets_proxy(scenery[mover.object]) && mover.distance(p) <= ball.reach()) {
      ball.take(mover.object);
    }
  }
  return ball.free;
}

}  // namespace

// Collects the triangles of one object within a fixed reach; stops collecting, and says so, when
// there is no room.
struct Neighbourhood::GatherTriangles {
  Neighbourhood& to;
  const Object& object;
  std::uint32_t number;
  const Mover* mover;
  PlacedMesh placed;
  Vec3 p_O;
  double reach_m;
  bool complete = true;

  [[nodiscard]] double reach() const { return complete ? reach_m + placed.slack_m : 0.0; }
  void operator()(std::uint32_t t) {
    const Vec3 offset = offset_from_box(placed.mesh, t, p_O);
    const double squared = offset.squaredNorm();
    if (squared > reach_m * reach_m) {
      return;
    }
    Candidate* const slot = to.add(object, number);
    if (slot == nullptr) {
      complete = false;
      return;
    }
    slot->index = t;
    const double distance = std::sqrt(squared);
    const Vec3 normal = distance > 0.0 ? Vec3{offset / distance} : Vec3{Vec3::Zero()};
    to.set_bound(to.size_ - 1, mover == nullptr ? normal : mover->X_WO.direction(normal), distance,
                 to.centre_);
  }
};

// Goes over objects.
struct Neighbourhood::Gather {
  Neighbourhood& to;
  const Scenery& scenery;
  double trust_m;
  bool complete = true;

  [[nodiscard]] double reach() const {
    return complete ? to.shells_.sphere.reach_m + trust_m : 0.0;
  }
  void operator()(std::uint32_t place) { take(scenery.still_object(place)); }

  void take(std::uint32_t number) {
    const Object& object = scenery[number];
    const double reach = to.shells_.of(is_point_tool(object)).reach_m + trust_m;
    if (object.surface == SurfaceKind::primitive) {
      const Primitive& primitive = scenery.primitive_W(number);
      if (std::abs(sample(primitive, to.centre_).distance_m) <= reach) {
        complete = complete && to.add_primitive(object, number, primitive);
      }
      return;
    }
    const Mover* const mover = scenery.mover_of(number);
    GatherTriangles visitor{.to = to,
                            .object = object,
                            .number = number,
                            .mover = mover,
                            .placed = scenery.mesh_O(number),
                            .p_O = mover == nullptr ? to.centre_ : mover->X_WO.point_in(to.centre_),
                            .reach_m = reach};
    visit_near(visitor.placed.mesh.nodes, visitor.p_O, visitor);
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

bool Neighbourhood::gather(const Scenery& scenery, const Shells& shells, const Vec3& p,
                           double trust) {
  size_ = 0;
  ++gatherings_;
  centre_ = p;
  shells_ = shells;
  Gather visitor{.to = *this, .scenery = scenery, .trust_m = trust};
  visit_near(scenery.still_nodes(), p, visitor);
  for (const Mover& mover : scenery.movers()) {
    if (meets_proxy(scenery[mover.object]) && mover.distance(p) <= visitor.reach()) {
      visitor.take(mover.object);
    }
  }
  work_ += size_ / kGatheredPerWork;
  peak_ = std::max(peak_, size_);
  trust_m_ = visitor.complete ? trust : -1.0;
  return visitor.complete;
}

void Neighbourhood::begin_tick(const Scenery& scenery) {
  if (!scenery.anything_moved() || trust_m_ < 0.0) {
    return;
  }
  const double reach = trust_m_ + shells_.sphere.reach_m;
  const bool disturbed = std::ranges::any_of(scenery.movers(), [&](const Mover& mover) {
    return mover.moved &&
           (mover.distance(centre_) <= reach || mover.distance_before(centre_) <= reach);
  });
  if (disturbed) {
    clear();
  }
}

bool Neighbourhood::ensure(const Scenery& scenery, const Shells& shells, const Vec3& p) {
  constexpr double kBorder_m = 1e-6;
  if (trust_from(p) >= kBorder_m) {
    return true;
  }
  constexpr int kShrinkings = 8;
  wanted_trust_m_ = std::clamp(wanted_trust_m_, kLeastTrust_m, kMostTrust_m);
  double trust = wanted_trust_m_;
  for (int k = 0; k < kShrinkings; ++k, trust *= 0.5) {
    if (gather(scenery, shells, p, trust)) {
      wanted_trust_m_ =
          trust * std::clamp(kWantedCandidates / (1.0 + static_cast<double>(size_)), 0.5, 2.0);
      if (size_ == 0) {
        trust_m_ = std::max(trust, clearance(scenery, shells, p));
      }
      return k == 0;
    }
  }
  clear();
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
  height_[i] = static_cast<float>(distance + nearer - normal.dot(from - centre_));
}

// Always measured.
void Neighbourhood::set_no_bound(std::size_t i) {
  normal_x_[i] = normal_y_[i] = normal_z_[i] = 0.0F;
  height_[i] = -1.0F;
}

void Neighbourhood::Within::find(const Neighbourhood& of, const Vec3& p) {
  constexpr float kRounding = 1e-6F;  // of the largest length involved
  constexpr std::size_t kBlock = 16;
  static_assert(kMaxCandidates % kBlock == 0);
  const auto x = static_cast<float>(p.x() - of.centre_.x());
  const auto y = static_cast<float>(p.y() - of.centre_.y());
  const auto z = static_cast<float>(p.z() - of.centre_.z());
  const auto reach = static_cast<float>(of.shells_.sphere.reach_m);
  const float most = reach + kRounding * (reach + std::abs(x) + std::abs(y) + std::abs(z));
  count = 0;
  std::array<float, kBlock> bound;
  for (std::size_t first = 0; first < of.size_; first += kBlock) {
    int any = 0;
    for (std::size_t k = 0; k < kBlock; ++k) {
      const std::size_t i = first + k;
      bound[k] = of.normal_x_[i] * x + of.normal_y_[i] * y + of.normal_z_[i] * z + of.height_[i];
      any |= bound[k] <= most ? 1 : 0;
    }
    if (any == 0) {
      continue;
    }
    const std::size_t end = std::min(kBlock, of.size_ - first);
    for (std::size_t k = 0; k < end; ++k) {
      number[count] = static_cast<std::uint16_t>(first + k);
      count += bound[k] <= most ? 1U : 0U;
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
