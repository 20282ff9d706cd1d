#include "host_tools/bake/body/mass_properties.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "host_tools/bake/body/inertia.h"
#include "host_tools/bake/body/solid_mesh.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using rendering::Float3;
using rendering::TriangleIndices;

// The integrals of 1, x and x x^T over the solid, for x from `origin`.
struct SolidMoments {
  Vec3 origin = Vec3::Zero();
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  // A bound of the rounding errors in `volume`.
  double rounding = 0.0;

  [[nodiscard]] Vec3 center() const { return origin + first / volume; }
  // Returns the second moments about the centre.
  [[nodiscard]] Mat3 central() const { return second - first * first.transpose() / volume; }
};

// Sums over the tetrahedra between the origin and each triangle, whose volumes have the sign of the
// side from which the triangle is seen. For corners a, b, c and s = a + b + c their integrals are
// volume (1, s / 4, (a a^T + b b^T + c c^T + s s^T) / 20): Tonon, "Explicit exact formulas for the
// 3-D tetrahedron inertia tensor in terms of its vertex coordinates", 2004. The sum is that of
// Mirtich, "Fast and accurate computation of polyhedral mass properties", 1996.
SolidMoments moments_about(const Vec3& origin, std::span<const Vec3> vertices,
                           std::span<const TriangleIndices> triangles) {
  // The operations of a determinant round fewer times than this.
  constexpr double kRoundings = 16.0;
  SolidMoments sum{.origin = origin};
  for (const TriangleIndices& t : triangles) {
    const Vec3 a = vertices[t[0]] - origin;
    const Vec3 ab = vertices[t[1]] - vertices[t[0]];
    const Vec3 ac = vertices[t[2]] - vertices[t[0]];
    const double volume = a.dot(ab.cross(ac)) / 6.0;
    const Vec3 b = a + ab;
    const Vec3 c = a + ac;
    const Vec3 s = a + b + c;
    sum.volume += volume;
    sum.first += volume / 4.0 * s;
    sum.second += volume / 20.0 *
                  (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    sum.rounding += kRoundings * std::numeric_limits<double>::epsilon() * a.norm() * ab.norm() *
                    ac.norm() / 6.0;
  }
  return sum;
}

void require_volume(const SolidMoments& moments) {
  if (std::abs(moments.volume) <= moments.rounding) {
    throw InputError(fmt::format(
        "the mesh encloses no volume ({:.3g} m^3): it is flat, or its faces lie back to back; give "
        "it a thickness, or give its centre of mass and inertia",
        moments.volume));
  }
  if (moments.volume < 0.0) {
    throw InputError(fmt::format(
        "the mesh is inside out: its volume is {:.3g} m^3; write flip = true", moments.volume));
  }
}

}  // namespace

void require_density(double density_kg_per_m3) {
  if (!(density_kg_per_m3 > 0.0) || !std::isfinite(density_kg_per_m3)) {
    throw InputError(
        fmt::format("the density is {} kg/m^3; give one above 0, such as 1000, that of water",
                    density_kg_per_m3));
  }
}

MassProperties mesh_mass_properties(std::span<const Vec3> vertices_O,
                                    std::span<const TriangleIndices> triangles,
                                    double density_kg_per_m3) {
  require_density(density_kg_per_m3);
  require_solid(vertices_O, triangles);
  Eigen::AlignedBox3d box;
  for (const TriangleIndices& t : triangles) {
    box.extend(vertices_O[t[0]]).extend(vertices_O[t[1]]).extend(vertices_O[t[2]]);
  }
  const SolidMoments rough = moments_about(box.center(), vertices_O, triangles);
  require_volume(rough);
  const SolidMoments moments = moments_about(rough.center(), vertices_O, triangles);
  const Mat3 second = density_kg_per_m3 * moments.central();
  const MassProperties result{.mass_kg = density_kg_per_m3 * moments.volume,
                              .center_O = moments.center(),
                              .inertia_C = second.trace() * Mat3::Identity() - second};
  if (const auto fault = inertia_fault(result.inertia_C)) {
    throw InputError(fmt::format(
        "the mesh bounds no solid, since its {}: parts of it are inside out, or cross each other; "
        "repair it in a mesh program, or give its centre of mass and inertia",
        *fault));
  }
  return result;
}

MassProperties mesh_mass_properties(std::span<const Float3> vertices_O,
                                    std::span<const TriangleIndices> triangles,
                                    double density_kg_per_m3) {
  std::vector<Vec3> vertices(vertices_O.size());
  std::ranges::transform(vertices_O, vertices.begin(), rendering::to_vec3);
  return mesh_mass_properties(std::span<const Vec3>(vertices), triangles, density_kg_per_m3);
}

MassProperties with_mass(const MassProperties& properties, double mass_kg) {
  if (!(mass_kg > 0.0) || !std::isfinite(mass_kg)) {
    throw InputError(fmt::format("the mass is {} kg; give one above 0", mass_kg));
  }
  return {.mass_kg = mass_kg,
          .center_O = properties.center_O,
          .inertia_C = mass_kg / properties.mass_kg * properties.inertia_C};
}

}  // namespace tactus::host
