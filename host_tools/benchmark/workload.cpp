#include "host_tools/benchmark/workload.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "rendering/geometry/hierarchy_query.h"
#include "rendering/world/world.h"

namespace tactus::host {
namespace {

using rendering::MeshView;
using rendering::to_vec3;

// A visitor of the hierarchy that keeps the distance to the first triangle that the ray meets
// (Moller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997).
struct RayCast {
  const MeshView& mesh;
  const Vec3& from;
  const Vec3& direction;
  double nearest;

  [[nodiscard]] double reach() const { return nearest; }
  void operator()(std::uint32_t t) {
    const auto& [i, j, k] = mesh.triangles[t];
    const Vec3 a = to_vec3(mesh.vertices[i]);
    const Vec3 ab = to_vec3(mesh.vertices[j]) - a;
    const Vec3 ac = to_vec3(mesh.vertices[k]) - a;
    const Vec3 normal = ab.cross(ac);
    const double toward = -normal.dot(direction);
    if (toward == 0.0) {
      return;
    }
    const Vec3 offset = from - a;
    const double travel = normal.dot(offset) / toward;
    const Vec3 q = direction.cross(offset);
    const double u = -ac.dot(q) / toward;
    const double v = ab.dot(q) / toward;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && travel >= 0.0) {
      nearest = std::min(nearest, travel);
    }
  }
};

// The path has a point for each tick of 1 ms.
constexpr double kTick_s = 0.001;

// Returns the sine with that frequency and amplitude 1 at time `t`, s.
double wave(double frequency_hz, double t) {
  return std::sin(2.0 * std::numbers::pi * frequency_hz * t);
}

// Returns the direction of the ray's origin as seen from the middle; the slow and the fast nodding
// have frequencies without a common period, so that the path does not repeat.
Vec3 direction_at(double t) {
  const double phi = 2.0 * t;
  const double theta = 0.4 * wave(0.11, t) + 0.01 * wave(7.3, t);
  return {std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), std::sin(theta)};
}

// Returns the height over the pressed depth, m: 20 mm at the ends of a cycle, 0 while the tool
// strokes.
double lift_at(double t) {
  constexpr double kCycle_s = 2.0;
  constexpr double kEnds_s = 0.25;
  constexpr double kLift_m = 0.02;
  const double phase = std::fmod(t, kCycle_s);
  const double to_end = std::min(phase, kCycle_s - phase);
  return kLift_m * std::max(0.0, 1.0 - to_end / kEnds_s);
}

// Returns the vector, or one of its direction with the length `most`, m, if it is longer.
Vec3 shortened(const Vec3& v, double most) {
  const double length = v.norm();
  return length > most ? Vec3{v * (most / length)} : v;
}

}  // namespace

std::vector<Vec3> stroke_workload(const MeshView& mesh, double tool_radius_m, std::size_t ticks) {
  const Vec3 lower = to_vec3(mesh.nodes[0].lower);
  const Vec3 upper = to_vec3(mesh.nodes[0].upper);
  const Vec3 middle = 0.5 * (lower + upper);
  const double outside = (upper - lower).norm();
  const double most_rise = kTick_s * kMostRise_m_per_s;
  // The height of the surface under the ray over the middle, and the height that the tool follows.
  double height = 0.5 * outside;
  double surface = 0.0;
  std::vector<Vec3> path;
  path.reserve(ticks);
  for (std::size_t k = 0; k < ticks; ++k) {
    const double t = kTick_s * static_cast<double>(k);
    const Vec3 u = direction_at(t);
    const Vec3 from = middle + outside * u;
    const Vec3 inward = -u;
    RayCast ray{.mesh = mesh, .from = from, .direction = inward, .nearest = outside};
    rendering::visit_along(mesh.nodes, from, inward, 0.0, ray);
    // If the ray meets nothing before the middle, the last height is kept.
    height = ray.nearest < outside ? outside - ray.nearest : height;
    surface = k == 0 ? height : std::clamp(height, surface - most_rise, surface + most_rise);
    const double depth = 0.002 + 0.001 * wave(1.7, t);
    path.emplace_back(middle + (surface + tool_radius_m - depth + lift_at(t)) * u);
  }
  return path;
}

std::vector<Vec3> hand_workload(const rendering::Object& object, double tool_radius_m,
                                std::span<const Vec3> wishes) {
  const auto world = std::make_unique<rendering::World>();
  world->set_scene({&object, 1}, {.tool_radius_m = tool_radius_m});
  world->set_tick_budget(std::numeric_limits<double>::infinity());
  std::vector<Vec3> path;
  path.reserve(wishes.size());
  Vec3 tool = wishes.empty() ? Vec3::Zero().eval() : wishes.front();
  Vec3 proxy = tool;
  for (const Vec3& wish : wishes) {
    tool += shortened(wish - tool, kTick_s * kHandSpeed_m_per_s);
    tool = proxy + shortened(tool - proxy, kHandStretch_m);
    proxy = world->touch({.p_W = tool}).proxy_W;
    path.push_back(tool);
  }
  return path;
}

}  // namespace tactus::host
