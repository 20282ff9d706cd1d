#include "rendering/bodies/solid_meeting.h"

#include "rendering/bodies/buried_contact.h"

namespace tactus::rendering {
namespace {

// Returns the pose of a frame, seen from another one.
RigidPose seen_from(const RigidPose& X_WO, const RigidPose& X_WB) {
  return {.rotation = X_WO.rotation.transpose() * X_WB.rotation,
          .translation = X_WO.point_in(X_WB.translation)};
}

// Returns a manifold of a frame as one of the world.
Manifold in_world(Manifold manifold, const RigidPose& X_WO) {
  manifold.normal_W = X_WO.direction(manifold.normal_W);
  for (ManifoldPoint& point : std::span(manifold.points).first(manifold.count)) {
    point.point_W = X_WO.point(point.point_W);
  }
  return manifold;
}

}  // namespace

// A solid of one part is met as a whole. The contacts of parts are joined.
std::span<const Manifold> SolidMeeting::find(const SolidList& solids, const SolidHulls& hulls,
                                             std::uint16_t a, std::uint16_t b, double margin_m) {
  found_.clear();
  left_out_ = false;
  const Parts parts_a = hulls.parts_of(solids, a);
  const Parts parts_b = hulls.parts_of(solids, b);
  const bool are_whole = parts_a.size() + parts_b.size() == 2;
  if (solids.has_hull(a)) {
    if (are_whole) {
      found_.append(manifold_of(hulls.whole(a), hulls.whole(b), margin_m));
    } else if (!are_apart(hulls.whole(a), hulls.whole(b), margin_m)) {
      join_parts(parts_a, parts_b, hulls.whole(a), margin_m);
    }
  } else {
    const BodyObstacle& obstacle = solids.obstacle_of(a);
    const RigidPose X_WB = solids.bodies()[b].pose();
    for (const PlacedHull& part : parts_b) {
      meet_surface(obstacle, part, X_WB, margin_m, [&](const Manifold& manifold) {
        if (are_whole) {
          found_.append(manifold);
        } else if (!is_buried(parts_b, part, manifold, -1.0)) {
          found_.add(manifold);
        }
      });
    }
  }
  left_out_ = left_out_ || found_.has_left_out();
  return found_.all();
}

void SolidMeeting::join_parts(Parts parts_a, Parts parts_b, const PlacedHull& whole_a,
                              double margin_m) {
  for (const PlacedHull& part_b : parts_b) {
    if (are_apart(whole_a, part_b, margin_m)) {
      continue;
    }
    for (const PlacedHull& part_a : parts_a) {
      if (are_apart(part_a, part_b, margin_m)) {
        continue;
      }
      const Manifold manifold = manifold_of(part_a, part_b, margin_m);
      if (!is_buried(parts_a, part_a, manifold, 1.0) &&
          !is_buried(parts_b, part_b, manifold, -1.0)) {
        found_.add(manifold);
      }
    }
  }
}

template <class Take>
void SolidMeeting::meet_surface(const BodyObstacle& obstacle, const PlacedHull& hull,
                                const RigidPose& X_WB, double margin_m, const Take& take) {
  const RigidPose& X_WO = obstacle.X_WO;
  const bool is_mesh = !obstacle.mesh.triangles.empty();
  if (!is_mesh && !obstacle.field.is_there()) {
    take(manifold_of(X_WO.point(obstacle.plane_O.translation),
                     X_WO.direction(obstacle.plane_O.rotation.col(1)), hull, margin_m));
    return;
  }
  seen_.place(hull.hull(), seen_from(X_WO, X_WB));
  const auto manifolds = is_mesh
                             ? mesh_contact_.find(obstacle.mesh, obstacle.sides, seen_, margin_m)
                             : field_contact_.find(obstacle.field, seen_, margin_m);
  for (const Manifold& manifold : manifolds) {
    take(in_world(manifold, X_WO));
  }
  left_out_ = left_out_ || (is_mesh && mesh_contact_.has_left_out());
}

}  // namespace tactus::rendering
