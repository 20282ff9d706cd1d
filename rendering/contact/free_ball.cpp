// The search measures boxes of triangles and not the triangles: a box is never farther than what it
// holds, and its distance takes a few comparisons. It is content with a ball of half the possible
// radius, so it prunes the hierarchy by half of the nearest distance so far.
#include "rendering/contact/free_ball.h"

#include <algorithm>
#include <cmath>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// Limits the radius of the ball in free space.
constexpr double kMostClearance_m = 0.1;

// Accepts a ball of half the possible radius, which is found at a fraction of the cost.
constexpr double kEasyPart = 0.5;

// Limits the triangles to look at. In a hollow many are about equally near, and the ball does not
// pay.
constexpr int kMostLookedAt = 48;

// Visits the triangles near p and shrinks the radius to the distance of a box that is the nearest,
// or at most 1 / kEasyPart as far. The radius becomes 0 if it is below `least` or is not found
// soon.
struct ClearanceVisitor {
  const Vec3& p;
  TickBudget& budget;
  // The distance of the nearest box so far and the least radius that is of use, m, both before the
  // share kEasyPart is taken.
  double nearest;
  double least;
  const MeshView* mesh = nullptr;
  // The slack of a hierarchy that deforms: searches reach farther by it, m.
  double slack_m = 0.0;
  int looked_at = 0;

  [[nodiscard]] double reach() const { return nearest > 0.0 ? kEasyPart * nearest + slack_m : 0.0; }
  void boxes(std::uint32_t pairs) { budget.spend(kCostOfBoxPairInBall * pairs); }
  void operator()(std::uint32_t t) {
    budget.spend(kCostOfLeafTriangle);
    nearest = std::min(nearest, offset_from_box(*mesh, t, p).norm());
    if (nearest < least || ++looked_at == kMostLookedAt) {
      nearest = 0.0;
    }
  }
};

// Visits objects and shrinks the radius to what is certainly free about p, beyond the contact
// margin's reach.
struct FreeBall {
  const SceneObjects& scene;
  const ContactMargins& margins;
  const Vec3& p;
  TickBudget& budget;
  double least;
  // The radius that is free so far, m; the search gives up below `least`.
  double free;

  [[nodiscard]] double reach() const { return std::max(0.0, free) + margins.sphere.reach_m; }
  void operator()(std::uint32_t place) { take(scene.still_object(place)); }

  void take(std::uint32_t number) {
    if (free < least) {
      return;
    }
    const Object& object = scene[number];
    const double own_reach = margins.of(is_point_tool(object)).reach_m;
    if (object.surface == SurfaceKind::primitive) {
      const double distance = std::abs(sample(scene.primitive_W(number), p).distance_m);
      free = std::min(free, distance - own_reach);
      return;
    }
    const Vec3 p_O = point_in(scene.mover_of(number), p);
    const PlacedMesh placed = scene.mesh_O(number);
    ClearanceVisitor visitor{.p = p_O,
                             .budget = budget,
                             .nearest = (free + own_reach) / kEasyPart,
                             .least = (least + own_reach) / kEasyPart,
                             .mesh = &placed.mesh,
                             .slack_m = placed.slack_m};
    visit_near(placed.mesh.nodes, p_O, visitor);
    free = kEasyPart * visitor.nearest - own_reach;
  }
};

}  // namespace

double free_radius(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p,
                   double least_m, TickBudget& budget) {
  FreeBall ball{.scene = scene,
                .margins = margins,
                .p = p,
                .budget = budget,
                .least = least_m,
                .free = kMostClearance_m};
  visit_near(scene.still_nodes(), p, ball);
  for (const Mover& mover : scene.movers()) {
    if (mover.is_near(p, ball.reach()) && meets_proxy(scene[mover.object])) {
      ball.take(mover.object);
    }
  }
  return ball.free;
}

}  // namespace tactus::rendering
