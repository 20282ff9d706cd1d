// A mesh whose vertices are moved from outside while the loop runs. Its hierarchy follows a bounded
// number of nodes per tick; `slack_m` covers the boxes that wait.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// Memory for the meshes of a scene that deform, one after another.
struct DeformablePool {
  std::array<Float3, kMaxDeformableVertices> before;  // in the last tick
  // One more than there may be, because a vertex is read as four floats.
  std::array<Float3, kMaxDeformableVertices + 1> now{};
  std::array<Float3, kMaxDeformableVertices> wanted;  // by the outside
  std::array<BvhNode, kMaxDeformableNodes> nodes;
  std::size_t vertices_used = 0;
  std::size_t nodes_used = 0;
};

// Everything is in the object's own frame O. No heap; one thread.
class DeformableMesh {
 public:
  // Starts as `rest`, with memory from the pool; both must stay alive. Returns false if the pool
  // has too little left.
  bool start(const MeshView& rest, DeformablePool& pool);

  // Moves a vertex to p_O (m) from the next tick on, by at most kMaxVertexStep_m per tick. Returns
  // false, and changes nothing, if there is no such vertex or a number is not finite or beyond
  // kWorldBound_m.
  bool move_vertex(std::uint32_t vertex, const Vec3& p_O);

  // Begins a tick: vertices take their step, and kRefitNodes boxes are refitted. Returns the cost
  // units that it took (tick_budget.h).
  std::size_t begin_tick();

  [[nodiscard]] MeshView now() const { return {now_, triangles_, nodes_}; }
  [[nodiscard]] MeshView before() const { return {before_, triangles_, nodes_}; }
  // Returns how far, in metres, a vertex of now() or before() may be outside the box of a node
  // above it.
  [[nodiscard]] double slack_m() const { return moved_in_last_pass_m_ + moved_in_pass_m_; }
  // Returns the largest motion of a vertex from `before` to `now`, m.
  [[nodiscard]] double step_m() const { return step_m_; }

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  // Moves every vertex toward where it is wanted; returns the longest of the steps, m.
  double take_step();
  // Draws the box of a node about its children's, or about its triangles.
  void refit(BvhNode& node) const;

  std::span<Float3> before_;
  std::span<Float3> now_;
  std::span<Float3> wanted_;
  std::span<BvhNode> nodes_;
  std::span<const TriangleIndices> triangles_;
  std::size_t nodes_left_ = 0;  // of this pass, from the leaves to the root
  double moved_in_pass_m_ = 0.0;
  double moved_in_last_pass_m_ = 0.0;
  double step_m_ = 0.0;
  bool asked_ = false;  // some vertex is not yet where it is wanted
};

}  // namespace tactus::rendering
