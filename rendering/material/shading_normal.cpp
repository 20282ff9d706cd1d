#include "rendering/material/shading_normal.h"

#include <algorithm>

namespace tactus::rendering {
namespace {

// A triangle's own normal and the interpolated one at the contact, both unit and toward the tool.
struct FaceNormals {
  Vec3 flat = Vec3::Zero();
  Vec3 round = Vec3::Zero();
};

// The normals about one contact. The results of its on_ functions need not be unit.
class Shading {
 public:
  Shading(std::span<const CornerNormals> corners, const ConnectedMesh& mesh,
          const SurfaceContact& contact)
      : corners_(corners), mesh_(mesh), contact_(contact) {}

  // Returns the interpolated normal of the touched triangle.
  [[nodiscard]] Vec3 on_face() const { return normals_of(contact_.triangle).round; }

  // Returns the mixture of the two interpolated normals. The contact's normal c = a n1 + b n2 has,
  // up to a common factor, a = c . n1 - (n1 . n2) c . n2, and b alike.
  [[nodiscard]] Vec3 on_edge() const {
    constexpr double kFlat = 1e-10;  // below it the squared sine is rounding
    const FaceNormals one = normals_of(contact_.triangle);
    const std::uint32_t across = across_edge(contact_.edge);
    // An open edge has one face: its interpolated normal replaces its flat one.
    if (across == kNoTriangle) {
      return contact_.normal_O + one.round - one.flat;
    }
    const FaceNormals other = normals_of(across);
    const double cosine = one.flat.dot(other.flat);
    const double squared_sine = 1.0 - cosine * cosine;
    if (squared_sine < kFlat) {
      return one.round + other.round;
    }
    const double to_one = contact_.normal_O.dot(one.flat);
    const double to_other = contact_.normal_O.dot(other.flat);
    return std::max(to_one - cosine * to_other, 0.0) * one.round +
           std::max(to_other - cosine * to_one, 0.0) * other.round;
  }

  // Returns the normal of the touched triangle if its neighbours at that corner agree with it to a
  // quarter of a degree, else the contact's own.
  [[nodiscard]] Vec3 on_vertex() const {
    constexpr double kAgree = 0.99999;
    Vec3 here = on_face();
    const std::size_t corner = nearest_corner();
    constexpr std::size_t kCorners = 3;
    for (const std::size_t edge : {corner, (corner + kCorners - 1) % kCorners}) {
      const std::uint32_t across = across_edge(edge);
      if (across == kNoTriangle || normals_of(across).round.dot(here) < kAgree) {
        return contact_.normal_O;
      }
    }
    return here;
  }

 private:
  // Returns the corners of a triangle, object frame, m.
  [[nodiscard]] std::array<Vec3, 3> corners_of(std::uint32_t triangle) const {
    const TriangleIndices& indices = mesh_.mesh.triangles[triangle];
    return {to_vec3(mesh_.mesh.vertices[indices[0]]), to_vec3(mesh_.mesh.vertices[indices[1]]),
            to_vec3(mesh_.mesh.vertices[indices[2]])};
  }

  // Returns the triangle across an edge of the touched one; kNoTriangle if there is none or it is
  // not known.
  [[nodiscard]] std::uint32_t across_edge(std::size_t edge) const {
    return mesh_.neighbours.empty() ? kNoTriangle : mesh_.neighbours[contact_.triangle][edge];
  }

  // Returns the corner of the touched triangle that is nearest to the contact.
  [[nodiscard]] std::size_t nearest_corner() const {
    const std::array<Vec3, 3> corners = corners_of(contact_.triangle);
    const auto nearest = std::ranges::min_element(
        corners, {}, [&](const Vec3& c) { return (c - contact_.point_O).squaredNorm(); });
    return static_cast<std::size_t>(nearest - corners.begin());
  }

  // Returns the normals of a triangle for the contact's point, by its barycentric weights, limited
  // to the triangle. A triangle without area takes the contact's normal for both.
  [[nodiscard]] FaceNormals normals_of(std::uint32_t triangle) const {
    const auto& [a, b, c] = corners_of(triangle);
    const Vec3 along = b - a;
    const Vec3 across = c - a;
    const Vec3 area = along.cross(across);
    const double squared = area.squaredNorm();
    if (!(squared > 0.0)) {
      return {contact_.normal_O, contact_.normal_O};
    }
    const Vec3 from_a = contact_.point_O - a;
    const double of_b = std::clamp(from_a.cross(across).dot(area) / squared, 0.0, 1.0);
    const double of_c = std::clamp(along.cross(from_a).dot(area) / squared, 0.0, 1.0 - of_b);
    const CornerNormals& stored = corners_[triangle];
    const Vec3 round = (1.0 - of_b - of_c) * decode(stored[0]) + of_b * decode(stored[1]) +
                       of_c * decode(stored[2]);
    const double length = round.norm();
    FaceNormals normals{.flat = area / std::sqrt(squared), .round = area / std::sqrt(squared)};
    if (length > 0.0) {
      normals.round = round / length;
    }
    // A two-sided surface is touched from behind too.
    if (normals.flat.dot(contact_.normal_O) < 0.0) {
      normals = {-normals.flat, -normals.round};
    }
    return normals;
  }

  std::span<const CornerNormals> corners_;
  const ConnectedMesh& mesh_;
  const SurfaceContact& contact_;
};

}  // namespace

Vec3 shading_normal(std::span<const CornerNormals> corners, const ConnectedMesh& mesh,
                    const SurfaceContact& contact) {
  const Shading shading(corners, mesh, contact);
  Vec3 normal = Vec3::Zero();
  switch (contact.feature) {
    case Feature::face:
      normal = shading.on_face();
      break;
    case Feature::edge:
      normal = shading.on_edge();
      break;
    default:
      normal = shading.on_vertex();
  }
  const double length = normal.norm();
  return length > 0.0 ? Vec3{normal / length} : contact.normal_O;
}

}  // namespace tactus::rendering
