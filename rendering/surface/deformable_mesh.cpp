#include "rendering/surface/deformable_mesh.h"

#include <algorithm>
#include <cmath>

#include "rendering/geometry/floats.h"
#include "rendering/tick_budget.h"

namespace tactus::rendering {
namespace {

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

double DeformableMesh::take_step() {
  constexpr double kSquaredMost = kMaxVertexStep_m * kMaxVertexStep_m;
  double longest_squared = 0.0;
  asked_ = false;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const Vec3 from = to_vec3(now_[i]);
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
  return std::sqrt(longest_squared);
}

std::size_t DeformableMesh::begin_tick() {
  if (step_m_ > 0.0) {
    std::ranges::copy(now_, before_.begin());
  }
  const std::size_t step_cost = asked_ ? now_.size() / kVertexStepsPerUnit : 0;
  step_m_ = asked_ ? take_step() : 0.0;
  moved_in_pass_m_ += step_m_;
  if (slack_m() <= 0.0) {
    return step_cost;
  }
  // Children stand after their parents, so from the back to the front each node finds its children
  // done.
  const std::size_t count = std::min(kRefitNodes, nodes_left_);
  for (std::size_t k = 0; k < count; ++k) {
    refit(nodes_[--nodes_left_]);
  }
  if (nodes_left_ == 0) {
    nodes_left_ = nodes_.size();
    moved_in_last_pass_m_ = moved_in_pass_m_;
    moved_in_pass_m_ = 0.0;
  }
  return step_cost + count * kCostOfRefit;
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
