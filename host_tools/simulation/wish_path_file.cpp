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
#include "host_tools/simulation/side_map.h"

namespace tactus::host {
namespace {

constexpr std::array<std::string_view, 4> kColumns = {"t_s", "x_m", "y_m", "z_m"};

// Returns the box around the drawn triangles of the scene.
rendering::Bounds bounds(std::span<const rendering::Object> objects) {
  rendering::Bounds box{.lower_W = Vec3::Constant(std::numeric_limits<double>::infinity()),
                        .upper_W = Vec3::Constant(-std::numeric_limits<double>::infinity())};
  for (const rendering::Object& object : objects) {
    for (const rendering::Float3& vertex : object.mesh.vertices) {
      box.lower_W = box.lower_W.cwiseMin(rendering::to_vec3(vertex));
      box.upper_W = box.upper_W.cwiseMax(rendering::to_vec3(vertex));
    }
  }
  return box;
}

// Returns the place on a side of the scene where a path without a file goes: in the middle of the
// scene's box, or, where nothing is there, in the middle of its broadest part.
Vec3 touched_place(std::span<const rendering::Object> objects, SeenFrom side,
                   const rendering::Bounds& box) {
  Vec3 place_W = 0.5 * (box.lower_W + box.upper_W);
  double& across_m = side == SeenFrom::front ? place_W.x() : place_W.z();
  double& reach_m = side == SeenFrom::front ? place_W.z() : place_W.x();
  if (const auto reach = SideMap(objects, side, {across_m}, {place_W.y()}).at(0, 0)) {
    reach_m = *reach;
    return place_W;
  }
  return broadest_place(objects, side, box).value_or(place_W);
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
  const SideMap front(objects, SeenFrom::front, {xs.begin(), xs.end()}, {middle_W.y()});
  Stations stations;
  stations[kMiddleStation] = middle_W;
  const auto follow = [&](std::size_t i, std::size_t inner) {
    const std::optional<double> z = front.at(i, 0);
    const bool reachable =
        stations[inner].x() == xs[inner] && z && std::abs(*z - stations[inner].z()) <= step_m;
    stations[i] = reachable ? Vec3(xs[i], middle_W.y(), *z) : stations[inner];
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
  const Vec3 place_W = touched_place(objects, SeenFrom::right, bounds(objects));
  const double side_m = place_W.x() + tool_radius_m;
  const auto at = [&](double t_s, double clear_m) {
    return Waypoint{.t_s = t_s, .p_W = {side_m + clear_m, place_W.y(), place_W.z()}};
  };
  return WishPath({at(0.0, kClear_m), at(0.8, kClear_m), at(2.0, kTouching_m), at(3.0, -press_m),
                   at(4.0, -press_m), at(5.0, kTouching_m), at(6.0, -press_m), at(6.5, kTouching_m),
                   at(7.0, -press_m), at(8.5, -press_m), at(9.2, kClear_m),
                   at(kOwnPath_s, kClear_m)});
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
  const rendering::Bounds box = bounds(objects);
  const Vec3 middle_W = touched_place(objects, SeenFrom::front, box);
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
  waypoints.push_back({.t_s = kOwnPath_s, .p_W = start_W});
  return WishPath(std::move(waypoints));
}

}  // namespace tactus::host
