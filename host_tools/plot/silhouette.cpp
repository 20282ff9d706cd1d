#include "host_tools/plot/silhouette.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tactus::host {
namespace {

// Sub-pixels of a pixel along each axis: an edge then has nine grey levels.
constexpr int kOversampling = 3;
// The brightness of a sub-pixel in front of which there is no mesh.
constexpr float kNothing = -1.0F;

// Brightness and depth of each sub-pixel (a depth buffer).
struct Canvas {
  int width;
  int height;
  std::vector<double> depth;
  std::vector<float> brightness;

  Canvas(int w, int h)
      : width(w),
        height(h),
        depth(static_cast<std::size_t>(w) * static_cast<std::size_t>(h),
              -std::numeric_limits<double>::infinity()),
        brightness(depth.size(), kNothing) {}

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

// A vertex on the canvas.
struct ScreenVertex {
  // In sub-pixels from the left and from the lower edge.
  double x;
  double y;
  // Toward the viewer, m.
  double depth;
};

// Returns twice the signed area of the triangle (a, b, p).
double edge(const ScreenVertex& a, const ScreenVertex& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

// Fills the sub-pixels whose centres lie in the triangle, where it is the nearest so far.
void fill(Canvas& canvas, const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
          float brightness) {
  const double area = edge(a, b, c.x, c.y);
  if (area == 0.0) {
    return;
  }
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [bottom, top] = std::minmax({a.y, b.y, c.y});
  const int first_column = std::max(0, static_cast<int>(std::floor(left)));
  const int last_column = std::min(canvas.width - 1, static_cast<int>(std::ceil(right)));
  const int first_row = std::max(0, static_cast<int>(std::floor(bottom)));
  const int last_row = std::min(canvas.height - 1, static_cast<int>(std::ceil(top)));
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const double x = column + 0.5;
      const double y = row + 0.5;
      const double u = edge(b, c, x, y) / area;
      const double v = edge(c, a, x, y) / area;
      const double w = 1.0 - u - v;
      if (u < 0.0 || v < 0.0 || w < 0.0) {
        continue;
      }
      const std::size_t i = canvas.index(column, row);
      const double depth = u * a.depth + v * b.depth + w * c.depth;
      if (depth > canvas.depth[i]) {
        canvas.depth[i] = depth;
        canvas.brightness[i] = brightness;
      }
    }
  }
}

// Returns the triangle's normal, twice its area long; summed up, large triangles count more.
Vec3 area_normal(const rendering::MeshView& mesh, const rendering::TriangleIndices& triangle) {
  const Vec3 a = rendering::to_vec3(mesh.vertices[triangle[0]]);
  const Vec3 b = rendering::to_vec3(mesh.vertices[triangle[1]]);
  const Vec3 c = rendering::to_vec3(mesh.vertices[triangle[2]]);
  return (b - a).cross(c - a);
}

// Returns for each vertex the unit normal averaged over its triangles by their area.
std::vector<Vec3> vertex_normals(const rendering::MeshView& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const rendering::TriangleIndices& triangle : mesh.triangles) {
    const Vec3 area = area_normal(mesh, triangle);
    for (const std::uint32_t vertex : triangle) {
      normals[vertex] += area;
    }
  }
  for (Vec3& normal : normals) {
    normal.normalize();
  }
  return normals;
}

// Returns the mean normal of the triangle's vertices, so that the shading shows the surface and not
// its triangles. At the vertex of a sharp edge it takes the triangle's own.
Vec3 shading_normal(const rendering::MeshView& mesh, const std::vector<Vec3>& of_vertices,
                    const rendering::TriangleIndices& triangle) {
  // The cosine of the angle between the normals of vertex and triangle, about 53 degrees.
  constexpr double kSharp = 0.6;
  const Vec3 own = area_normal(mesh, triangle).normalized();
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t vertex : triangle) {
    sum += of_vertices[vertex].dot(own) < kSharp ? own : of_vertices[vertex];
  }
  return sum;
}

// Returns the unit direction to the light, the same as seen from the viewer in both views.
Vec3 toward_light(View view) {
  const Vec3 in_view = Vec3(-0.35, 0.55, 0.75).normalized();  // right, up, toward the viewer
  return view == View::front ? in_view : Vec3(-in_view.z(), in_view.y(), in_view.x());
}

// Returns the unit direction to the viewer.
Vec3 toward_viewer(View view) {
  return view == View::front ? Vec3(0.0, 0.0, 1.0) : Vec3(-1.0, 0.0, 0.0);
}

// Returns the brightness, 0 in the dark to 1 in full light. The side that faces the viewer counts,
// so both sides of a triangle are lit alike.
float lit(const Vec3& normal, View view) {
  const double length = normal.norm();
  if (length == 0.0) {
    return 0.5F;
  }
  const double side = normal.dot(toward_viewer(view)) < 0.0 ? -1.0 : 1.0;
  return static_cast<float>(
      std::clamp(0.5 + 0.5 * side * normal.dot(toward_light(view)) / length, 0.0, 1.0));
}

// Draws every triangle; the depth buffer decides which is seen.
void draw_mesh(Canvas& canvas, View view, const Window& window, const rendering::MeshView& mesh) {
  const std::vector<Vec3> normals = vertex_normals(mesh);
  std::vector<ScreenVertex> screen;
  screen.reserve(mesh.vertices.size());
  for (const rendering::Float3& vertex : mesh.vertices) {
    const Vec3 p_W = rendering::to_vec3(vertex);
    const PlanePoint point = project(view, p_W);
    screen.push_back({.x = (point.right - window.lower.right) / window.width() * canvas.width,
                      .y = (point.up - window.lower.up) / window.height() * canvas.height,
                      .depth = nearness(view, p_W)});
  }
  for (const rendering::TriangleIndices& triangle : mesh.triangles) {
    const Vec3 normal = shading_normal(mesh, normals, triangle);
    fill(canvas, screen[triangle[0]], screen[triangle[1]], screen[triangle[2]], lit(normal, view));
  }
}

// Returns the mean of a pixel's sub-pixels as grey.
std::uint8_t pixel(const Canvas& canvas, int column, int row) {
  // The grey levels of the dark and of full light; the paper is 255, so the mesh always stands out.
  constexpr double kDarkest = 176.0;
  constexpr double kLightest = 240.0;
  double sum = 0.0;
  for (int i = 0; i < kOversampling; ++i) {
    for (int j = 0; j < kOversampling; ++j) {
      const float brightness =
          canvas.brightness[canvas.index(kOversampling * column + j, kOversampling * row + i)];
      sum += brightness == kNothing
                 ? 255.0
                 : kDarkest + (kLightest - kDarkest) * static_cast<double>(brightness);
    }
  }
  return static_cast<std::uint8_t>(std::lround(sum / (kOversampling * kOversampling)));
}

}  // namespace

PlanePoint project(View view, const Vec3& p_W) {
  return {.right = view == View::front ? p_W.x() : p_W.z(), .up = p_W.y()};
}

double nearness(View view, const Vec3& p_W) {
  return p_W.dot(toward_viewer(view));
}

void Window::include(const PlanePoint& point) {
  if (empty) {
    lower = point;
    upper = point;
    empty = false;
    return;
  }
  lower = {.right = std::min(lower.right, point.right), .up = std::min(lower.up, point.up)};
  upper = {.right = std::max(upper.right, point.right), .up = std::max(upper.up, point.up)};
}

Window square_about(const Window& tight, double share, double least) {
  const double half = share * std::max({tight.width(), tight.height(), least});
  const double right = 0.5 * (tight.lower.right + tight.upper.right);
  const double up = 0.5 * (tight.lower.up + tight.upper.up);
  return {.lower = {.right = right - half, .up = up - half},
          .upper = {.right = right + half, .up = up + half},
          .empty = false};
}

Window bounds(View view, std::span<const rendering::Object> objects) {
  Window window;
  for (const rendering::Object& object : objects) {
    for (const rendering::Float3& vertex : object.mesh.vertices) {
      window.include(project(view, rendering::to_vec3(vertex)));
    }
  }
  return window;
}

GreyImage draw_silhouette(View view, const Window& window, int width, int height,
                          std::span<const rendering::Object> objects) {
  Canvas canvas(kOversampling * width, kOversampling * height);
  for (const rendering::Object& object : objects) {
    draw_mesh(canvas, view, window, object.mesh);
  }
  GreyImage image{.width = width, .height = height, .pixels = {}};
  image.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      image.pixels.push_back(pixel(canvas, column, row));
    }
  }
  return image;
}

}  // namespace tactus::host
