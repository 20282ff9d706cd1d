#include "host_tools/bake/scene/closed_volume.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace tactus::host {
namespace {

using rendering::TriangleIndices;

// A part has a volume if it is more than this share of the cube over its longest side. Below, as
// for a sheet with two faces back to back, the sign is that of rounding errors.
constexpr double kLeastShare = 1e-7;

// The triangles of a connected part.
struct Part {
  std::vector<std::uint32_t> triangles;
  Eigen::AlignedBox3d box;
  double volume_m3 = 0.0;

  // Returns the volume, or 0 where it is within rounding errors.
  [[nodiscard]] double sure_volume() const {
    const double side = box.sizes().maxCoeff();
    return std::abs(volume_m3) > kLeastShare * side * side * side ? volume_m3 : 0.0;
  }
};

// Returns true if the triangle has the edge from `a` to `b` in that direction.
bool runs_along(const TriangleIndices& t, std::uint32_t a, std::uint32_t b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

bool is_closed(const rendering::BakedMeshView& mesh) {
  const auto triangles = mesh.mesh.triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t other = mesh.neighbours[i][k];
      // A neighbour runs along a shared edge in the other direction.
      if (other == rendering::kNoNeighbour ||
          !runs_along(triangles[other], triangles[i][(k + 1) % 3], triangles[i][k])) {
        return false;
      }
    }
  }
  return true;
}

std::array<Vec3, 3> corners_of(const rendering::MeshView& mesh, std::uint32_t triangle) {
  const TriangleIndices& t = mesh.triangles[triangle];
  return {to_vec3(mesh.vertices[t[0]]), to_vec3(mesh.vertices[t[1]]), to_vec3(mesh.vertices[t[2]])};
}

// Sets the box and the volume by the divergence theorem, about a corner of the part.
void measure(const rendering::MeshView& mesh, Part& part) {
  const Vec3 origin = corners_of(mesh, part.triangles.front())[0];
  double six_volumes = 0.0;
  for (const std::uint32_t triangle : part.triangles) {
    const auto [a, b, c] = corners_of(mesh, triangle);
    six_volumes += (a - origin).dot((b - origin).cross(c - origin));
    part.box.extend(a).extend(b).extend(c);
  }
  part.volume_m3 = six_volumes / 6.0;
}

// Returns the parts of a closed mesh.
std::vector<Part> parts_of(const rendering::BakedMeshView& mesh) {
  std::vector<Part> parts;
  std::vector<bool> seen(mesh.mesh.triangles.size());
  for (std::uint32_t first = 0; first < seen.size(); ++first) {
    if (seen[first]) {
      continue;
    }
    Part& part = parts.emplace_back();
    part.triangles.push_back(first);
    seen[first] = true;
    for (std::size_t next = 0; next < part.triangles.size(); ++next) {
      for (const std::uint32_t other : mesh.neighbours[part.triangles[next]]) {
        if (!seen[other]) {
          seen[other] = true;
          part.triangles.push_back(other);
        }
      }
    }
    measure(mesh.mesh, part);
  }
  return parts;
}

// Returns how often the part winds around a point: 1 inside, 0 outside. It sums the solid angles of
// the triangles (Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983).
double winding_number(const rendering::MeshView& mesh, const Part& part, const Vec3& p) {
  double half_angles = 0.0;
  for (const std::uint32_t triangle : part.triangles) {
    const auto [a, b, c] = corners_of(mesh, triangle);
    const Vec3 u = a - p;
    const Vec3 v = b - p;
    const Vec3 w = c - p;
    const double lengths = u.norm() * v.norm() * w.norm() + u.dot(v) * w.norm() +
                           v.dot(w) * u.norm() + w.dot(u) * v.norm();
    half_angles += std::atan2(u.dot(v.cross(w)), lengths);
  }
  return half_angles / (2.0 * std::numbers::pi);
}

// Returns true if the part lies within others of positive volume, as a hollow does.
bool is_hollow(const rendering::MeshView& mesh, std::span<const Part> parts, const Part& part) {
  const Vec3 p = corners_of(mesh, part.triangles.front())[0];
  double winding = 0.0;
  for (const Part& other : parts) {
    if (other.volume_m3 > -part.volume_m3 && other.box.contains(p)) {
      winding += winding_number(mesh, other, p);
    }
  }
  constexpr double kHalf = 0.5;
  return winding > kHalf;
}

}  // namespace

std::optional<ClosedVolume> closed_volume(const rendering::BakedMeshView& mesh) {
  if (!is_closed(mesh)) {
    return std::nullopt;
  }
  const std::vector<Part> parts = parts_of(mesh);
  ClosedVolume result{.volume_m3 = 0.0, .parts = parts.size()};
  double largest = 0.0;
  for (const Part& part : parts) {
    const double volume = part.sure_volume();
    result.volume_m3 += volume;
    if (volume < 0.0 && !is_hollow(mesh.mesh, parts, part)) {
      ++result.inside_out;
      if (volume < largest) {
        largest = volume;
        result.place_W = corners_of(mesh.mesh, part.triangles.front())[0];
      }
    }
  }
  return result;
}

std::optional<std::string> inside_out_warning(const std::optional<ClosedVolume>& volume,
                                              std::string_view remedy) {
  if (!volume || volume->inside_out == 0) {
    return std::nullopt;
  }
  if (volume->volume_m3 < 0.0) {
    return fmt::format(
        "the mesh is inside out: it is closed and its volume is {:.3g} m^3, so the "
        "tool goes in unfelt and is held inside; {}",
        volume->volume_m3, remedy);
  }
  return fmt::format(
      "{} of the {} closed parts of the mesh are inside out, the largest at ({:.4g}, "
      "{:.4g}, {:.4g}) m; turn their faces in a mesh program",
      volume->inside_out, volume->parts, volume->place_W.x(), volume->place_W.y(),
      volume->place_W.z());
}

}  // namespace tactus::host
