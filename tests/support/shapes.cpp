#include "tests/support/shapes.h"

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "host_tools/mesh/icosphere.h"

namespace tactus::testing {
namespace {

using rendering::Float3;
using rendering::to_float3;
using rendering::to_vec3;
using rendering::TriangleIndices;

std::uint32_t add_vertex(Shape& s, const Vec3& v) {
  s.vertices.push_back(to_float3(v));
  return static_cast<std::uint32_t>(s.vertices.size() - 1);
}

void add_quad(Shape& s, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  s.triangles.push_back({a, b, c});
  s.triangles.push_back({a, c, d});
}

// A solid over a simple polygon in the x-y plane (counter-clockwise seen from +z), from z = -h/2 to
// h/2. `caps` are triangles of the polygon's indices.
Shape extrude(std::string name, const std::vector<Vec3>& polygon,
              const std::vector<TriangleIndices>& caps, double height) {
  Shape s{.name = std::move(name)};
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {-0.5 * height, 0.5 * height}) {
    for (const Vec3& p : polygon) {
      add_vertex(s, {p.x(), p.y(), z});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    add_quad(s, i, j, n + j, n + i);
  }
  for (const TriangleIndices& t : caps) {
    s.triangles.push_back({t[0], t[2], t[1]});
    s.triangles.push_back({n + t[0], n + t[1], n + t[2]});
  }
  return s;
}

std::vector<TriangleIndices> fan(std::uint32_t n) {
  std::vector<TriangleIndices> caps;
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    caps.push_back({0, i, i + 1});
  }
  return caps;
}

// A grid of (rows + 1) x (columns + 1) vertices.
template <class At>
Shape grid(std::string name, int rows, int columns, At at) {
  Shape s{.name = std::move(name), .closed = false};
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c) {
      add_vertex(s, at(r, c));
    }
  }
  const auto index = [&](int r, int c) {
    return static_cast<std::uint32_t>(r * (columns + 1) + c);
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      add_quad(s, index(r, c), index(r, c + 1), index(r + 1, c + 1), index(r + 1, c));
    }
  }
  return s;
}

constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace

Shape icosphere(double radius_m, int subdivisions) {
  host::TriangleMesh mesh = host::icosphere(radius_m, subdivisions);
  return {.name = "icosphere",
          .vertices = std::move(mesh.vertices),
          .triangles = std::move(mesh.triangles)};
}

Shape bumpy_sphere(double radius_m, int subdivisions, double amplitude) {
  Shape s = icosphere(1.0, subdivisions);
  s.name = "bumpy sphere";
  for (Float3& f : s.vertices) {
    const Vec3 u = to_vec3(f).normalized();
    const double bump =
        std::sin(9 * u.x() + 0.5) * std::sin(8 * u.y() + 1.1) * std::sin(10 * u.z() + 1.7);
    f = to_float3(radius_m * (1.0 + amplitude * bump) * u);
  }
  return s;
}

Shape box(const Vec3& size_m) {
  const double x = 0.5 * size_m.x();
  const double y = 0.5 * size_m.y();
  return extrude("box", {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, fan(4), size_m.z());
}

Shape sliver_box(const Vec3& size_m, double width_m) {
  // Two long sides that are cut so finely that their triangles are a hundred thousand times longer
  // than wide near the corner.
  const double x = 0.5 * size_m.x();
  const double y = 0.5 * size_m.y();
  std::vector<Vec3> polygon{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}};
  for (int k = 8; k >= 1; --k) {
    polygon.emplace_back(-x + k * width_m, y, 0);
  }
  polygon.emplace_back(-x, y, 0);
  Shape s =
      extrude("sliver box", polygon, fan(static_cast<std::uint32_t>(polygon.size())), size_m.z());
  return s;
}

Shape torus(double major_m, double minor_m, int around, int across) {
  Shape s{.name = "torus"};
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = kTurn * i / around;
      const double b = kTurn * j / across;
      const double r = major_m + minor_m * std::cos(b);
      add_vertex(s, {r * std::cos(a), r * std::sin(a), minor_m * std::sin(b)});
    }
  }
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % around) * across + j % across);
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      add_quad(s, index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
    }
  }
  return s;
}

Shape prism(int sides, double radius_m, double height_m) {
  std::vector<Vec3> polygon;
  for (int i = 0; i < sides; ++i) {
    const double a = kTurn * i / sides;
    polygon.emplace_back(radius_m * std::cos(a), radius_m * std::sin(a), 0);
  }
  return extrude("prism", polygon, fan(static_cast<std::uint32_t>(sides)), height_m);
}

Shape cone(int sides, double radius_m, double height_m) {
  Shape s{.name = "cone"};
  const std::uint32_t apex = add_vertex(s, {0, 0, 0.5 * height_m});
  const std::uint32_t centre = add_vertex(s, {0, 0, -0.5 * height_m});
  for (int i = 0; i < sides; ++i) {
    const double a = kTurn * i / sides;
    add_vertex(s, {radius_m * std::cos(a), radius_m * std::sin(a), -0.5 * height_m});
  }
  for (int i = 0; i < sides; ++i) {
    const auto a = static_cast<std::uint32_t>(2 + i);
    const auto b = static_cast<std::uint32_t>(2 + (i + 1) % sides);
    s.triangles.push_back({apex, a, b});
    s.triangles.push_back({centre, b, a});
  }
  return s;
}

Shape star(int points, double outer_m, double inner_m, double height_m) {
  std::vector<Vec3> polygon;
  std::vector<TriangleIndices> caps;
  const auto n = static_cast<std::uint32_t>(2 * points);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double a = kTurn * i / n;
    const double r = i % 2 == 0 ? outer_m : inner_m;
    polygon.emplace_back(r * std::cos(a), r * std::sin(a), 0);
  }
  for (std::uint32_t i = 1; i < n; i += 2) {
    caps.push_back({i, (i + 1) % n, (i + 2) % n});
    if (i >= 3 && i + 2 <= n) {
      caps.push_back({1, i, (i + 2) % n});
    }
  }
  return extrude("star", polygon, caps, height_m);
}

Shape grooved_block(double angle_deg, double depth_m) {
  const double half = depth_m * std::tan(0.5 * angle_deg * std::numbers::pi / 180.0);
  const double w = half + 0.02;
  const double floor = -depth_m - 0.02;
  Shape s = extrude("grooved block",
                    {{0, -depth_m, 0},
                     {-half, 0, 0},
                     {-w, 0, 0},
                     {-w, floor, 0},
                     {w, floor, 0},
                     {w, 0, 0},
                     {half, 0, 0}},
                    {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}}, 0.06);
  s.name += " " + std::to_string(static_cast<int>(angle_deg)) + " degrees";
  return s;
}

Shape blade(double angle_deg, double height_m) {
  const double half = height_m * std::tan(0.5 * angle_deg * std::numbers::pi / 180.0);
  Shape s = extrude(
      "blade", {{0, 0.5 * height_m, 0}, {-half, -0.5 * height_m, 0}, {half, -0.5 * height_m, 0}},
      fan(3), 0.06);
  s.name += " " + std::to_string(static_cast<int>(angle_deg)) + " degrees";
  return s;
}

Shape slotted_block(double gap_m, double depth_m) {
  const double g = 0.5 * gap_m;
  const double w = g + 0.02;
  const double floor = -depth_m - 0.02;
  return extrude("slotted block",
                 {{-g, 0, 0},
                  {-w, 0, 0},
                  {-w, floor, 0},
                  {w, floor, 0},
                  {w, 0, 0},
                  {g, 0, 0},
                  {g, -depth_m, 0},
                  {-g, -depth_m, 0}},
                 {{0, 1, 7}, {1, 2, 7}, {2, 3, 7}, {3, 6, 7}, {3, 4, 6}, {4, 5, 6}}, 0.06);
}

Shape pit(double half_width_m, double depth_m) {
  Shape s = box({0.06, 0.06, 0.06});
  s.name = "pit";
  // Cut the +y face (its quad is side 2 of the extrusion) and put four inclined walls round a point
  // below it.
  std::vector<TriangleIndices> kept;
  for (const TriangleIndices& t : s.triangles) {
    const bool top = to_vec3(s.vertices[t[0]]).y() > 0 && to_vec3(s.vertices[t[1]]).y() > 0 &&
                     to_vec3(s.vertices[t[2]]).y() > 0;
    if (!top) {
      kept.push_back(t);
    }
  }
  s.triangles = std::move(kept);
  const std::uint32_t tip = add_vertex(s, {0, 0.03 - depth_m, 0});
  std::vector<std::uint32_t> inner;
  std::vector<std::uint32_t> outer;
  for (const auto& [x, z] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}) {
    inner.push_back(add_vertex(s, {x * half_width_m, 0.03, z * half_width_m}));
    for (std::uint32_t v = 0; v < 8; ++v) {
      const Vec3 p = to_vec3(s.vertices[v]);
      if (p.y() > 0 && p.x() * x > 0 && p.z() * z > 0) {
        outer.push_back(v);
      }
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    add_quad(s, outer[i], outer[j], inner[j], inner[i]);
    s.triangles.push_back({inner[i], inner[j], tip});
  }
  return s;
}

Shape flat_sheet(double cell_m, int cells) {
  Shape s{.name = "flat sheet", .closed = false};
  const int half = cells / 2;
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) {
      s.vertices.push_back(to_float3({cell_m * (i - half), 0.0, cell_m * (k - half)}));
    }
  }
  const auto at = [cells](int i, int k) { return static_cast<std::uint32_t>(i * (cells + 1) + k); };
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      s.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      s.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
  }
  return s;
}

Shape height_field(double size_m, int cells, double amplitude_m) {
  return grid("height field", cells, cells, [&](int r, int c) {
    const double x = size_m * (static_cast<double>(c) / cells - 0.5);
    const double z = size_m * (static_cast<double>(r) / cells - 0.5);
    return Vec3{x, amplitude_m * std::sin(150.0 * x) * std::cos(130.0 * z), z};
  });
}

Shape moebius(double radius_m, double width_m, int segments) {
  return grid("moebius strip", segments, 1, [&](int r, int c) {
    const double a = kTurn * r / segments;
    const double s = width_m * (c - 0.5);
    const double ring = radius_m + s * std::cos(0.5 * a);
    return Vec3{ring * std::cos(a), ring * std::sin(a), s * std::sin(0.5 * a)};
  });
}

Shape helicoid(double radius_m, double pitch_m, int segments) {
  return grid("helicoid", segments, 4, [&](int r, int c) {
    const double a = 2.0 * kTurn * r / segments;
    const double ring = radius_m * c / 4.0;
    return Vec3{ring * std::cos(a), pitch_m * (2.0 * r / segments - 1.0), ring * std::sin(a)};
  });
}

Shape triangle_soup(std::uint64_t seed, int triangles, double size_m) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-0.5 * size_m, 0.5 * size_m);
  Shape s{.name = "triangle soup", .closed = false};
  for (int i = 0; i < triangles; ++i) {
    const Vec3 centre{place(random), place(random), place(random)};
    TriangleIndices t{};
    for (std::uint32_t& corner : t) {
      corner = add_vertex(s, centre + 0.5 * Vec3{place(random), place(random), place(random)});
    }
    s.triangles.push_back(t);
  }
  return s;
}

Shape open_tube(int sides, double radius_m, double height_m) {
  Shape s = grid("open tube", 1, sides, [&](int r, int c) {
    const double a = kTurn * c / sides;
    return Vec3{radius_m * std::cos(a), height_m * (r - 0.5), radius_m * std::sin(a)};
  });
  return s;
}

Shape disc(std::uint32_t sides, double radius_m, double rim_m) {
  Shape s{.name = "disc", .closed = false};
  const std::uint32_t middle = add_vertex(s, {0, 0, 0});
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double a = kTurn * i / sides;
    add_vertex(s, {radius_m * std::cos(a), rim_m, radius_m * std::sin(a)});
    s.triangles.push_back({middle, 1 + (i + 1) % sides, 1 + i});
  }
  return s;
}

Shape doubled(Shape shape) {
  shape.name = "doubled " + shape.name;
  const std::vector<TriangleIndices> once = shape.triangles;
  shape.triangles.insert(shape.triangles.end(), once.begin(), once.end());
  return shape;
}

Shape moved(Shape shape, const Vec3& offset_m) {
  for (Float3& v : shape.vertices) {
    v = to_float3(to_vec3(v) + offset_m);
  }
  return shape;
}

Shape joined(Shape a, const Shape& b) {
  const auto base = static_cast<std::uint32_t>(a.vertices.size());
  a.name += " with " + b.name;
  a.closed = a.closed && b.closed;
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) {
    a.triangles.push_back({base + i, base + j, base + k});
  }
  return a;
}

Shape turned(Shape shape, const Vec3& axis, double angle_rad) {
  const Mat3 rotation = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
  for (Float3& v : shape.vertices) {
    v = to_float3(rotation * to_vec3(v));
  }
  return shape;
}

}  // namespace tactus::testing
