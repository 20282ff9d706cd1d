// The contact of a body with a surface that is known by its distance alone: a torus, or a formula.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "rendering/bodies/contact_patches.h"
#include "rendering/bodies/placed_hull.h"
#include "rendering/surface/implicit_surface.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// A surface that bodies meet by its distance: one of the two, in the object's frame O. The views
// stay alive and unchanged.
struct ObstacleField {
  const Primitive* primitive = nullptr;
  const ImplicitSurface* implicit = nullptr;

  [[nodiscard]] bool is_there() const { return primitive != nullptr || implicit != nullptr; }
  // Returns the distance of a point and its gradient, frame O: exact for a primitive, and to first
  // order, f / |grad f|, for a formula. Returns nothing where a formula ends or has no gradient. A
  // sheet of two sides has its outside where `side` is 1, and where it is -1 on the other side.
  [[nodiscard]] std::optional<SurfaceSample> sample_at(const Vec3& p_O, double side) const;
};

// Finds where a body touches such a surface. Lives in static storage; no heap.
//
// The distance is taken at the vertices of the body's hull, and at the points of each face, or of
// the axis of a capsule, to which a descent leads: from the middle, and from half way to the
// corners. A bump that is small beside the face may lie between.
class FieldContact {
 public:
  // Returns the manifolds in which the hull, whose place is given in the surface's frame O, is
  // nearer than the margin; also in frame O. The surface is A. Valid until the next call.
  std::span<const Manifold> find(const ObstacleField& field, const PlacedHull& hull_O,
                                 double margin_m);

 private:
  using Corners = std::span<const Vec3>;

  // Adds the contact of a point of the hull, which has the hull's radius.
  void add(const ObstacleField& field, const Vec3& p_O, double radius_m, double margin_m);
  // Adds the contacts of a polygon with this normal, or of a segment.
  void add_face(const ObstacleField& field, Corners corners, const Vec3& normal, double radius_m,
                double margin_m);
  // Descends on it in steps of at most `size_m`. Returns the point of the least distance.
  [[nodiscard]] Vec3 least_on(const ObstacleField& field, Corners corners, const Vec3& normal,
                              const Vec3& start_O, double size_m) const;

  ContactPatches patches_;
  // The side of a sheet on which the body is: 1 or -1.
  double side_ = 1.0;
};

}  // namespace tactus::rendering
