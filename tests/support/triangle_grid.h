// Triangles by the cells of space that their boxes pass through: which of a large mesh's are near,
// by another way than the hierarchies under test take.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/support/brute_force.h"

namespace tactus::testing {

class TriangleGrid {
 public:
  // Makes a grid of one triangle or more.
  explicit TriangleGrid(std::vector<Corners> triangles);

  // Returns every triangle that comes within `reach` of the segment p-q, and some that do not. The
  // span is valid until the next call.
  std::span<const Corners> near(const Vec3& p, const Vec3& q, double reach);

 private:
  // The cells that a box meets, from `lower` up to and with `upper`.
  struct Cells {
    std::array<std::size_t, 3> lower;
    std::array<std::size_t, 3> upper;
  };
  [[nodiscard]] Cells cells_of(const Vec3& lower, const Vec3& upper) const;
  template <class Visit>
  void for_each(const Cells& cells, Visit&& visit);

  std::vector<Corners> triangles_;
  Vec3 lower_ = Vec3::Zero();
  double cell_m_ = 1.0;
  std::array<std::size_t, 3> size_{};               // in cells
  std::vector<std::vector<std::uint32_t>> inside_;  // the triangles of each cell
  std::vector<std::size_t> asked_;                  // the last query that found a triangle
  std::size_t queries_ = 0;
  std::vector<Corners> near_;
};

}  // namespace tactus::testing
