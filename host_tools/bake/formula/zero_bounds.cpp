#include "host_tools/bake/formula/zero_bounds.h"

#include <vector>

#include "host_tools/bake/formula/box_parts.h"

namespace tactus::host {
namespace {

using rendering::Box;
using rendering::FormulaView;

// Returns true if interval arithmetic proves that the formula is nowhere 0 in a box.
bool is_free(const FormulaView& formula, const Box& box) {
  constexpr double kSmallestPart = 1.0 / 64.0;
  constexpr int kMostBoxes = 4096;
  const double smallest = kSmallestPart * size_of(box);
  std::vector<Box> parts{box};
  for (int i = 0; !parts.empty(); ++i) {
    const Box part = parts.back();
    parts.pop_back();
    const rendering::Interval range = evaluate_box(formula, part.lower, part.upper);
    if (range.lower() > 0.0 || range.upper() < 0.0) {
      continue;
    }
    if (i == kMostBoxes || size_of(part) < smallest) {
      return false;
    }
    for (const Box& half : halves_of(part)) {
      parts.push_back(half);
    }
  }
  return true;
}

// Moves one side of a box inwards, past the slabs that are free of zeros.
void move_side(const FormulaView& formula, Box& box, int axis, bool is_upper) {
  constexpr int kHalvings = 12;
  double step = box.upper[axis] - box.lower[axis];
  for (int i = 0; i < kHalvings; ++i) {
    step *= 0.5;
    Box slab = box;
    if (is_upper) {
      slab.lower[axis] = slab.upper[axis] - step;
    } else {
      slab.upper[axis] = slab.lower[axis] + step;
    }
    if (is_free(formula, slab)) {
      (is_upper ? box.upper : box.lower)[axis] = (is_upper ? slab.lower : slab.upper)[axis];
    }
  }
}

}  // namespace

Box bounds_of_zeros(const FormulaView& formula, const Box& bounds) {
  // The second time the other sides are nearer.
  constexpr int kTimes = 2;
  constexpr double kRoom = 0.05;
  Box box = bounds;
  for (int i = 0; i < kTimes; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      move_side(formula, box, axis, false);
      move_side(formula, box, axis, true);
    }
  }
  const Vec3 room = kRoom * (box.upper - box.lower);
  return {.lower = (box.lower - room).cwiseMax(bounds.lower),
          .upper = (box.upper + room).cwiseMin(bounds.upper)};
}

}  // namespace tactus::host
