#include "host_tools/simulation/wish_path_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host_tools/csv/csv_table.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::array<std::string_view, 4> kColumns = {"t_s", "x_m", "y_m", "z_m"};

// An axis-aligned box, world frame, m; a new one is empty.
struct Box {
  Vec3 lower_W = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 upper_W = Vec3::Constant(-std::numeric_limits<double>::infinity());
};

// Returns the box around the meshes of the scene.
Box bounds(std::span<const rendering::Object> objects) {
  Box box;
  for (const rendering::Object& object : objects) {
    for (const rendering::Float3& vertex : object.mesh.vertices) {
      box.lower_W = box.lower_W.cwiseMin(rendering::to_vec3(vertex));
      box.upper_W = box.upper_W.cwiseMax(rendering::to_vec3(vertex));
    }
  }
  return box;
}

// Returns z of the triangle abc at (x, y), by barycentric coordinates in the xy plane; nothing if
// the triangle does not cover that point.
std::optional<double> height(const Vec3& a, const Vec3& b, const Vec3& c, double x, double y) {
  const auto cross = [](double ux, double uy, double vx, double vy) { return ux * vy - uy * vx; };
  const double area = cross(b.x() - a.x(), b.y() - a.y(), c.x() - a.x(), c.y() - a.y());
  if (area == 0.0) {
    return std::nullopt;
  }
  const double v = cross(x - a.x(), y - a.y(), c.x() - a.x(), c.y() - a.y()) / area;
  const double w = cross(b.x() - a.x(), b.y() - a.y(), x - a.x(), y - a.y()) / area;
  if (v < 0.0 || w < 0.0 || v + w > 1.0) {
    return std::nullopt;
  }
  return a.z() + v * (b.z() - a.z()) + w * (c.z() - a.z());
}

// Returns the largest z of the scene at each x on the line y. All triangles are tried, which is
// fast enough for once a run.
std::vector<std::optional<double>> front(std::span<const rendering::Object> objects,
                                         std::span<const double> xs, double y) {
  std::vector<std::optional<double>> fronts(xs.size());
  for (const rendering::Object& object : objects) {
    for (const rendering::TriangleIndices& triangle : object.mesh.triangles) {
      const Vec3 a = rendering::to_vec3(object.mesh.vertices[triangle[0]]);
      const Vec3 b = rendering::to_vec3(object.mesh.vertices[triangle[1]]);
      const Vec3 c = rendering::to_vec3(object.mesh.vertices[triangle[2]]);
      if (y < std::min({a.y(), b.y(), c.y()}) || y > std::max({a.y(), b.y(), c.y()})) {
        continue;
      }
      for (std::size_t i = 0; i < xs.size(); ++i) {
        const std::optional<double> z = height(a, b, c, xs[i], y);
        if (z) {
          fronts[i] = std::max(*z, fronts[i].value_or(*z));
        }
      }
    }
  }
  return fronts;
}

// Returns the largest x of the scene at the middle's y and z. Exchanging x and z turns it into a
// search for a height.
double right_side(std::span<const rendering::Object> objects, const Vec3& middle_W) {
  std::optional<double> rightmost;
  for (const rendering::Object& object : objects) {
    const auto corner = [&](std::uint32_t vertex) {
      const Vec3 p_W = rendering::to_vec3(object.mesh.vertices[vertex]);
      return Vec3(p_W.z(), p_W.y(), p_W.x());
    };
    for (const rendering::TriangleIndices& triangle : object.mesh.triangles) {
      const std::optional<double> x = height(corner(triangle[0]), corner(triangle[1]),
                                             corner(triangle[2]), middle_W.z(), middle_W.y());
      if (x) {
        rightmost = std::max(*x, rightmost.value_or(*x));
      }
    }
  }
  return rightmost.value_or(middle_W.x());
}

// Points of the stroke from its left end to its right one.
constexpr std::size_t kStations = 17;
constexpr std::size_t kMiddleStation = kStations / 2;
using Stations = std::array<Vec3, kStations>;

// Returns points of the scene's front, evenly along x. From the middle outwards the stroke ends
// where the front is missing or steeper than 45 degrees, so that the hand is not led under an
// overhang; the stations beyond that repeat the last good one.
Stations find_stations(std::span<const rendering::Object> objects, const Vec3& middle_W,
                       double half_stroke_m) {
  const double step_m = half_stroke_m / static_cast<double>(kMiddleStation);
  std::array<double, kStations> xs{};
  for (std::size_t i = 0; i < kStations; ++i) {
    xs[i] = middle_W.x() + step_m * (static_cast<double>(i) - static_cast<double>(kMiddleStation));
  }
  const std::vector<std::optional<double>> fronts = front(objects, xs, middle_W.y());
  Stations stations;
  stations[kMiddleStation] = {middle_W.x(), middle_W.y(),
                              fronts[kMiddleStation].value_or(middle_W.z())};
  const auto follow = [&](std::size_t i, std::size_t inner) {
    const bool reachable = stations[inner].x() == xs[inner] && fronts[i] &&
                           std::abs(*fronts[i] - stations[inner].z()) <= step_m;
    stations[i] = reachable ? Vec3(xs[i], middle_W.y(), *fronts[i]) : stations[inner];
  };
  for (std::size_t k = 1; k <= kMiddleStation; ++k) {
    follow(kMiddleStation + k, kMiddleStation + k - 1);
    follow(kMiddleStation - k, kMiddleStation - k + 1);
  }
  return stations;
}

}  // namespace

WishPath sideways_wish_path(std::span<const rendering::Object> objects, double tool_radius_m,
                            double press_m) {
  // How far from the side the hand waits, and how close it stays between two presses.
  constexpr double kClear_m = 0.02;
  constexpr double kTouching_m = 0.002;
  const Box box = bounds(objects);
  const Vec3 middle_W = 0.5 * (box.lower_W + box.upper_W);
  const double side_m = right_side(objects, middle_W) + tool_radius_m;
  const auto at = [&](double t_s, double clear_m) {
    return Waypoint{.t_s = t_s, .p_W = {side_m + clear_m, middle_W.y(), middle_W.z()}};
  };
  return WishPath({at(0.0, kClear_m), at(0.8, kClear_m), at(2.0, kTouching_m), at(3.0, -press_m),
                   at(4.0, -press_m), at(5.0, kTouching_m), at(6.0, -press_m), at(6.5, kTouching_m),
                   at(7.0, -press_m), at(8.5, -press_m), at(9.2, kClear_m), at(10.0, kClear_m)});
}

WishPath read_wish_path(const std::filesystem::path& file) {
  const CsvTable table = CsvTable::read(file, kColumns);
  const std::span<const double> t_s = table.column("t_s");
  std::vector<Waypoint> waypoints;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (i > 0 && t_s[i] <= t_s[i - 1]) {
      throw InputError(fmt::format("{}:{}: column t_s: {} does not come after {}", file.string(),
                                   table.line(i), t_s[i], t_s[i - 1]));
    }
    waypoints.push_back(
        {.t_s = t_s[i],
         .p_W = {table.column("x_m")[i], table.column("y_m")[i], table.column("z_m")[i]}});
  }
  return WishPath(std::move(waypoints));
}

WishPath default_wish_path(std::span<const rendering::Object> objects, double tool_radius_m,
                           double press_m, double reach_m) {
  // How far from the front the hand waits before and after.
  constexpr double kClear_m = 0.03;
  constexpr double kPressed_s = 3.0;
  constexpr double kStroke_s = 5.0;
  const Box box = bounds(objects);
  const Vec3 middle_W = 0.5 * (box.lower_W + box.upper_W);
  const double half_stroke_m = std::min(0.25 * (box.upper_W.x() - box.lower_W.x()), reach_m);
  const Stations stations = find_stations(objects, middle_W, half_stroke_m);
  const double front_m = stations[kMiddleStation].z();

  const Vec3 towards_user(0.0, 0.0, 1.0);
  const Vec3 start_W(middle_W.x(), middle_W.y(), front_m + tool_radius_m + kClear_m);
  const auto pressed = [&](std::size_t i) {
    return Vec3(stations[i] + (tool_radius_m - press_m) * towards_user);
  };
  std::vector<Waypoint> waypoints = {
      {.t_s = 0.0, .p_W = start_W},
      {.t_s = 0.8, .p_W = start_W},
      {.t_s = 2.0, .p_W = pressed(kMiddleStation) + (press_m + 0.002) * towards_user},
      {.t_s = kPressed_s, .p_W = pressed(kMiddleStation)},
  };
  // The path goes from the middle to the right end, to the left end and back, station by station.
  constexpr std::size_t kMoves = 2 * (kStations - 1);
  for (std::size_t move = 0; move <= kMoves; ++move) {
    const std::size_t phase = (kMiddleStation + move) % kMoves;
    const std::size_t station = phase < kStations ? phase : kMoves - phase;
    const double t_s = kPressed_s + 0.3 + kStroke_s * static_cast<double>(move) / kMoves;
    waypoints.push_back({.t_s = t_s, .p_W = pressed(station)});
  }
  waypoints.push_back({.t_s = 9.2, .p_W = start_W});
  waypoints.push_back({.t_s = 10.0, .p_W = start_W});
  return WishPath(std::move(waypoints));
}

}  // namespace tactus::host
