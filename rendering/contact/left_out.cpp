#include "rendering/contact/left_out.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "rendering/contact/work.h"
#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// Looks for a triangle of a mesh that is nearer to p_O than distance_m.
struct NearTriangle {
  const MeshView& mesh;
  const Vec3& p_O;
  double distance_m;
  double slack_m;  // that searches reach farther
  std::size_t& room;
  bool found = false;

  [[nodiscard]] double reach() const { return found ? 0.0 : distance_m + slack_m; }
  void boxes(std::uint32_t pairs) { take(kWorkOfBoxesAbout * pairs); }
  void operator()(std::uint32_t t) {
    if (found) {
      return;
    }
    take(kWorkOfAMeasurement);
    found = found || triangle_of(mesh, t).nearest(p_O).distance < distance_m;
  }
  // Without room it is as if one were found.
  void take(std::size_t units) {
    room -= std::min(room, units);
    found = found || room == 0;
  }
};

bool is_nearer(const Scenery& scenery, std::uint32_t number, const Vec3& p_W, double distance_m,
               std::size_t& room) {
  if (distance_m <= 0.0) {
    return false;
  }
  if (scenery[number].surface == SurfaceKind::primitive) {
    return std::abs(sample(scenery.primitive_W(number), p_W).distance_m) < distance_m;
  }
  const PlacedMesh placed = scenery.mesh_O(number);
  const Vec3 p_O = point_in(scenery.mover_of(number), p_W);
  NearTriangle visitor{.mesh = placed.mesh,
                       .p_O = p_O,
                       .distance_m = distance_m,
                       .slack_m = placed.slack_m,
                       .room = room};
  visit_near(placed.mesh.nodes, p_O, visitor);
  return visitor.found;
}

// Goes over objects.
struct FindOverlapped {
  LeftOut& to;
  const Scenery& scenery;
  const Shells& shells;
  const Vec3& p_W;
  double slack_m;
  std::size_t room = kMaxCarryWork;
  bool added = false;

  [[nodiscard]] double reach() const { return shells.sphere.reach_m; }
  void operator()(std::uint32_t place) { take(scenery.still_object(place)); }
  void take(std::uint32_t number) {
    const double inner_m = shells.of(is_point_tool(scenery[number])).inner_m;
    if (!to.has(number) && is_nearer(scenery, number, p_W, inner_m - slack_m, room)) {
      added = to.add(number) || added;
    }
  }
};

}  // namespace

bool LeftOut::add(std::uint32_t object) {
  if (has(object)) {
    return false;
  }
  bits_[object / kBits] |= std::uint64_t{1} << (object % kBits);
  ++count_;
  return true;
}

bool LeftOut::add_overlapped(const Scenery& scenery, const Shells& shells, const Vec3& p_W,
                             double slack_m) {
  FindOverlapped visitor{
      .to = *this, .scenery = scenery, .shells = shells, .p_W = p_W, .slack_m = slack_m};
  visit_near(scenery.still_nodes(), p_W, visitor);
  for (const Mover& mover : scenery.movers()) {
    if (meets_proxy(scenery[mover.object]) && mover.distance(p_W) <= visitor.reach()) {
      visitor.take(mover.object);
    }
  }
  return visitor.added;
}

bool LeftOut::take_back(const Scenery& scenery, const Shells& shells, const Vec3& p_W) {
  std::size_t room = kMaxCarryWork;
  bool taken = false;
  for (std::uint32_t number = 0; number < scenery.size() && any(); ++number) {
    if (!has(number)) {
      continue;
    }
    const double reach_m = shells.of(is_point_tool(scenery[number])).reach_m;
    if (!is_nearer(scenery, number, p_W, reach_m, room)) {
      bits_[number / kBits] &= ~(std::uint64_t{1} << (number % kBits));
      --count_;
      taken = true;
    }
  }
  return taken;
}

void LeftOut::transfer(StateArchive& archive) {
  archive(bits_);
  if (archive.is_reading()) {
    count_ = 0;
    for (const std::uint64_t bits : bits_) {
      count_ += static_cast<std::uint32_t>(std::popcount(bits));
    }
  }
}

}  // namespace tactus::rendering
