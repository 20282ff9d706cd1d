// The share of each step that an iteration to a fixed point takes: as much as converges quickly
// while the tool moves, and less and less under a tool at rest, so that the iteration ends also
// where there is no fixed point, as between two bumps or on the edge of two faces. ForceShading has
// one.
#pragma once

#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// A residual is the step that the plain iteration would take, m.
class Relaxation {
 public:
  // Begins a tick in which the tool moved by `moved_m` beside the surface. If `continues`, the
  // residual of the last tick still counts.
  void begin_tick(double moved_m, bool continues);

  // Forgets the residuals, but not how long the tool has been at rest.
  void restart();

  // Returns the share of `residual` to be taken, 0 to 1. It follows from this residual and the one
  // before, as the step at which the line through both is nearest to zero (Irons and Tuck, "A
  // version of the Aitken accelerator for computer iteration", IJNME 1(3), 1969).
  double share_of(const Vec3& residual);

  // Returns true if the tool has been at rest for so long that no step is taken any more.
  [[nodiscard]] bool is_at_rest() const;

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  // The residual before, if there is one.
  Vec3 residual_ = Vec3::Zero();
  bool has_residual_ = false;
  // The share of the last step.
  double share_ = 1.0;
  // The largest share that the tool's rest allows.
  double ceiling_ = 1.0;
};

}  // namespace tactus::rendering
