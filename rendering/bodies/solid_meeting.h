// The contact points of two solids, whatever they are made of: hulls, parts, meshes, fields or
// planes.
#pragma once

#include <cstdint>
#include <span>

#include "rendering/bodies/field_contact.h"
#include "rendering/bodies/joined_manifolds.h"
#include "rendering/bodies/manifold.h"
#include "rendering/bodies/mesh_contact.h"
#include "rendering/bodies/placed_hull.h"
#include "rendering/bodies/solid_hulls.h"
#include "rendering/bodies/solid_list.h"

namespace tactus::rendering {

// Lives in static storage; no heap.
class SolidMeeting {
 public:
  // Returns the manifolds of body b with body or obstacle a, where they are nearer than the margin,
  // in the world frame. Valid until the next call.
  std::span<const Manifold> find(const SolidList& solids, const SolidHulls& hulls, std::uint16_t a,
                                 std::uint16_t b, double margin_m);
  // Returns true if the last search has left out manifolds, or triangles of a mesh.
  [[nodiscard]] bool has_left_out() const { return left_out_; }

 private:
  using Parts = std::span<const PlacedHull>;

  // Joins the contacts of the parts of two solids with hulls.
  void join_parts(Parts parts_a, Parts parts_b, const PlacedHull& whole_a, double margin_m);
  // Gives the manifolds of a hull of a body, whose pose is given, with an obstacle that has no hull
  // to `take`.
  template <class Take>
  void meet_surface(const BodyObstacle& obstacle, const PlacedHull& hull, const RigidPose& X_WB,
                    double margin_m, const Take& take);

  JoinedManifolds found_;
  MeshContact mesh_contact_;
  FieldContact field_contact_;
  // A part of a body, seen from the obstacle.
  PlacedHull seen_;
  bool left_out_ = false;
};

}  // namespace tactus::rendering
