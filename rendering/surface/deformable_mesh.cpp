#include "rendering/surface/deformable_mesh.h"

#include <algorithm>
#include <limits>

namespace tactus::rendering {
namespace {

Float3 least_corner(const Float3& a, const Float3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

Float3 greatest(const Float3& a, const Float3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
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
  moved_in_pass_m_ = moved_in_last_pass_m_ = step_m_ = 0.0;
  asked_ = false;
  return true;
}

bool DeformableMesh::move_vertex(std::uint32_t vertex, const Vec3& p_O) {
  if (vertex >= wanted_.size() ||
      !(p_O.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m)) {
    return false;
  }
  wanted_[vertex] = to_float3(p_O);
  asked_ = true;
  return true;
}

double DeformableMesh::take_step() {
  double longest = 0.0;
  asked_ = false;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    if (now_[i] == wanted_[i]) {
      continue;
    }
    const Vec3 from = to_vec3(now_[i]);
    const Vec3 step = to_vec3(wanted_[i]) - from;
    const double length = step.norm();
    if (length <= kMaxVertexStep_m) {
      now_[i] = wanted_[i];
    } else {
      now_[i] = to_float3(from + kMaxVertexStep_m / length * step);
      asked_ = true;
    }
    longest = std::max(longest, (to_vec3(now_[i]) - from).norm());
  }
  return longest;
}

void DeformableMesh::begin_tick() {
  if (step_m_ > 0.0) {
    std::ranges::copy(now_, before_.begin());
  }
  step_m_ = asked_ ? take_step() : 0.0;
  moved_in_pass_m_ += step_m_;
  if (slack_m() <= 0.0) {
    return;
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
}

void DeformableMesh::refit(BvhNode& node) const {
  if (!node.is_leaf()) {
    node.lower = least_corner(nodes_[node.first].lower, nodes_[node.first + 1].lower);
    node.upper = greatest(nodes_[node.first].upper, nodes_[node.first + 1].upper);
    return;
  }
  constexpr float kFar = std::numeric_limits<float>::infinity();
  node.lower = {kFar, kFar, kFar};
  node.upper = {-kFar, -kFar, -kFar};
  for (const TriangleIndices& corners : triangles_.subspan(node.first, node.triangle_count)) {
    for (const std::uint32_t corner : corners) {
      node.lower = least_corner(node.lower, now_[corner]);
      node.upper = greatest(node.upper, now_[corner]);
    }
  }
}

}  // namespace tactus::rendering
