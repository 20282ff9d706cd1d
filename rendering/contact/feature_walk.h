// A point that walks over a mesh from feature to feature: the face-directed connection graph. While
// it is in contact no hierarchy is asked, so a tick costs what the walk costs and not what the mesh
// is large: one triangle where the tool stays over a face. World::touch uses it for the contact
// method feature_walk (rendering/world/independent_contacts.h), in the frame of the object.
//
// The states are free space, face, edge and vertex. From a face the walk leaves where the tool lies
// beyond one of the face's pseudo-Voronoi planes (through an edge, perpendicular to the face);
// along an edge it ends at the edge's end planes (through a vertex, perpendicular to the edge);
// from an edge it goes to the face, from a vertex to the face or edge, that comes nearer to the
// tool. Each step brings it nearer, so it cannot turn in circles. It rests if nothing comes nearer:
// on a face, in a groove, in a pit. The first contact is found through the hierarchy.
#pragma once

#include <cstdint>

#include "rendering/friction/surface_friction.h"
#include "rendering/limits.h"
#include "rendering/material/material.h"
#include "rendering/state_archive.h"
#include "rendering/surface/connected_mesh.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// The result of a walk.
struct FeatureWalk {
  // The place: the nearest point of the last triangle that came nearer, its feature and its squared
  // distance.
  MeshNearest at;
  // The number of triangles measured.
  std::uint16_t visited = 0;
  // False if the limit stopped the walk, at the best place so far.
  bool complete = true;
  // True if `at` lies on an open edge, or on a vertex that has one.
  bool at_border = false;
};

// Walks from `triangle` downhill in the distance to q_W, and measures at most `limit` triangles,
// but always one. From a face of a convex mesh that has q_W in front it ends at the nearest point
// of all; from one that has q_W behind, and on other meshes, at a point from which no path along
// the surface comes nearer at once: that is why a thin plate holds. Neighbours of opposite winding
// are taken for open edges.
FeatureWalk walk_features(const ConnectedMesh& mesh, std::uint32_t triangle, const Vec3& q_W,
                          std::size_t limit);

// The point's position after a tick.
struct FeatureRest {
  // The point, m: on the surface in contact, else the tool.
  Vec3 proxy_W = Vec3::Zero();
  // The unit normal from the surface to the free side; zero without contact.
  Vec3 normal_W = Vec3::Zero();
  double depth_m = 0.0;  // (proxy - tool) . normal; 0 without contact
  ContactKind contact = ContactKind::none;
  FrictionState friction = FrictionState::free;
  // The number of triangles measured in contact, and on the path to it.
  std::uint16_t visited = 0;
  std::uint16_t approached = 0;
  // TouchFlags: iterations exhausted, tool invalid.
  std::uint32_t flags = kTouchClean;
};

// The tool is a point; its radius is not used. The mesh may have holes and open borders (the point
// slips off there), but no inconsistent winding, and where it runs through itself the walk goes
// through with it.
class FeatureWalker {
 public:
  // Starts over, out of contact, at p_W.
  void place(const Vec3& p_W);

  // Sets the motion that drives the friction models; call it first in a tick (see SurfaceFriction).
  void begin_friction(const Vec3& tool_step_W, double tick_s) {
    model_.begin_tick(tool_step_W, tick_s);
  }

  // Moves the point as near to the tool as the surface and friction let it. A tool that is not
  // finite or beyond kWorldBound_m leaves it where it is. Real time: no heap; at most `most_visits`
  // triangles measured in contact, and as many on the path to it.
  FeatureRest advance(const ConnectedMesh& mesh, Sides sides, const Material& material,
                      const Vec3& h_W, std::size_t most_visits = kMaxFeatureVisits);

  // Returns the point's position after the last tick, m.
  [[nodiscard]] const Vec3& position_W() const { return p_; }
  // Returns the feature that the point rests on; meaningful in contact.
  [[nodiscard]] const MeshFeature& feature() const { return feature_; }

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  // Does the work of advance() for a valid tool: approaches, walks, leaves or settles.
  FeatureRest go(const ConnectedMesh& mesh, Sides sides, const Material& material, const Vec3& h);
  // Sweeps the free point toward the tool. Returns true if it met the surface: it is in contact
  // then.
  bool approach(const ConnectedMesh& mesh, Sides sides, const Vec3& h, FeatureRest& rest);
  // Walks with the visits that this tick has left, and counts them in `rest`.
  FeatureWalk walk(const ConnectedMesh& mesh, std::uint32_t triangle, const Vec3& q,
                   FeatureRest& rest) const;
  // Returns the signed distance of h from its nearest surface point, on the side of the contact, m.
  [[nodiscard]] double height_of(const ConnectedMesh& mesh, const MeshNearest& at,
                                 const Vec3& h) const;
  // Returns the place to which friction lets the point move from its old one.
  MeshNearest stay_in_friction_circle(const ConnectedMesh& mesh, const FrictionParameters& friction,
                                      double depth, const FeatureWalk& lowest, FeatureRest& rest);
  // Takes the new place and writes it, with its normal and depth, to `rest`.
  void settle(const ConnectedMesh& mesh, const Material& material, const Vec3& h,
              const FeatureWalk& lowest, FeatureRest& rest);

  // The point; the feature that it rests on is valid in contact.
  Vec3 p_ = Vec3::Zero();
  MeshFeature feature_;
  // The side of the surface on which the tool was free: 1 in front, -1 behind a two-sided one.
  double side_ = 1.0;
  FrictionState friction_ = FrictionState::free;
  SurfaceFriction model_;
  bool in_contact_ = false;
  // The triangles that this tick may measure.
  std::size_t most_visits_ = kMaxFeatureVisits;
};

}  // namespace tactus::rendering
