#include "host_tools/bake/formula/dual_contour.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tactus::host {
namespace {

using rendering::FormulaView;

constexpr unsigned kCorners = CellTree::kCorners;
constexpr unsigned kAllCorners = (1U << kCorners) - 1;
constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

// Returns the zero between two points, of which the formula is below 0 at `in` alone, to a small
// part of their distance. The method is the Illinois one (Dowell and Jarratt, BIT 11, 1971): the
// secant, with the value halved at an end that stays twice.
Vec3 zero_between(const FormulaView& formula, const Vec3& in, const Vec3& out) {
  constexpr int kMostSteps = 60;
  constexpr double kExact = 1e-11;
  double low = 0.0;
  double high = 1.0;
  double at_low = evaluate(formula, in);
  double at_high = evaluate(formula, out);
  double t = 1.0;
  for (int i = 0; i < kMostSteps; ++i) {
    const double before = t;
    const double secant = low - at_low * (high - low) / (at_high - at_low);
    t = secant > low && secant < high ? secant : 0.5 * (low + high);
    if (std::abs(t - before) < kExact) {
      break;
    }
    const double value = evaluate(formula, in + t * (out - in));
    const bool is_low = value < 0.0;
    const bool stays = is_low == (before == low);
    (is_low ? low : high) = t;
    (is_low ? at_low : at_high) = value;
    if (stays && i > 0) {
      (is_low ? at_high : at_low) *= 0.5;
    }
  }
  return in + t * (out - in);
}

Vec3 unit_or_zero(const Vec3& v) {
  const double length = v.norm();
  return length > 0.0 && std::isfinite(length) ? Vec3{v / length} : Vec3{Vec3::Zero()};
}

// The lowest and the highest corner of a cell.
struct Corners {
  Vec3 low;
  Vec3 high;
};

Corners corners_of(const CellTree& tree, const Leaf& leaf) {
  return {tree.corner(leaf.from), tree.corner(corner_of(leaf.from, leaf.size, kCorners - 1))};
}

// The tangent planes of the surface at the edges of a cell.
struct TangentPlanes {
  Mat3 normals_squared = Mat3::Zero();
  Vec3 offsets = Vec3::Zero();
  Vec3 places = Vec3::Zero();
  Vec3 normals = Vec3::Zero();
  int count = 0;

  void add(const Vec3& place, const Vec3& normal) {
    normals_squared += normal * normal.transpose();
    offsets += normal.dot(place) * normal;
    places += place;
    normals += normal;
    ++count;
  }

  [[nodiscard]] Vec3 middle() const { return places / count; }

  // Returns the point nearest to the middle with the least sum of squared distances from the
  // planes. Directions in which the planes hardly differ count as free: there the point stays in
  // the middle.
  [[nodiscard]] Vec3 meeting_point() const {
    constexpr double kFree = 1e-3;
    const Vec3 off = offsets - normals_squared * middle();
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(normals_squared);
    Vec3 point = middle();
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double weight = axes.eigenvalues()[k];
      if (weight > kFree * axes.eigenvalues()[2]) {
        const Vec3 axis = axes.eigenvectors().col(k);
        point += axis.dot(off) / weight * axis;
      }
    }
    return point;
  }
};

// An edge on which the formula changes its sign, and the vertices of the cells round it, in the
// order of a right-handed turn about its axis.
struct CrossedEdge {
  std::array<std::uint32_t, 4> vertices{};
  // True if the formula is below 0 at the lower end.
  bool rises = false;
};

class Contour {
 public:
  Contour(const FormulaView& formula, const CellTree& tree)
      : formula_(formula), tree_(tree), vertex_of_(tree.size(), kNoVertex) {}

  ContourMesh mesh() {
    tree_.for_each_leaf([&](const Leaf& leaf) {
      const unsigned inside = tree_.inside(leaf);
      for (unsigned k = 0; k < kCorners && inside != 0 && inside != kAllCorners; ++k) {
        for (unsigned axis = 0; axis < 3; ++axis) {
          const unsigned next = k | 1U << axis;
          if (next != k && (inside >> k & 1U) != (inside >> next & 1U)) {
            look_at_edge(leaf, k, axis);
          }
        }
      }
    });
    place_vertices();
    for (const CrossedEdge& edge : edges_) {
      add_quadrilateral(edge);
    }
    return std::move(mesh_);
  }

 private:
  // Looks at the edge from corner k of a leaf along an axis. The first of the smallest cells round
  // it takes it.
  void look_at_edge(const Leaf& leaf, unsigned k, unsigned axis) {
    constexpr std::array<std::array<int, 2>, 4> kRound{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
    const GridPlace from = corner_of(leaf.from, leaf.size, k);
    const GridPlace to = corner_of(leaf.from, leaf.size, k | 1U << axis);
    std::array<Leaf, 4> round;
    bool is_found = false;
    for (std::size_t i = 0; i < round.size(); ++i) {
      GridPlace cell = from;
      cell[axis] += leaf.size / 2;
      cell[(axis + 1) % 3] += kRound[i][0];
      cell[(axis + 2) % 3] += kRound[i][1];
      const auto found = tree_.leaf_at(cell);
      if (!found || found->size < leaf.size ||
          (!is_found && found->size == leaf.size && found->node != leaf.node)) {
        return;  // the surface ends at the bounds, or another cell takes the edge
      }
      is_found = is_found || found->node == leaf.node;
      round[i] = *found;
    }
    add_edge(round, tree_.corner(from), tree_.corner(to), (tree_.inside(leaf) >> k & 1U) != 0);
  }

  void add_edge(const std::array<Leaf, 4>& round, const Vec3& from, const Vec3& to, bool rises) {
    const Vec3 place = rises ? zero_between(formula_, from, to) : zero_between(formula_, to, from);
    const Vec3 normal = unit_or_zero(evaluate_gradient(formula_, place).gradient);
    CrossedEdge& edge = edges_.emplace_back(CrossedEdge{.rises = rises});
    for (std::size_t i = 0; i < round.size(); ++i) {
      edge.vertices[i] = vertex_of(round[i]);
      const bool is_again = i > 0 && edge.vertices[i] == edge.vertices[i - 1];
      if (!is_again && (i < 3 || edge.vertices[3] != edge.vertices[0])) {
        planes_[edge.vertices[i]].add(place, normal);
      }
    }
  }

  std::uint32_t vertex_of(const Leaf& leaf) {
    std::uint32_t& vertex = vertex_of_[leaf.node];
    if (vertex == kNoVertex) {
      vertex = static_cast<std::uint32_t>(planes_.size());
      planes_.emplace_back();
      mesh_.cells.push_back(leaf);
    }
    return vertex;
  }

  // Puts each vertex where the tangent planes of its cell meet, and then onto the surface.
  void place_vertices() {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const auto& [low, high] = corners_of(tree_, mesh_.cells[i]);
      const Vec3 vertex = kept_near(planes_[i], low, high);
      const auto on_surface = surface_along(formula_, vertex, unit_or_zero(planes_[i].normals),
                                            0.5 * (high - low).maxCoeff());
      mesh_.vertices.push_back(on_surface.value_or(vertex));
    }
  }

  // Returns the point where the planes meet if that is in the cell between two corners, or beside
  // it in a cell without a vertex: there an edge of the surface comes through the side of the cell.
  // Otherwise it returns the nearest point of the cell.
  [[nodiscard]] Vec3 kept_near(const TangentPlanes& planes, const Vec3& low,
                               const Vec3& high) const {
    const Vec3 point = planes.meeting_point();
    if (!point.allFinite()) {
      return planes.middle();
    }
    const Vec3 nearest = point.cwiseMax(low).cwiseMin(high);
    const bool is_beside = ((point - nearest).cwiseAbs().array() < (high - low).array()).all();
    const auto leaf = is_beside ? tree_.leaf_about(point) : std::nullopt;
    return leaf && vertex_of_[leaf->node] == kNoVertex ? point : nearest;
  }

  // Cuts the quadrilateral along the diagonal on which the formula is nearer to 0.
  void add_quadrilateral(const CrossedEdge& edge) {
    const auto& v = edge.vertices;
    const auto off = [&](std::uint32_t a, std::uint32_t b) {
      return std::abs(evaluate(formula_, 0.5 * (mesh_.vertices[a] + mesh_.vertices[b])));
    };
    const bool is_triangle = v[0] == v[1] || v[1] == v[2] || v[2] == v[3] || v[3] == v[0];
    if (is_triangle || off(v[0], v[2]) <= off(v[1], v[3])) {
      add_triangle(v[0], v[1], v[2], edge.rises);
      add_triangle(v[0], v[2], v[3], edge.rises);
    } else {
      add_triangle(v[0], v[1], v[3], edge.rises);
      add_triangle(v[1], v[2], v[3], edge.rises);
    }
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool rises) {
    if (a != b && b != c && c != a) {
      mesh_.triangles.push_back(rises ? rendering::TriangleIndices{a, b, c}
                                      : rendering::TriangleIndices{a, c, b});
    }
  }

  const FormulaView& formula_;
  const CellTree& tree_;
  // The vertex of each node, and the planes of each vertex.
  std::vector<std::uint32_t> vertex_of_;
  std::vector<TangentPlanes> planes_;
  std::vector<CrossedEdge> edges_;
  ContourMesh mesh_;
};

}  // namespace

ContourMesh dual_contour(const FormulaView& formula, const CellTree& tree) {
  return Contour(formula, tree).mesh();
}

std::optional<Vec3> surface_along(const FormulaView& formula, const Vec3& p, const Vec3& direction,
                                  double most) {
  constexpr int kDoublings = 16;
  const bool inside = evaluate(formula, p) < 0.0;
  for (int i = kDoublings; i >= 0; --i) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 end = p + side * std::ldexp(most, -i) * direction;
      if ((evaluate(formula, end) < 0.0) != inside) {
        return inside ? zero_between(formula, p, end) : zero_between(formula, end, p);
      }
    }
  }
  return std::nullopt;
}

}  // namespace tactus::host
