#include "tests/property/fine_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/property/closed_form.h"

namespace tactus::testing {
namespace {

using rendering::Float3;
using rendering::Primitive;
using rendering::PrimitiveKind;
using rendering::to_float3;
using rendering::to_vec3;
using rendering::TriangleIndices;

// Half a sphere of rings of 4, 8, 12 vertices and so on about its pole, which is `move_m` farther
// along y. `up` is 1 or -1.
class HalfSphere {
 public:
  HalfSphere(Shape& shape, int rings, double up)
      : shape_(shape),
        rings_(rings),
        up_(up),
        first_(static_cast<std::uint32_t>(shape.vertices.size())) {}

  void add(double radius_m, double move_m) {
    for (int ring = 0; ring <= rings_; ++ring) {
      add_ring(ring, radius_m, move_m);
    }
    for (int ring = 0; ring < rings_; ++ring) {
      for (int quarter = 0; quarter < 4; ++quarter) {
        for (int place = 0; place <= ring; ++place) {
          add_triangles(ring, quarter, place);
        }
      }
    }
  }

  // Returns the number of a vertex of the rim.
  [[nodiscard]] std::uint32_t rim(int place) const { return vertex(rings_, place); }

 private:
  void add_ring(int ring, double radius_m, double move_m) {
    constexpr double kQuarter = 0.5 * std::numbers::pi;
    const double down = kQuarter * ring / rings_;
    for (int place = 0; place < std::max(1, 4 * ring); ++place) {
      const double turn = ring == 0 ? 0.0 : kQuarter * place / ring;
      const double r = radius_m * std::sin(down);
      shape_.vertices.push_back(to_float3(
          {r * std::cos(turn), up_ * (move_m + radius_m * std::cos(down)), r * std::sin(turn)}));
    }
  }
  // Adds the triangles between a ring and the next, at one place of a quarter turn.
  void add_triangles(int ring, int quarter, int place) {
    const std::uint32_t in = vertex(ring, quarter * ring + place);
    const int out = quarter * (ring + 1) + place;
    add_triangle({in, vertex(ring + 1, out + 1), vertex(ring + 1, out)});
    if (place < ring) {
      add_triangle({in, vertex(ring, quarter * ring + place + 1), vertex(ring + 1, out + 1)});
    }
  }
  void add_triangle(const TriangleIndices& t) {
    shape_.triangles.push_back(up_ > 0.0 ? t : TriangleIndices{t[0], t[2], t[1]});
  }
  [[nodiscard]] std::uint32_t vertex(int ring, int place) const {
    const int before = ring == 0 ? 0 : 1 + 2 * ring * (ring - 1) + place % (4 * ring);
    return first_ + static_cast<std::uint32_t>(before);
  }

  Shape& shape_;
  int rings_;
  double up_;
  std::uint32_t first_;
};

// A sphere if `half_m` is 0.
Shape capsule(double radius_m, double half_m, int sides) {
  Shape shape{.name = "capsule"};
  HalfSphere upper(shape, sides / 4, 1.0);
  upper.add(radius_m, half_m);
  HalfSphere lower(shape, sides / 4, -1.0);
  lower.add(radius_m, half_m);
  for (int place = 0; half_m > 0.0 && place < sides / 4 * 4; ++place) {
    const std::uint32_t next = upper.rim(place + 1);
    const std::uint32_t below = lower.rim(place);
    shape.triangles.push_back({upper.rim(place), next, below});
    shape.triangles.push_back({next, lower.rim(place + 1), below});
  }
  return shape;
}

// Turns a shape about z into one about y.
Shape about_y(Shape shape, double up_m) {
  for (Float3& v : shape.vertices) {
    const Vec3 p = to_vec3(v);
    v = to_float3({p.x(), p.z() + up_m, -p.y()});
  }
  return shape;
}

Shape mesh_in_O(const Primitive& primitive, int sides) {
  constexpr double kPlane_m = 0.4;
  const auto& [a, b, c] = primitive.dimensions_m;
  switch (primitive.kind) {
    case PrimitiveKind::plane:
      return flat_sheet(kPlane_m, 2);
    case PrimitiveKind::sphere:
      return capsule(a, 0.0, sides);
    case PrimitiveKind::box:
      return box({2.0 * a, 2.0 * b, 2.0 * c});
    case PrimitiveKind::cylinder:
      return about_y(prism(sides, a, 2.0 * b), 0.0);
    case PrimitiveKind::capsule:
      return capsule(a, b, sides);
    case PrimitiveKind::cone:
      return about_y(cone(sides, a, b), 0.5 * b);
    case PrimitiveKind::torus:
      return about_y(torus(a, b, sides, sides), 0.0);
  }
  return {};
}

}  // namespace

Shape fine_mesh(const Primitive& primitive, int sides) {
  Shape mesh = mesh_in_O(primitive, sides);
  for (Float3& v : mesh.vertices) {
    v = to_float3(primitive.X_WO.point(to_vec3(v)));
  }
  return mesh;
}

// The normals at a corner are taken a little inside the face: on the rim of a solid the surface has
// two.
MeshError error_of(const Shape& mesh, const Primitive& primitive) {
  constexpr double kInside = 1e-3;
  constexpr double kAbove_m = 1e-6;
  const TouchedShape point_on{.primitive = primitive};
  MeshError error;
  for (const TriangleIndices& t : mesh.triangles) {
    const std::array corner{to_vec3(mesh.vertices[t[0]]), to_vec3(mesh.vertices[t[1]]),
                            to_vec3(mesh.vertices[t[2]])};
    const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0;
    const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    const auto below = [&](const Vec3& p) {
      return kAbove_m - clearance(point_on, p + kAbove_m * normal).distance_m;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 inner = corner[k] + kInside * (middle - corner[k]) + kAbove_m * normal;
      const Vec3 away = clearance(point_on, inner).away_W;
      error.tilt = std::max(error.tilt, std::asin(std::min(1.0, away.cross(normal).norm())));
      error.chord_m = std::max({error.chord_m, std::abs(below(middle)),
                                std::abs(below(0.5 * (corner[k] + corner[(k + 1) % 3])))});
    }
  }
  return error;
}

}  // namespace tactus::testing
