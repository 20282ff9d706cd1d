// The mass, the centre of mass and the inertia of a rigid body whose density is the same everywhere
// in its shape. `primitive_mass.h` has those of primitives, `inertia.h` reads an inertia that the
// user gives.
#pragma once

#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

// The numbers that say how a rigid body takes up forces. O is the frame of the object.
struct MassProperties {
  double mass_kg = 0.0;
  // The centre of mass, m.
  Vec3 center_O = Vec3::Zero();
  // The inertia about the centre of mass, kg m^2, along the axes of O. It is symmetric; its
  // products have the sign with which angular momentum = inertia * angular velocity.
  Mat3 inertia_C = Mat3::Zero();
};

// Returns the properties of the solid that a closed mesh bounds. The integrals are exact for the
// polyhedron, and computed about its own centre, so that a mesh far from the origin keeps its
// digits. Vertices at one place must be one vertex, as bake_mesh() leaves them. Inner hollows count
// as empty; where parts overlap, the material counts twice. The time grows as n log n with the
// mesh.
//
// Throws InputError, without a file name, for a density that is not above 0, for a vertex that is
// not finite, an index out of range, a triangle that is there twice, a mesh that is open or wound
// inconsistently, and for a volume that is negative or within rounding errors of 0.
MassProperties mesh_mass_properties(std::span<const Vec3> vertices_O,
                                    std::span<const rendering::TriangleIndices> triangles,
                                    double density_kg_per_m3);
MassProperties mesh_mass_properties(std::span<const rendering::Float3> vertices_O,
                                    std::span<const rendering::TriangleIndices> triangles,
                                    double density_kg_per_m3);

// Returns the properties of the same shape with another density, at which it has this mass. Throws
// InputError, without a file name, if the mass is not above 0.
MassProperties with_mass(const MassProperties& properties, double mass_kg);

// Throws InputError, without a file name, unless the density is finite and above 0.
void require_density(double density_kg_per_m3);

}  // namespace tactus::host
