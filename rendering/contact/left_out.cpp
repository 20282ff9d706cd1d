// Finds whether a surface of an object is nearer to the proxy than a distance. The search through a
// mesh ends at the first such triangle. A search that runs out of budget answers yes: an object in
// doubt is left out, or stays left out, since the proxy must never be pushed by an object inside
// which it may be.
#include "rendering/contact/left_out.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "rendering/geometry/hierarchy_query.h"
#include "rendering/tick_budget.h"

namespace tactus::rendering {
namespace {

// Searches a triangle of a mesh that is nearer to p_O than distance_m. It is a visitor of
// visit_near().
struct NearTriangle {
  const MeshView& mesh;
  const Vec3& p_O;
  double distance_m;
  // The slack of a hierarchy that deforms: searches reach farther by it, m.
  double slack_m;
  std::size_t& cost_left;
  bool found = false;

  [[nodiscard]] double reach() const { return found ? 0.0 : distance_m + slack_m; }
  void boxes(std::uint32_t pairs) { take(kCostOfBoxPairInBall * pairs); }
  void operator()(std::uint32_t t) {
    if (found) {
      return;
    }
    take(kCostOfMeasurement);
    found = found || triangle_of(mesh, t).nearest(p_O).distance < distance_m;
  }
  // Charges the cost; a search that runs out of budget counts as found.
  void take(std::size_t units) {
    cost_left -= std::min(cost_left, units);
    found = found || cost_left == 0;
  }
};

// Returns true if a surface of the object is nearer to p_W than distance_m. World frame, m.
bool is_nearer(const SceneObjects& scene, std::uint32_t number, const Vec3& p_W, double distance_m,
               std::size_t& cost_left) {
  if (distance_m <= 0.0) {
    return false;
  }
  if (scene[number].surface == SurfaceKind::primitive) {
    return std::abs(sample(scene.primitive_W(number), p_W).distance_m) < distance_m;
  }
  const PlacedMesh placed = scene.mesh_O(number);
  const Vec3 p_O = point_in(scene.mover_of(number), p_W);
  NearTriangle visitor{.mesh = placed.mesh,
                       .p_O = p_O,
                       .distance_m = distance_m,
                       .slack_m = placed.slack_m,
                       .cost_left = cost_left};
  visit_near(placed.mesh.nodes, p_O, visitor);
  return visitor.found;
}

// Visits objects and adds those that overlap the sphere.
struct FindOverlapped {
  LeftOut& to;
  const SceneObjects& scene;
  const ContactMargins& margins;
  const Vec3& p_W;
  double slack_m;
  std::size_t cost_left = kMaxCarryBudget;
  bool added = false;

  [[nodiscard]] double reach() const { return margins.sphere.reach_m; }
  void operator()(std::uint32_t place) { take(scene.still_object(place)); }
  void take(std::uint32_t number) {
    const double inner_m = margins.of(is_point_tool(scene[number])).inner_m;
    if (!to.has(number) && is_nearer(scene, number, p_W, inner_m - slack_m, cost_left)) {
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

bool LeftOut::add_overlapped(const SceneObjects& scene, const ContactMargins& margins,
                             const Vec3& p_W, double slack_m) {
  FindOverlapped visitor{
      .to = *this, .scene = scene, .margins = margins, .p_W = p_W, .slack_m = slack_m};
  visit_near(scene.still_nodes(), p_W, visitor);
  for (const Mover& mover : scene.movers()) {
    if (mover.is_near(p_W, visitor.reach()) && meets_proxy(scene[mover.object])) {
      visitor.take(mover.object);
    }
  }
  return visitor.added;
}

bool LeftOut::take_back(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p_W) {
  std::size_t cost_left = kMaxCarryBudget;
  bool taken = false;
  for (std::uint32_t number = 0; number < scene.size() && any(); ++number) {
    if (!has(number)) {
      continue;
    }
    const double reach_m = margins.of(is_point_tool(scene[number])).reach_m;
    if (!is_nearer(scene, number, p_W, reach_m, cost_left)) {
      bits_[number / kBits] &= ~(std::uint64_t{1} << (number % kBits));
      --count_;
      taken = true;
    }
  }
  return taken;
}

void LeftOut::transfer(StateArchive& archive, std::size_t objects) {
  if (archive.is_reading()) {
    bits_.fill(0);
    count_ = 0;
  }
  for (std::uint64_t& bits : std::span(bits_).first((objects + kBits - 1) / kBits)) {
    archive(bits);
  }
  if (archive.is_reading()) {
    for (const std::uint64_t bits : bits_) {
      count_ += static_cast<std::uint32_t>(std::popcount(bits));
    }
  }
}

}  // namespace tactus::rendering
