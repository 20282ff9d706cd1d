#include "host_tools/mesh/primitive_mesh.h"

#include <cmath>
#include <numbers>

#include "host_tools/mesh/level_set.h"

namespace tactus::host {
namespace {

using rendering::PrimitiveKind;

// Sides of a full turn: a sphere then differs from its mesh by 0.2 % of the radius.
constexpr std::uint32_t kSides = 48;
// Half the edge of the square that stands for an infinite plane.
constexpr double kShownOfAPlane_m = 0.1;

// A point of the section through the axis, which is y: its distance from the axis and its height.
struct ProfilePoint {
  double radius_m = 0.0;
  double y_m = 0.0;
};
using Profile = std::vector<ProfilePoint>;

// Turns a profile about the y axis of the primitive's own frame.
class Lathe {
 public:
  // Returns the surface of a profile that runs downwards along the outside. A point on the axis
  // becomes one vertex, any other a ring of kSides vertices. `closed` joins the last ring to the
  // first, for a torus.
  TriangleMesh turn(const Profile& profile, bool closed) {
    std::vector<std::uint32_t> rings;
    for (const ProfilePoint& point : profile) {
      rings.push_back(add_ring(point));
    }
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      join(profile[i], rings[i], profile[i + 1], rings[i + 1]);
    }
    if (closed) {
      join(profile.back(), rings.back(), profile.front(), rings.front());
    }
    return std::move(mesh_);
  }

 private:
  static bool on_axis(const ProfilePoint& point) { return point.radius_m == 0.0; }

  // Adds the vertices of a profile point and returns the first one's index.
  std::uint32_t add_ring(const ProfilePoint& point) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    const std::uint32_t count = on_axis(point) ? 1 : kSides;
    for (std::uint32_t k = 0; k < count; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kSides;
      mesh_.vertices.push_back(rendering::to_float3(
          {point.radius_m * std::cos(angle), point.y_m, point.radius_m * std::sin(angle)}));
    }
    return first;
  }

  // Joins two rings by triangles that face outwards; next to the axis one of each pair is left out.
  void join(const ProfilePoint& upper, std::uint32_t above, const ProfilePoint& lower,
            std::uint32_t below) {
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const std::uint32_t next = (k + 1) % kSides;
      if (!on_axis(upper)) {
        const std::uint32_t foot = on_axis(lower) ? below : below + k;
        mesh_.triangles.push_back({above + k, above + next, foot});
      }
      if (!on_axis(lower)) {
        const std::uint32_t head = on_axis(upper) ? above : above + next;
        mesh_.triangles.push_back({head, below + next, below + k});
      }
    }
  }

  TriangleMesh mesh_;
};

// Appends an arc of a circle about `middle`. `from` and `to` are in rad, counted from the outside
// (away from the axis) upwards.
void add_arc(Profile& profile, const ProfilePoint& middle, double radius_m, double from,
             double to) {
  const auto steps =
      static_cast<int>(std::lround(std::abs(to - from) * kSides / (2.0 * std::numbers::pi)));
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    profile.push_back(
        {middle.radius_m + radius_m * std::cos(angle), middle.y_m + radius_m * std::sin(angle)});
  }
}

// Returns a primitive with an axis, in its own frame.
TriangleMesh round_mesh(const rendering::Primitive& primitive) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  const auto& [a, b, c] = primitive.dimensions_m;
  Profile profile;
  switch (primitive.kind) {
    case PrimitiveKind::cylinder:
      return Lathe().turn({{0.0, b}, {a, b}, {a, -b}, {0.0, -b}}, false);
    case PrimitiveKind::cone:
      return Lathe().turn({{0.0, b}, {a, 0.0}, {0.0, 0.0}}, false);
    case PrimitiveKind::torus:
      add_arc(profile, {a, 0.0}, b, kQuarter, -3.0 * kQuarter);
      profile.pop_back();  // The full turn ends where it began, and `closed` joins the two.
      return Lathe().turn(profile, true);
    case PrimitiveKind::capsule:
      add_arc(profile, {0.0, b}, a, kQuarter, 0.0);
      add_arc(profile, {0.0, -b}, a, 0.0, -kQuarter);
      break;
    default:  // the sphere
      add_arc(profile, {}, a, kQuarter, -kQuarter);
      break;
  }
  // The cosine of a quarter turn is not exactly 0, and a point on the axis must be.
  profile.front().radius_m = profile.back().radius_m = 0.0;
  return Lathe().turn(profile, false);
}

// Returns a box of twelve triangles. Bits 0, 1 and 2 of a corner's number are the signs of x, y, z.
TriangleMesh box_mesh(const Vec3& half_m) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.push_back(rendering::to_float3({(corner & 1) != 0 ? half_m.x() : -half_m.x(),
                                                  (corner & 2) != 0 ? half_m.y() : -half_m.y(),
                                                  (corner & 4) != 0 ? half_m.z() : -half_m.z()}));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// Returns a square of the plane y = 0 that faces upwards.
TriangleMesh plane_mesh() {
  constexpr auto kHalf = static_cast<float>(kShownOfAPlane_m);
  return {
      .vertices = {{-kHalf, 0, -kHalf}, {-kHalf, 0, kHalf}, {kHalf, 0, kHalf}, {kHalf, 0, -kHalf}},
      .triangles = {{0, 1, 2}, {0, 2, 3}},
      .corner_places = {}};
}

// Draws a primitive that has no drawing of its own, in frame O like the others.
TriangleMesh mesh_by_level(const rendering::Primitive& primitive) {
  constexpr int kCells = 40;
  constexpr double kRoom = 0.02;  // about the box, of its longest side: the surface ends inside
  const rendering::Primitive at_origin{.kind = primitive.kind,
                                       .dimensions_m = primitive.dimensions_m};
  const rendering::Bounds box = bounds(at_origin);
  const Vec3 room = Vec3::Constant(kRoom * (box.upper_W - box.lower_W).maxCoeff());
  return mesh_level_set([&](const Vec3& p) { return sample(at_origin, p).distance_m; },
                        box.lower_W - room, box.upper_W + room, kCells);
}

TriangleMesh mesh_in_O(const rendering::Primitive& primitive) {
  const auto& [a, b, c] = primitive.dimensions_m;
  switch (primitive.kind) {
    case PrimitiveKind::plane:
      return plane_mesh();
    case PrimitiveKind::box:
      return box_mesh({a, b, c});
    case PrimitiveKind::sphere:
    case PrimitiveKind::cylinder:
    case PrimitiveKind::capsule:
    case PrimitiveKind::cone:
    case PrimitiveKind::torus:
      return round_mesh(primitive);
    default:
      return mesh_by_level(primitive);
  }
}

}  // namespace

TriangleMesh primitive_mesh(const rendering::Primitive& primitive) {
  TriangleMesh mesh = mesh_in_O(primitive);
  for (rendering::Float3& vertex : mesh.vertices) {
    vertex = rendering::to_float3(primitive.X_WO.point(rendering::to_vec3(vertex)));
  }
  return mesh;
}

}  // namespace tactus::host
