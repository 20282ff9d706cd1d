// The mesh is made again with smaller cells, where it is too far from the surface, until it is near
// enough everywhere. The distance of a smooth surface from its chords falls to a quarter when a
// cell is split.
#include "host_tools/bake/formula/formula_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "host_tools/bake/formula/dual_contour.h"
#include "host_tools/bake/formula/fine_parts.h"
#include "host_tools/bake/formula/formula_warnings.h"
#include "host_tools/bake/formula/zero_bounds.h"
#include "host_tools/bake/formula/zero_search.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using rendering::Box;
using rendering::FormulaView;

// The number of times that a cell is split in which the surface is finer than the cell.
constexpr int kSplitsWhereUnclear = 5;

// Returns the distance from p within which the formula changes its sign, to twice of it, and no
// less than the tolerance. It looks along the normal of the triangle, which says nothing if the
// triangle has hardly an area, along the formula's gradient, which may be 0, and along the
// diagonals of a cube, which leave an edge of the surface to both sides. It looks no farther than
// `most`.
double distance_bound(const FormulaView& formula, const Vec3& p, const Vec3& across, double most,
                      double tolerance) {
  constexpr double kGrowth = 2.0;
  const bool inside = evaluate(formula, p) < 0.0;
  double bound = tolerance;
  const auto changes = [&](const Vec3& direction) {
    return (evaluate(formula, p + bound * direction) < 0.0) != inside ||
           (evaluate(formula, p - bound * direction) < 0.0) != inside;
  };
  const Vec3 normal = across.normalized();
  if (changes(normal)) {
    return bound;  // as at most places
  }
  const std::array directions{normal,
                              evaluate_gradient(formula, p).gradient.normalized(),
                              Vec3(1.0, 1.0, 1.0).normalized(),
                              Vec3(1.0, 1.0, -1.0).normalized(),
                              Vec3(1.0, -1.0, 1.0).normalized(),
                              Vec3(-1.0, 1.0, 1.0).normalized()};
  while (bound < most && std::ranges::none_of(directions, changes)) {
    bound *= kGrowth;
  }
  return bound;
}

// Returns the largest of those distances over the middles of a triangle and of its sides.
double distance_bound(const FormulaView& formula, const std::array<Vec3, 3>& corner,
                      double tolerance) {
  const Vec3 across = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const std::array samples{Vec3{(corner[0] + corner[1] + corner[2]) / 3.0},
                           Vec3{0.5 * (corner[0] + corner[1])}, Vec3{0.5 * (corner[1] + corner[2])},
                           Vec3{0.5 * (corner[2] + corner[0])}};
  double largest = 0.0;
  for (const Vec3& p : samples) {
    // The corners are on the surface.
    const double most =
        std::min({(p - corner[0]).norm(), (p - corner[1]).norm(), (p - corner[2]).norm()});
    largest =
        std::max(largest, std::min(most, distance_bound(formula, p, across, most, tolerance)));
  }
  return largest;
}

// The cells to be split so that the mesh comes near enough.
struct Splits {
  // The number of times that the cell of each vertex is split.
  std::vector<int> times;
  // The largest distance of the mesh from the surface, and the number of triangles to come.
  double distance = 0.0;
  double triangles = 0.0;
};

Splits splits_of(const FormulaView& formula, const ContourMesh& mesh, double tolerance) {
  constexpr double kMostTimes = 3.0;
  Splits splits{.times = std::vector<int>(mesh.vertices.size()),
                .triangles = static_cast<double>(mesh.triangles.size())};
  for (const rendering::TriangleIndices& t : mesh.triangles) {
    const double distance = distance_bound(
        formula, {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, tolerance);
    splits.distance = std::max(splits.distance, distance);
    if (distance <= tolerance) {
      continue;
    }
    const double times =
        std::clamp(std::ceil(0.5 * std::log2(distance / tolerance)), 1.0, kMostTimes);
    splits.triangles += std::exp2(2.0 * times);
    for (const std::uint32_t vertex : t) {
      if (mesh.cells[vertex].size > 1) {
        splits.times[vertex] = std::max(splits.times[vertex], static_cast<int>(times));
      }
    }
  }
  return splits;
}

// Throws InputError if there are more triangles to come than a mesh may have.
void require_few(const ContourMesh& mesh, const Splits& splits, const FormulaMeshPlan& plan) {
  if (splits.triangles > static_cast<double>(plan.most_triangles)) {
    throw InputError(fmt::format(
        "{} triangles come only within {:.2g} m of the formula's surface, and {} are the most; "
        "write a larger tolerance_m, narrower bounds, or contact = \"tracking\"",
        mesh.triangles.size(), splits.distance * plan.unit_m, plan.most_triangles));
  }
}

// Makes the mesh near enough to the surface, by splitting cells. At the finest grid, whose cells
// are smaller than the tolerance, it is left as it is.
ContourMesh near_mesh(const FormulaView& formula, CellTree& tree, const FormulaMeshPlan& plan) {
  const double tolerance = plan.tolerance_m / plan.unit_m;
  for (;;) {
    ContourMesh mesh = dual_contour(formula, tree);
    const Splits splits = splits_of(formula, mesh, tolerance);
    require_few(mesh, splits, plan);
    bool is_split = false;
    for (std::size_t i = 0; i < splits.times.size(); ++i) {
      tree.split(mesh.cells[i], splits.times[i]);
      is_split = is_split || splits.times[i] > 0;
    }
    if (!is_split) {
      return mesh;
    }
    if (plan.progress) {
      plan.progress(mesh.triangles.size());
    }
  }
}

// Cells in which the surface is hardly finer than the cell.
struct Cells {
  CellTree tree;
  // A place where it still is.
  std::optional<Vec3> unclear;
  // The side of the smallest of them, m.
  double smallest_m = 0.0;
};

Cells cut_into_cells(const FormulaView& formula, const Box& bounds, const FormulaMeshPlan& plan) {
  const double cell_m =
      (bounds.upper - bounds.lower).maxCoeff() * plan.unit_m / CellTree::kFirstCells;
  const int levels = std::max(kSplitsWhereUnclear,
                              static_cast<int>(std::ceil(std::log2(cell_m / plan.tolerance_m))));
  CellTree tree(formula, bounds, levels);
  const auto unclear = split_unclear(formula, tree, tree.first_size() >> kSplitsWhereUnclear);
  return {.tree = std::move(tree),
          .unclear = unclear,
          .smallest_m = std::ldexp(cell_m, -kSplitsWhereUnclear)};
}

// Returns bounds that hold all of the surface, if they are much smaller along an axis than those of
// the scene: a shape that is small or flat then has finer cells.
std::optional<Box> fitted_bounds(const FormulaView& formula, const Box& bounds) {
  constexpr double kMuch = 0.25;
  const Box box = bounds_of_zeros(formula, bounds);
  const bool is_smaller =
      ((box.upper - box.lower).array() < kMuch * (bounds.upper - bounds.lower).array()).any();
  return is_smaller ? std::optional(box) : std::nullopt;
}

// Throws InputError that says why a mesh is empty.
[[noreturn]] void fail_without_triangles(const FormulaView& formula, const Box& bounds,
                                         const FormulaMeshPlan& plan, const Cells& cells) {
  const ZeroSearch zero = search_zero(formula, bounds, plan.unit_m);
  throw InputError(zero.kind == ZeroKind::crossed
                       ? fmt::format("the surface at about {} is thinner than {:.2g} m; narrow the "
                                     "bounds, or write contact = \"tracking\"",
                                     place_text(cells.unclear.value_or(zero.place), bounds),
                                     cells.smallest_m)
                       : why_nowhere_zero(zero, bounds, plan.unit_m));
}

}  // namespace

ImportedMesh mesh_formula(const FormulaView& formula, const Box& bounds,
                          const FormulaMeshPlan& plan) {
  Cells cells = cut_into_cells(formula, bounds, plan);
  if (cells.unclear) {
    if (const auto fitted = fitted_bounds(formula, bounds)) {
      cells = cut_into_cells(formula, *fitted, plan);
    }
  }
  ContourMesh mesh = near_mesh(formula, cells.tree, plan);
  if (mesh.triangles.empty()) {
    fail_without_triangles(formula, bounds, plan, cells);
  }
  ImportedMesh result{.vertices = std::move(mesh.vertices), .triangles = std::move(mesh.triangles)};
  if (cells.unclear) {
    result.notes.push_back(fmt::format(
        "at about {}, in the formula's units, parts of its surface are nearer to each other than "
        "{:.2g} m, and the mesh may join them or leave one out; narrow the bounds, or write "
        "contact = \"tracking\"",
        place_text(*cells.unclear, bounds), cells.smallest_m));
  }
  return result;
}

}  // namespace tactus::host
