#include "host_tools/bake/formula/fine_parts.h"

#include <vector>

namespace tactus::host {
namespace {

using rendering::FormulaView;

// A bit for each corner of a cell.
constexpr unsigned kEachCorner = (1U << CellTree::kCorners) - 1;

// Returns true if edges of a cell connect all corners of the set, which is not empty.
bool is_connected(unsigned set) {
  unsigned found = set & (~set + 1U);
  for (unsigned before = 0; before != found;) {
    before = found;
    for (unsigned k = 0; k < CellTree::kCorners; ++k) {
      if ((before >> k & 1U) != 0) {
        found |= (1U << (k ^ 1U) | 1U << (k ^ 2U) | 1U << (k ^ 4U)) & set;
      }
    }
  }
  return found == set;
}

}  // namespace

// A bulge of the surface that hardly comes through one side of the cell does not count. Newton's
// method leads to sheets that are thinner than the distance of the places looked at.
bool is_too_coarse(const FormulaView& formula, const CellTree& tree, const Leaf& leaf) {
  const unsigned inside = tree.inside(leaf);
  if (inside != 0 && inside != kEachCorner) {
    return !is_connected(inside) || !is_connected(kEachCorner & ~inside);
  }
  constexpr int kPlaces = 3;
  constexpr int kSteps = 3;
  constexpr double kBeyond = 1.01;
  const Vec3 low = tree.corner(leaf.from);
  const Vec3 high = tree.corner(corner_of(leaf.from, leaf.size, CellTree::kCorners - 1));
  const auto is_other_side = [&](const Vec3& p) {
    return (evaluate(formula, p) < 0.0) != (inside != 0);
  };
  for (int i = 0; i < kPlaces * kPlaces * kPlaces; ++i) {
    const int z = i / (kPlaces * kPlaces);
    const Vec3 part(i % kPlaces + 1, i / kPlaces % kPlaces + 1, z + 1);
    if (is_other_side(low + (high - low).cwiseProduct(part) / (kPlaces + 1))) {
      return true;
    }
  }
  Vec3 p = 0.5 * (low + high);
  for (int i = 0; i < kSteps; ++i) {
    const rendering::ValueAndGradient there = evaluate_gradient(formula, p);
    const Vec3 step = -there.value / there.gradient.squaredNorm() * there.gradient;
    const Vec3 beyond = p + kBeyond * step;
    if (!beyond.allFinite() || (beyond.array() <= low.array()).any() ||
        (beyond.array() >= high.array()).any()) {
      return false;
    }
    if (is_other_side(beyond)) {
      return true;
    }
    p += step;
  }
  return false;
}

std::optional<Vec3> split_unclear(const FormulaView& formula, CellTree& tree, int least_size) {
  std::optional<Vec3> left;
  for (std::vector<Leaf> cells(1); !cells.empty();) {
    cells.clear();
    left.reset();
    tree.for_each_leaf([&](const Leaf& leaf) {
      if (is_too_coarse(formula, tree, leaf)) {
        left = tree.corner(leaf.from);
        if (leaf.size > least_size) {
          cells.push_back(leaf);
        }
      }
    });
    for (const Leaf& cell : cells) {
      tree.split(cell, 1);
    }
  }
  return left;
}

}  // namespace tactus::host
