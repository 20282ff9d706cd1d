#include "tests/support/triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::testing {
namespace {

Vec3 lower_of(const Corners& t) {
  return t.a.cwiseMin(t.b).cwiseMin(t.c);
}
Vec3 upper_of(const Corners& t) {
  return t.a.cwiseMax(t.b).cwiseMax(t.c);
}

}  // namespace

TriangleGrid::TriangleGrid(std::vector<Corners> triangles)
    : triangles_(std::move(triangles)), asked_(triangles_.size()) {
  // A surface passes through some six times the square of these.
  constexpr double kMostCells = 64.0;
  const double along =
      std::clamp(0.25 * std::sqrt(static_cast<double>(triangles_.size())), 1.0, kMostCells);
  lower_ = lower_of(triangles_.front());
  Vec3 upper = upper_of(triangles_.front());
  for (const Corners& t : triangles_) {
    lower_ = lower_.cwiseMin(lower_of(t));
    upper = upper.cwiseMax(upper_of(t));
  }
  cell_m_ = (upper - lower_).maxCoeff() / along;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    size_[k] = 1 + static_cast<std::size_t>((upper - lower_)[axis] / cell_m_);
  }
  inside_.resize(size_[0] * size_[1] * size_[2]);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    for_each(cells_of(lower_of(triangles_[i]), upper_of(triangles_[i])),
             [&](std::vector<std::uint32_t>& cell) { cell.push_back(i); });
  }
}

TriangleGrid::Cells TriangleGrid::cells_of(const Vec3& lower, const Vec3& upper) const {
  const auto cell = [&](const Vec3& p, std::size_t k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const auto last = static_cast<double>(size_[k] - 1);
    return static_cast<std::size_t>(std::clamp((p - lower_)[axis] / cell_m_, 0.0, last));
  };
  return {.lower = {cell(lower, 0), cell(lower, 1), cell(lower, 2)},
          .upper = {cell(upper, 0), cell(upper, 1), cell(upper, 2)}};
}

template <class Visit>
void TriangleGrid::for_each(const Cells& cells, Visit&& visit) {
  for (std::size_t z = cells.lower[2]; z <= cells.upper[2]; ++z) {
    for (std::size_t y = cells.lower[1]; y <= cells.upper[1]; ++y) {
      for (std::size_t x = cells.lower[0]; x <= cells.upper[0]; ++x) {
        visit(inside_[(z * size_[1] + y) * size_[0] + x]);
      }
    }
  }
}

std::span<const Corners> TriangleGrid::near(const Vec3& p, const Vec3& q, double reach) {
  ++queries_;
  near_.clear();
  const Vec3 wide = Vec3::Constant(reach);
  for_each(cells_of(p.cwiseMin(q) - wide, p.cwiseMax(q) + wide),
           [&](const std::vector<std::uint32_t>& cell) {
             for (const std::uint32_t i : cell) {
               if (std::exchange(asked_[i], queries_) != queries_) {
                 near_.push_back(triangles_[i]);
               }
             }
           });
  return near_;
}

}  // namespace tactus::testing
