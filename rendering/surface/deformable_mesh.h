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
  // In the last tick and now; the two change places. One more than there may be, because a vertex
  // is read as four floats.
  alignas(16) std::array<Float3, kMaxDeformableVertices + 1> before{};
  alignas(16) std::array<Float3, kMaxDeformableVertices + 1> now{};
  alignas(16) std::array<Float3, kMaxDeformableVertices> wanted;  // by the outside
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

  // Returns where `count` vertices from `first` on are wanted, for the caller to write: frame O, m,
  // each within kWorldBound_m. They move there from the next tick on, as by move_vertex().
  std::span<Float3> want(std::size_t first, std::size_t count) {
    asked_ = true;
    return wanted_.subspan(first, count);
  }

  // Begins a tick: vertices take their step, and as many boxes are refitted as the steps make
  // necessary, at most kRefitNodes. Returns the cost units that it took (tick_budget.h).
  std::size_t begin_tick();

  [[nodiscard]] MeshView now() const { return {now_, triangles_, nodes_}; }
  [[nodiscard]] MeshView before() const { return {before_, triangles_, nodes_}; }
  // Returns how far, in metres, a vertex of now() or before() may be outside the box of a node
  // above it.
  [[nodiscard]] double slack_m() const { return moved_in_last_pass_m_ + moved_in_pass_m_; }
  // Returns the largest motion of a vertex from `before` to `now`, m; never less, and more by at
  // most a millionth.
  [[nodiscard]] double step_m() const { return step_m_; }

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  // Moves every vertex from `before` toward where it is wanted, and sets step_m_. Returns the cost
  // units.
  std::size_t take_step();
  // Does so for steps of which some are longer than kMaxVertexStep_m.
  void take_long_step();
  // Returns the number of boxes to refit in this tick.
  [[nodiscard]] std::size_t boxes_due() const;
  // Draws the box of a node about its children's, or about its triangles.
  void refit(BvhNode& node) const;

  std::span<Float3> before_;
  std::span<Float3> now_;
  std::span<Float3> wanted_;
  std::span<BvhNode> nodes_;
  std::span<const TriangleIndices> triangles_;
  std::size_t nodes_left_ = 0;  // of this pass, from the leaves to the root
  // The motion of the vertices after which a pass is to be complete, m.
  double motion_per_pass_m_ = 0.0;
  double moved_in_pass_m_ = 0.0;
  double moved_in_last_pass_m_ = 0.0;
  double step_m_ = 0.0;
  bool asked_ = false;  // some vertex is not yet where it is wanted
};

}  // namespace tactus::rendering
