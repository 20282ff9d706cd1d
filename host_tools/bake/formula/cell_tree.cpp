#include "host_tools/bake/formula/cell_tree.h"

#include <algorithm>
#include <cmath>

namespace tactus::host {
namespace {

// The share by which the first cell of the grid is longer than the mean, and the last one shorter.
constexpr double kStretch = 0.0618;

}  // namespace

GridPlace corner_of(const GridPlace& from, int size, unsigned k) {
  return {from[0] + ((k & 1U) != 0 ? size : 0), from[1] + ((k & 2U) != 0 ? size : 0),
          from[2] + ((k & 4U) != 0 ? size : 0)};
}

CellTree::CellTree(const rendering::FormulaView& formula, const rendering::Box& bounds, int levels)
    : formula_(formula), bounds_(bounds), first_size_(1 << std::clamp(levels, 0, kMostLevels)) {
  const Vec3 size = bounds.upper - bounds.lower;
  const double wanted = size.maxCoeff() / kFirstCells;
  for (std::size_t k = 0; k < count_.size(); ++k) {
    const double cells = size[static_cast<Eigen::Index>(k)] / wanted;
    count_[k] = std::max(1, static_cast<int>(std::ceil(cells)));
    firsts_ *= static_cast<std::uint32_t>(count_[k]);
  }
  for (std::uint32_t i = 0; i < firsts_; ++i) {
    nodes_.push_back(look_at(first_leaf(i).from, first_size_));
  }
}

Leaf CellTree::first_leaf(std::uint32_t number) const {
  const int i = static_cast<int>(number);
  return {.node = number,
          .from = {i % count_[0] * first_size_, i / count_[0] % count_[1] * first_size_,
                   i / (count_[0] * count_[1]) * first_size_},
          .size = first_size_};
}

Leaf CellTree::child(const Leaf& parent, unsigned k) const {
  const int half = parent.size / 2;
  return {.node = nodes_[parent.node].first_child + k,
          .from = corner_of(parent.from, half, k),
          .size = half};
}

// The grid is stretched by a parabola, most in the middle.
Vec3 CellTree::corner(const GridPlace& place) const {
  Vec3 p;
  for (std::size_t k = 0; k < place.size(); ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double part = static_cast<double>(place[k]) / count_[k] / first_size_;
    const double stretched = part + kStretch * part * (1.0 - part);
    p[axis] = bounds_.lower[axis] + (bounds_.upper - bounds_.lower)[axis] * stretched;
  }
  return p;
}

// Solves the parabola for the part of the side.
std::optional<Leaf> CellTree::leaf_about(const Vec3& p) const {
  GridPlace cell{};
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double stretched =
        (p[axis] - bounds_.lower[axis]) / (bounds_.upper - bounds_.lower)[axis];
    if (std::isnan(stretched) || stretched <= 0.0 || stretched >= 1.0) {
      return std::nullopt;
    }
    const double slope = 1.0 + kStretch;
    const double part =
        2.0 * stretched / (slope + std::sqrt(slope * slope - 4.0 * kStretch * stretched));
    cell[k] = static_cast<int>(part * count_[k] * first_size_);
  }
  return leaf_at(cell);
}

CellTree::Node CellTree::look_at(const GridPlace& from, int size) const {
  Node node;
  const rendering::Interval range =
      evaluate_box(formula_, corner(from), corner(corner_of(from, size, kCorners - 1)));
  node.is_empty = range.lower() > 0.0 || range.upper() < 0.0;
  for (unsigned k = 0; k < kCorners && !node.is_empty; ++k) {
    const bool is_inside = evaluate(formula_, corner(corner_of(from, size, k))) < 0.0;
    node.inside |= static_cast<std::uint8_t>((is_inside ? 1U : 0U) << k);
  }
  return node;
}

void CellTree::split(const Leaf& leaf, int times) {
  if (times <= 0 || leaf.size == 1 || nodes_[leaf.node].is_empty) {
    return;
  }
  nodes_[leaf.node].first_child = static_cast<std::uint32_t>(nodes_.size());
  for (unsigned k = 0; k < kCorners; ++k) {
    nodes_.push_back(look_at(corner_of(leaf.from, leaf.size / 2, k), leaf.size / 2));
  }
  for (unsigned k = 0; k < kCorners; ++k) {
    split(child(leaf, k), times - 1);
  }
}

std::optional<Leaf> CellTree::leaf_at(const GridPlace& cell) const {
  std::uint32_t number = 0;
  for (std::size_t k = cell.size(); k-- > 0;) {
    const int first = cell[k] < 0 ? -1 : cell[k] / first_size_;
    if (first < 0 || first >= count_[k]) {
      return std::nullopt;
    }
    number = number * static_cast<std::uint32_t>(count_[k]) + static_cast<std::uint32_t>(first);
  }
  Leaf leaf = first_leaf(number);
  while (nodes_[leaf.node].first_child != kNone) {
    const int half = leaf.size / 2;
    unsigned k = 0;
    for (std::size_t axis = 0; axis < cell.size(); ++axis) {
      k |= (cell[axis] >= leaf.from[axis] + half ? 1U : 0U) << axis;
    }
    leaf = child(leaf, k);
  }
  return leaf;
}

}  // namespace tactus::host
