// A scene as it is seen from the front, where the user sits, or from the right: how far it reaches
// toward that side at the points of a grid.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "rendering/geometry/vector.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// The side from which rays meet the scene: along z at points of x and y, or along x at points of z
// and y.
enum class SeenFrom { front, right };

// A map of how far the scene reaches at each ray of a grid, m; nothing where a ray meets no
// triangle.
class SideMap {
 public:
  // Meets the drawn triangles of all objects, each with the rays that its box covers. Rays stand at
  // `across`, x from the front and z from the right, and at `up`, y; both rise. m, world frame.
  SideMap(std::span<const rendering::Object> objects, SeenFrom side, std::vector<double> across,
          std::vector<double> up);

  // Returns how far the scene reaches at a ray.
  [[nodiscard]] std::optional<double> at(std::size_t column, std::size_t row) const {
    return reach_m_[row * across_m_.size() + column];
  }
  // Returns how many columns the surface goes on to both sides of a ray, without a gap and no
  // steeper than 45 degrees; the smaller number. Nothing where the ray meets nothing.
  [[nodiscard]] std::optional<std::size_t> run_about(std::size_t column, std::size_t row) const;

 private:
  void meet(const Vec3& a, const Vec3& b, const Vec3& c);
  // Returns true if the surface goes on from a ray to a neighbour of its row.
  [[nodiscard]] bool goes_on(std::size_t column, std::size_t next, std::size_t row) const;

  std::vector<double> across_m_;
  std::vector<double> up_m_;
  std::vector<std::optional<double>> reach_m_;
};

// Returns the place, seen from a side, about which most of the surface lies in a row, and of
// several the one nearest to the middle of the scene's box; nothing if no ray meets anything. World
// frame, m.
std::optional<Vec3> broadest_place(std::span<const rendering::Object> objects, SeenFrom side,
                                   const rendering::Bounds& box);

}  // namespace tactus::host
