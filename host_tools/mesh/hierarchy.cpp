#include "host_tools/mesh/hierarchy.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "rendering/limits.h"

namespace tactus::host {
namespace {

using rendering::BvhNode;
using rendering::Float3;
using rendering::TriangleIndices;

// A range of at most this many triangles becomes a leaf without asking the heuristic.
constexpr std::uint32_t kLeafTriangles = 4;
// Planes are tried at the borders of this many bins along each axis; Wald found that 16 bins lose
// hardly anything against trying every triangle.
constexpr std::size_t kBins = 16;
// Ranges at this level and deeper are halved by count, which bounds the depth: the 24 levels that
// are left hold 2^(64-40) leaves. Above it the heuristic may peel off one triangle at a time.
constexpr std::uint32_t kBalancedFromLevel = 40;

using Point = std::array<float, 3>;

// An axis-aligned box, m, world frame; a new one is empty.
struct Box {
  Point lower{std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
              std::numeric_limits<float>::max()};
  Point upper{std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest(),
              std::numeric_limits<float>::lowest()};

  void grow(const Point& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
  // An empty box adds nothing, since its limits are reversed.
  void grow(const Box& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], b.lower[k]);
      upper[k] = std::max(upper[k], b.upper[k]);
    }
  }
  // Returns half of the surface, m^2. The heuristic compares costs, so a common factor does not
  // matter.
  [[nodiscard]] float half_area() const {
    const float x = upper[0] - lower[0];
    const float y = upper[1] - lower[1];
    const float z = upper[2] - lower[2];
    return x * y + y * z + z * x;
  }
};

// A triangle as the builder sees it: its box, the box's centre and its index in the caller's list.
struct Primitive {
  Box box;
  Point centre;
  std::uint32_t triangle;
};

// A node whose triangles, from `begin` up to but not with `end`, are still to be divided.
struct Range {
  std::uint32_t node;
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t level;
};

// The triangles whose centres lie in a slice of the range.
struct Bin {
  Box box;
  std::uint32_t count = 0;
};

// A way to divide a range in two.
struct Split {
  std::size_t axis = 0;
  // Bins up to and including this one go to the left child.
  std::size_t bin = 0;
  // Estimated cost of a ray or query: sum over both children of half area times triangles.
  float cost = std::numeric_limits<float>::max();
};

std::vector<Primitive> make_primitives(std::span<const Float3> vertices,
                                       std::span<const TriangleIndices> triangles) {
  std::vector<Primitive> primitives(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Primitive& p = primitives[i];
    p.triangle = static_cast<std::uint32_t>(i);
    for (const std::uint32_t v : triangles[i]) {
      p.box.grow(Point{vertices[v].x, vertices[v].y, vertices[v].z});
    }
    for (std::size_t k = 0; k < 3; ++k) {
      p.centre[k] = 0.5F * p.box.lower[k] + 0.5F * p.box.upper[k];
    }
  }
  return primitives;
}

// Returns the bin in which a triangle's centre lies; both passes call it, so that counting and
// dividing agree to the bit.
std::size_t bin_of(const Primitive& p, std::size_t axis, const Box& centres) {
  const float extent = centres.upper[axis] - centres.lower[axis];
  const float place = (p.centre[axis] - centres.lower[axis]) / extent;
  return std::min(kBins - 1, static_cast<std::size_t>(place * static_cast<float>(kBins)));
}

// Returns the cheapest of the planes between bins along one axis; its cost is the largest number if
// all centres coincide on that axis. One pass from the right prepares the right side's costs, one
// from the left completes them.
Split best_split_on(std::size_t axis, std::span<const Primitive> primitives, const Box& centres) {
  Split best{.axis = axis};
  if (!(centres.upper[axis] > centres.lower[axis])) {
    return best;
  }
  std::array<Bin, kBins> bins;
  for (const Primitive& p : primitives) {
    Bin& bin = bins[bin_of(p, axis, centres)];
    bin.box.grow(p.box);
    ++bin.count;
  }
  std::array<float, kBins> right_cost{};
  Box right;
  std::uint32_t right_count = 0;
  for (std::size_t i = kBins - 1; i > 0; --i) {
    right.grow(bins[i].box);
    right_count += bins[i].count;
    right_cost[i] = right_count == 0 ? 0.0F : right.half_area() * static_cast<float>(right_count);
  }
  Box left;
  std::uint32_t left_count = 0;
  for (std::size_t i = 0; i + 1 < kBins; ++i) {
    left.grow(bins[i].box);
    left_count += bins[i].count;
    if (left_count == 0 || left_count == primitives.size()) {
      continue;
    }
    const float cost = left.half_area() * static_cast<float>(left_count) + right_cost[i + 1];
    if (cost < best.cost) {
      best.cost = cost;
      best.bin = i;
    }
  }
  return best;
}

// Moves the primitives of the left child to the front and returns their number; both sides always
// get at least one. stable_partition keeps the order of equal triangles, so that the result does
// not depend on the library's algorithm.
std::size_t partition(std::span<Primitive> primitives, std::uint32_t level) {
  Box centres;
  for (const Primitive& p : primitives) {
    centres.grow(p.centre);
  }
  Split best;
  if (level < kBalancedFromLevel) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Split split = best_split_on(axis, primitives, centres);
      best = split.cost < best.cost ? split : best;
    }
  }
  if (best.cost == std::numeric_limits<float>::max()) {
    return primitives.size() / 2;
  }
  const auto right = std::ranges::stable_partition(
      primitives, [&](const Primitive& p) { return bin_of(p, best.axis, centres) <= best.bin; });
  return static_cast<std::size_t>(right.begin() - primitives.begin());
}

// Returns a node with the box of the primitives; the caller fills in children or triangles.
BvhNode make_node(std::span<const Primitive> primitives) {
  Box box;
  for (const Primitive& p : primitives) {
    box.grow(p.box);
  }
  return {.lower = {box.lower[0], box.lower[1], box.lower[2]},
          .first = 0,
          .upper = {box.upper[0], box.upper[1], box.upper[2]},
          .triangle_count = 0};
}

}  // namespace

Hierarchy build_hierarchy(std::span<const Float3> vertices,
                          std::span<const TriangleIndices> triangles) {
  std::vector<Primitive> primitives = make_primitives(vertices, triangles);
  Hierarchy result;
  result.nodes.reserve(triangles.size());
  result.nodes.push_back(make_node(primitives));
  std::vector<Range> open{{0, 0, static_cast<std::uint32_t>(primitives.size()), 1}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    const std::uint32_t count = range.end - range.begin;
    if (count <= kLeafTriangles) {
      result.nodes[range.node].first = range.begin;
      result.nodes[range.node].triangle_count = count;
      continue;
    }
    const std::span<Primitive> all{primitives};
    const auto left_count =
        static_cast<std::uint32_t>(partition(all.subspan(range.begin, count), range.level));
    const std::uint32_t middle = range.begin + left_count;
    const auto left = static_cast<std::uint32_t>(result.nodes.size());
    result.nodes[range.node].first = left;
    result.nodes.push_back(make_node(all.subspan(range.begin, left_count)));
    result.nodes.push_back(make_node(all.subspan(middle, count - left_count)));
    open.push_back({left + 1, middle, range.end, range.level + 1});
    open.push_back({left, range.begin, middle, range.level + 1});
  }
  result.order.resize(primitives.size());
  std::ranges::transform(primitives, result.order.begin(), &Primitive::triangle);
  return result;
}

}  // namespace tactus::host
