// Cuts the bounds of a formula into cells: boxes, finer where they are split. The mesh of a formula
// is made from them (dual_contour.h).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "rendering/surface/implicit_surface.h"

namespace tactus::host {

// A place of the finest grid: whole numbers along the three axes.
using GridPlace = std::array<int, 3>;

// Returns corner k of a box at `from`, which is the corner 0: at x = k & 1, y = k >> 1 & 1,
// z = k >> 2.
GridPlace corner_of(const GridPlace& from, int size, unsigned k);

// A cell that is not split.
struct Leaf {
  std::uint32_t node = 0;
  // Its lower corner, and its size in steps of the finest grid.
  GridPlace from{};
  int size = 0;
};

// Octrees side by side. Host tools use it, one thread.
class CellTree {
 public:
  // Cuts the longest side of the bounds into kFirstCells cells and the others into cells of about
  // the same length. A cell can be split `levels` times, at most kMostLevels.
  CellTree(const rendering::FormulaView& formula, const rendering::Box& bounds, int levels);

  static constexpr int kFirstCells = 24;
  static constexpr unsigned kCorners = 8;
  static constexpr int kMostLevels = 20;

  // Splits a cell into eight, those of them that may hold the surface again, and so on, `times`
  // times or until they have the finest grid's size.
  void split(const Leaf& leaf, int times);

  // Calls use(leaf) for every leaf that may hold the surface, as it is when the call is made.
  template <class Use>
  void for_each_leaf(Use use) const {
    for (std::uint32_t i = 0; i < firsts_; ++i) {
      visit(first_leaf(i), use);
    }
  }

  // Returns the leaf that holds a cell of the finest grid; nothing outside the bounds.
  [[nodiscard]] std::optional<Leaf> leaf_at(const GridPlace& cell) const;

  // Returns the leaf that holds a point, in the formula's frame and units; nothing outside the
  // bounds.
  [[nodiscard]] std::optional<Leaf> leaf_about(const Vec3& p) const;

  // Returns a corner of the finest grid, in the formula's frame and units. The grid is not quite
  // even: so the faces of a shape of round numbers do not lie in the faces of cells, where signs
  // would say little.
  [[nodiscard]] Vec3 corner(const GridPlace& place) const;

  // Returns a bit for each corner k of a leaf (corner_of): 1 where the formula is below 0.
  [[nodiscard]] unsigned inside(const Leaf& leaf) const { return nodes_[leaf.node].inside; }

  // Returns the size of a cell that is not split, in steps of the finest grid.
  [[nodiscard]] int first_size() const { return first_size_; }

  // Returns the number of nodes; those of leaves are below it.
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Node {
    std::uint32_t first_child = kNone;
    std::uint8_t inside = 0;
    // True if interval arithmetic proves that the surface is elsewhere.
    bool is_empty = false;
  };

  [[nodiscard]] Leaf first_leaf(std::uint32_t number) const;
  [[nodiscard]] Leaf child(const Leaf& parent, unsigned k) const;
  [[nodiscard]] Node look_at(const GridPlace& from, int size) const;

  template <class Use>
  void visit(const Leaf& cell, Use& use) const {
    const Node& node = nodes_[cell.node];
    if (node.first_child == kNone) {
      if (!node.is_empty) {
        use(cell);
      }
      return;
    }
    for (unsigned k = 0; k < kCorners; ++k) {
      visit(child(cell, k), use);
    }
  }

  rendering::FormulaView formula_;
  rendering::Box bounds_;
  int first_size_;
  GridPlace count_{};
  std::uint32_t firsts_ = 1;
  std::vector<Node> nodes_;
};

}  // namespace tactus::host
