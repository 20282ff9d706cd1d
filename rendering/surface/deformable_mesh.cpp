#include "rendering/surface/deformable_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "rendering/geometry/floats.h"
#include "rendering/tick_budget.h"

namespace tactus::rendering {
namespace {

// A pass over the boxes is complete when the vertices have moved by this share of a leaf's length,
// so that the slack is never much more than twice that: searches then look at few leaves for
// nothing.
constexpr double kMotionPerPass = 1.0 / 8.0;
// The boxes that are refitted in any tick with a slack, so that it vanishes when the motion ends.
constexpr std::size_t kLeastRefitNodes = 32;

// Returns the mean of the longest sides of the leaves' boxes, m.
double mean_leaf_length(std::span<const BvhNode> nodes) {
  double sum = 0.0;
  double count = 0.0;
  for (const BvhNode& node : nodes) {
    if (node.is_leaf()) {
      sum += (to_vec3(node.upper) - to_vec3(node.lower)).maxCoeff();
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

// A box as it is drawn: the fourth lane of each corner is of no meaning.
struct DrawnBox {
  Floats lower;
  Floats upper;

  // Grows to hold another box, or a point that is both of its corners.
  void add(Floats other_lower, Floats other_upper) {
    lower = least(lower, other_lower);
    upper = most(upper, other_upper);
  }

  // Sets the corners of a node.
  void store(BvhNode& node) const {
    node.lower = {lower[0], lower[1], lower[2]};
    node.upper = {upper[0], upper[1], upper[2]};
  }
};

// Returns the square of the longest of the steps between two rows of vertices, m^2, to within seven
// roundings. They are read as rows of floats, four vertices at a time; the last up to three are
// left to the caller. Both rows are aligned if kAligned, which makes their loads a part of what
// uses them.
template <bool kAligned>
float longest_squared(std::span<const Float3> from, std::span<const Float3> to) {
  const auto load = [](const float* place) {
    return kAligned ? aligned_floats_at(place) : floats_at(place);
  };
  Floats longest = all(0.0F);
  for (std::size_t i = 0; i + 4 <= from.size(); i += 4) {
    const float* const a = &from[i].x;
    const float* const b = &to[i].x;
    Floats u = load(b) - load(a);          // x0 y0 z0 x1
    Floats v = load(b + 4) - load(a + 4);  // y1 z1 x2 y2
    Floats w = load(b + 8) - load(a + 8);  // z2 x3 y3 z3
    u *= u;
    v *= v;
    w *= w;
    // Lane k of each of three rows has one of the squares of vertex k.
    const Floats uv = __builtin_shufflevector(u, v, 1, 2, 4, 5);
    const Floats vw = __builtin_shufflevector(v, w, 2, 3, 6, 7);
    longest = most(longest, __builtin_shufflevector(u, w, 0, 3, 4, 5) +
                                __builtin_shufflevector(uv, vw, 0, 2, 4, 6) +
                                __builtin_shufflevector(uv, vw, 1, 3, 5, 7));
  }
  return std::max({longest[0], longest[1], longest[2], longest[3]});
}

// Returns true if vertices begin at a multiple of four floats' size: those of a scene's first mesh
// do, and of every other one behind a multiple of four.
bool is_aligned(std::span<const Float3> vertices) {
  return reinterpret_cast<std::uintptr_t>(vertices.data()) % alignof(Floats) == 0;
}

}  // namespace

bool DeformableMesh::start(const MeshView& rest, DeformablePool& pool) {
  const std::size_t vertices = rest.vertices.size();
  if (vertices > kMaxDeformableVertices - pool.vertices_used ||
      rest.nodes.size() > kMaxDeformableNodes - pool.nodes_used) {
    return false;
  }
  before_ = std::span(pool.before).subspan(pool.vertices_used, vertices);
  now_ = std::span(pool.now).subspan(pool.vertices_used, vertices);
  wanted_ = std::span(pool.wanted).subspan(pool.vertices_used, vertices);
  nodes_ = std::span(pool.nodes).subspan(pool.nodes_used, rest.nodes.size());
  pool.vertices_used += vertices;
  pool.nodes_used += rest.nodes.size();
  triangles_ = rest.triangles;
  for (const std::span<Float3> to : {before_, now_, wanted_}) {
    std::ranges::copy(rest.vertices, to.begin());
  }
  std::ranges::copy(rest.nodes, nodes_.begin());
  nodes_left_ = nodes_.size();
  motion_per_pass_m_ = kMotionPerPass * mean_leaf_length(nodes_);
  moved_in_pass_m_ = moved_in_last_pass_m_ = step_m_ = 0.0;
  asked_ = false;
  return true;
}

bool DeformableMesh::move_vertex(std::uint32_t vertex, const Vec3& p_O) {
  if (vertex >= wanted_.size() || !(p_O.array().abs() <= kWorldBound_m).all()) {
    return false;
  }
  wanted_[vertex] = to_float3(p_O);
  asked_ = true;
  return true;
}

std::size_t DeformableMesh::take_step() {
  const std::size_t cost = now_.size() / kVertexStepsPerUnit;
  // More than the roundings of the square, and than a step whose square vanishes.
  constexpr double kRounding = 1.0 + 0x1p-20;
  constexpr double kVanishes_m = 1e-19;
  float squared = is_aligned(before_) && is_aligned(wanted_)
                      ? longest_squared<true>(before_, wanted_)
                      : longest_squared<false>(before_, wanted_);
  for (std::size_t i = now_.size() / 4 * 4; i < now_.size(); ++i) {
    const Vec3 step = to_vec3(wanted_[i]) - to_vec3(before_[i]);
    squared = std::max(squared, static_cast<float>(step.squaredNorm()));
  }
  const double longest_m = kRounding * std::sqrt(static_cast<double>(squared)) + kVanishes_m;
  if (longest_m > kMaxVertexStep_m) {
    take_long_step();
    return cost + now_.size() / kVertexLongStepsPerUnit;
  }
  asked_ = false;
  const bool any = squared > 0.0F || !std::ranges::equal(before_, wanted_);
  step_m_ = any ? longest_m : 0.0;
  std::ranges::copy(wanted_, now_.begin());
  return cost;
}

void DeformableMesh::take_long_step() {
  constexpr double kSquaredMost = kMaxVertexStep_m * kMaxVertexStep_m;
  double longest_squared = 0.0;
  asked_ = false;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const Vec3 from = to_vec3(before_[i]);
    const Vec3 step = to_vec3(wanted_[i]) - from;
    const double squared = step.squaredNorm();
    if (squared <= kSquaredMost) {
      now_[i] = wanted_[i];
      longest_squared = std::max(longest_squared, squared);
    } else {
      now_[i] = to_float3(from + kMaxVertexStep_m / std::sqrt(squared) * step);
      longest_squared = std::max(longest_squared, (to_vec3(now_[i]) - from).squaredNorm());
      asked_ = true;
    }
  }
  step_m_ = std::sqrt(longest_squared);
}

// The share of the boxes that is done follows the share of the motion of a pass.
std::size_t DeformableMesh::boxes_due() const {
  const double share =
      moved_in_pass_m_ < motion_per_pass_m_ ? moved_in_pass_m_ / motion_per_pass_m_ : 1.0;
  const auto wanted = static_cast<std::size_t>(share * static_cast<double>(nodes_.size()));
  const std::size_t done = nodes_.size() - nodes_left_;
  const std::size_t late = wanted > done ? wanted - done : 0;
  return std::min({std::max(late, kLeastRefitNodes), kRefitNodes, nodes_left_});
}

std::size_t DeformableMesh::begin_tick() {
  std::size_t step_cost = 0;
  if (asked_) {
    std::swap(before_, now_);
    step_cost = take_step();
  } else if (step_m_ > 0.0) {
    std::ranges::copy(now_, before_.begin());
    step_m_ = 0.0;
  }
  moved_in_pass_m_ += step_m_;
  if (slack_m() <= 0.0) {
    return step_cost;
  }
  // Children stand after their parents, so from the back to the front each node finds its children
  // done.
  const std::size_t count = boxes_due();
  for (std::size_t k = 0; k < count; ++k) {
    refit(nodes_[--nodes_left_]);
  }
  if (nodes_left_ == 0) {
    nodes_left_ = nodes_.size();
    moved_in_last_pass_m_ = moved_in_pass_m_;
    moved_in_pass_m_ = 0.0;
  }
  return step_cost + count / kRefitsPerUnit;
}

void DeformableMesh::refit(BvhNode& node) const {
  if (!node.is_leaf()) {
    const BvhNode& left = nodes_[node.first];
    const BvhNode& right = nodes_[node.first + 1];
    DrawnBox box{.lower = floats_at(&left.lower.x), .upper = floats_at(&left.upper.x)};
    box.add(floats_at(&right.lower.x), floats_at(&right.upper.x));
    box.store(node);
    return;
  }
  const Floats first = floats_at(&now_[triangles_[node.first][0]].x);
  DrawnBox box{.lower = first, .upper = first};
  for (const TriangleIndices& corners : triangles_.subspan(node.first, node.triangle_count)) {
    for (const std::uint32_t corner : corners) {
      const Floats vertex = floats_at(&now_[corner].x);
      box.add(vertex, vertex);
    }
  }
  box.store(node);
}

}  // namespace tactus::rendering
