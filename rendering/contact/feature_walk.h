// A point that walks over a mesh from feature to feature: the face-directed connection graph. While
// it is in contact no hierarchy is asked, so a tick costs what the walk costs and not what the mesh
// is large: one triangle where the tool stays over a face.
//
// The states are free space, face, edge and vertex. From a face the walk leaves where the tool lies
// beyond one of the face's pseudo-Voronoi planes (through an edge, perpendicular to the face);
// along an edge it ends at the edge's end planes (through a vertex, perpendicular to the edge);
// from an edge it goes to the face, from a vertex to the face or edge, that comes nearer to the
// tool. Each step brings it nearer, so it cannot turn in circles. Where nothing comes nearer it
// rests: on a face, in a groove, in a pit. The first contact is found through the hierarchy.
#pragma once

#include <cstdint>

#include "rendering/friction/surface_friction.h"
#include "rendering/material/material.h"
#include "rendering/state_archive.h"
#include "rendering/surface/connected_mesh.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// The result of a walk.
struct FeatureWalk {
  MeshNearest at;
  std::uint16_t visited = 0;  // triangles measured
  bool complete = true;       // false: stopped by the limit, at the best place so far
  bool at_border = false;     // on an open edge, or on a vertex that has one
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
  Vec3 proxy_W = Vec3::Zero();   // m; on the surface in contact, else the tool
  Vec3 normal_W = Vec3::Zero();  // unit, from the surface to the free side; zero without contact
  double depth_m = 0.0;          // (proxy - tool) . normal; 0 without contact
  ContactKind contact = ContactKind::none;
  FrictionState friction = FrictionState::free;
  std::uint16_t visited = 0;          // triangles measured in contact
  std::uint32_t flags = kTouchClean;  // iterations exhausted, tool invalid
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
  // finite or beyond kWorldBound_m leaves it where it is. Real time: no heap; at most
  // kUsualFeatureVisits triangles measured in contact, and as many on the path to it;
  // kMaxFeatureVisits where the last call had too much to do to come anywhere.
  FeatureRest advance(const ConnectedMesh& mesh, Sides sides, const Material& material,
                      const Vec3& h_W);

  [[nodiscard]] const Vec3& position_W() const { return p_; }
  // Returns the feature that the point rests on; meaningful in contact.
  [[nodiscard]] const MeshFeature& feature() const { return feature_; }

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  FeatureRest go(const ConnectedMesh& mesh, Sides sides, const Material& material, const Vec3& h);
  bool approach(const ConnectedMesh& mesh, Sides sides, const Vec3& h, FeatureRest& rest);
  FeatureWalk walk(const ConnectedMesh& mesh, std::uint32_t triangle, const Vec3& q,
                   FeatureRest& rest) const;
  [[nodiscard]] double height_of(const ConnectedMesh& mesh, const MeshNearest& at,
                                 const Vec3& h) const;
  MeshNearest stay_in_friction_circle(const ConnectedMesh& mesh, const FrictionParameters& friction,
                                      double depth, const FeatureWalk& lowest, FeatureRest& rest);
  [[nodiscard]] std::size_t most_visits() const;
  void settle(const ConnectedMesh& mesh, const Material& material, const Vec3& h,
              const FeatureWalk& lowest, FeatureRest& rest);

  Vec3 p_ = Vec3::Zero();
  MeshFeature feature_;
  double side_ = 1.0;  // 1 in front of the surface, -1 behind it
  FrictionState friction_ = FrictionState::free;
  SurfaceFriction model_;
  bool in_contact_ = false;
  bool has_waited_ = false;  // the last call ended where it began, short of where it would go
};

}  // namespace tactus::rendering
