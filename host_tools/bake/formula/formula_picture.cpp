// A picture is cut out of a grid of cells. Shapes that are small beside the bounds, or flat along
// an axis, are drawn in a grid that fits them. What is still thinner than a cell is drawn thicker.
#include "host_tools/bake/formula/formula_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "host_tools/bake/formula/cell_tree.h"
#include "host_tools/bake/formula/fine_parts.h"
#include "host_tools/bake/formula/formula_warnings.h"
#include "host_tools/bake/formula/zero_bounds.h"
#include "host_tools/bake/formula/zero_search.h"
#include "host_tools/input_error.h"
#include "host_tools/mesh/level_set.h"
#include "host_tools/units.h"

namespace tactus::host {
namespace {

using rendering::Box;
using rendering::FormulaView;

// Parts of the box along each side, and of the longest side where the shape is drawn thicker.
constexpr int kCells = 40;
constexpr int kCellsOfThicker = 80;
// The places of the surface are looked for in cells that are halved this often where it is fine.
constexpr int kLevels = 3;

// The cells of a tree that hold the surface.
struct SurfaceCells {
  std::vector<Box> boxes;
  // The number of those small cells through which a sheet passes that leaves all corners on one
  // side.
  std::size_t thin = 0;
};

SurfaceCells surface_cells(const FormulaView& formula, const Box& bounds) {
  CellTree tree(formula, bounds, kLevels);
  split_unclear(formula, tree, 1);
  SurfaceCells cells;
  tree.for_each_leaf([&](const Leaf& leaf) {
    const unsigned inside = tree.inside(leaf);
    const bool is_mixed = inside != 0 && inside != (1U << CellTree::kCorners) - 1;
    if (is_mixed || is_too_coarse(formula, tree, leaf)) {
      cells.boxes.push_back(
          {.lower = tree.corner(leaf.from),
           .upper = tree.corner(corner_of(leaf.from, leaf.size, CellTree::kCorners - 1))});
      cells.thin += is_mixed ? 0 : 1;
    }
  });
  return cells;
}

// The cells of a picture's grid that hold one of its vertices.
class DrawnCells {
 public:
  DrawnCells(const TriangleMesh& mesh, const Box& box)
      : lower_(box.lower), cell_((box.upper - box.lower) / kCells) {
    for (const rendering::Float3& v : mesh.vertices) {
      const Place at = place(rendering::to_vec3(v), 0);
      drawn_[index(at[0], at[1], at[2])] = true;
    }
  }

  // Returns true if the picture has a vertex in a box or hardly beside it.
  [[nodiscard]] bool is_drawn(const Box& box) const {
    constexpr int kBeside = 2;
    const Place first = place(box.lower, -kBeside);
    const Place last = place(box.upper, kBeside);
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) {
          if (drawn_[index(x, y, z)]) {
            return true;
          }
        }
      }
    }
    return false;
  }

 private:
  using Place = std::array<int, 3>;

  // Returns the cell of a point, moved by some cells along all axes.
  [[nodiscard]] Place place(const Vec3& p, int more) const {
    const Vec3 parts = (p - lower_).cwiseQuotient(cell_);
    const auto cell = [&](double part) {
      return std::clamp(static_cast<int>(std::floor(part)) + more, 0, kCells - 1);
    };
    return {cell(parts.x()), cell(parts.y()), cell(parts.z())};
  }
  static std::size_t index(int x, int y, int z) {
    constexpr std::size_t kRow = kCells;
    return (static_cast<std::size_t>(z) * kRow + static_cast<std::size_t>(y)) * kRow +
           static_cast<std::size_t>(x);
  }

  Vec3 lower_;
  Vec3 cell_;
  std::vector<bool> drawn_ = std::vector<bool>(std::size_t{kCells} * kCells * kCells);
};

TriangleMesh draw(const FormulaView& formula, const Box& box, int cells, double level) {
  return mesh_level_set([&](const Vec3& p) { return evaluate(formula, p) - level; }, box.lower,
                        box.upper, cells);
}

// Returns true if a picture of the box shows the zero and all places of the surface.
bool shows(const FormulaView& formula, const TriangleMesh& mesh, const Box& box, const Vec3& zero) {
  constexpr double kFewThin = 0.1;
  if (mesh.triangles.empty()) {
    return false;
  }
  const SurfaceCells cells = surface_cells(formula, box);
  const DrawnCells drawn(mesh, box);
  return drawn.is_drawn({.lower = zero, .upper = zero}) &&
         static_cast<double>(cells.thin) <= kFewThin * static_cast<double>(cells.boxes.size()) &&
         std::ranges::all_of(cells.boxes, [&](const Box& cell) { return drawn.is_drawn(cell); });
}

// Returns the largest |f| at a distance from a zero, along the axes.
double height_about(const FormulaView& formula, const Vec3& zero, double distance) {
  double highest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-distance, distance}) {
      const double f = evaluate(formula, zero + side * Vec3::Unit(axis));
      highest = std::max(highest, std::isfinite(f) ? std::abs(f) : 0.0);
    }
  }
  return highest;
}

// Draws the shape with about a cell more on all sides: where its distance from the surface is about
// that of a cell or less. The space beside a shape that fills the bounds is drawn wider in its
// stead.
FormulaPicture draw_thicker(const FormulaView& formula, const Box& bounds, const ZeroSearch& zero,
                            double unit_m) {
  constexpr double kLeastMore = 1e-3;
  Box box = bounds_of_zeros(formula, bounds);
  const double more = std::max((box.upper - box.lower).maxCoeff() / kCellsOfThicker,
                               kLeastMore * (bounds.upper - bounds.lower).maxCoeff());
  box.lower = (box.lower - Vec3::Constant(2.0 * more)).cwiseMax(bounds.lower);
  box.upper = (box.upper + Vec3::Constant(2.0 * more)).cwiseMin(bounds.upper);
  const double level = height_about(formula, zero.place, more);
  TriangleMesh mesh = draw(formula, box, kCellsOfThicker, level);
  if (mesh.triangles.empty()) {
    mesh = draw(formula, box, kCellsOfThicker, -level);
  }
  std::string note = fmt::format("its picture shows it about {:.2g} mm thicker than it is",
                                 kMillimetresPerMetre * unit_m * more);
  if (mesh.triangles.empty()) {
    const Box about{.lower = zero.place - Vec3::Constant(2.0 * more),
                    .upper = zero.place + Vec3::Constant(2.0 * more)};
    mesh = mesh_level_set([&](const Vec3& p) { return (p - zero.place).norm() - more; },
                          about.lower, about.upper, kCells);
    note = "it is too fine to be drawn, and its picture is a ball at one of its places";
  }
  return {.mesh = std::move(mesh), .notes = {std::move(note)}};
}

// Returns a note about a formula that keeps its sign.
std::string note_of_touch(const ZeroSearch& zero, const Box& bounds, rendering::Sides sides) {
  const std::string place = place_text(zero.place, bounds);
  if (zero.is_below && sides == rendering::Sides::one) {
    return fmt::format(
        "it touches 0 at {} and is below 0, which is solid, on all sides of it, so it is never "
        "felt; write sides = \"two\", or -(...) around the formula",
        place);
  }
  return fmt::format(
      "it touches 0 at {} and does not change its sign: it is felt as a wall without an inside",
      place);
}

}  // namespace

FormulaPicture draw_formula(const FormulaView& formula, const Box& bounds, double unit_m,
                            rendering::Sides sides) {
  // A shape that is this small beside its bounds is drawn in a grid that fits it, and so is one
  // that the grid of the bounds misses. Grids that are flatter than this are beyond the floats of a
  // picture.
  constexpr double kSmall = 0.25;
  constexpr double kFlattest = 1e-4;
  const ZeroSearch zero = search_zero(formula, bounds, unit_m);
  if (zero.kind == ZeroKind::touched) {
    FormulaPicture picture = draw_thicker(formula, bounds, zero, unit_m);
    picture.notes.insert(picture.notes.begin(), note_of_touch(zero, bounds, sides));
    return picture;
  }
  if (zero.kind != ZeroKind::crossed) {
    throw InputError(why_nowhere_zero(zero, bounds, unit_m));
  }
  const Box box = bounds_of_zeros(formula, bounds);
  const Vec3 size = box.upper - box.lower;
  if (size.maxCoeff() > kSmall * (bounds.upper - bounds.lower).maxCoeff()) {
    TriangleMesh mesh = draw(formula, bounds, kCells, 0.0);
    if (shows(formula, mesh, bounds, zero.place)) {
      return {.mesh = std::move(mesh), .notes = {}};
    }
  }
  if (size.minCoeff() > kFlattest * size.maxCoeff()) {
    TriangleMesh mesh = draw(formula, box, kCells, 0.0);
    if (shows(formula, mesh, box, zero.place)) {
      return {.mesh = std::move(mesh), .notes = {}};
    }
  }
  return draw_thicker(formula, bounds, zero, unit_m);
}

}  // namespace tactus::host
