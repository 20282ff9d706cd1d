// A triangle or primitive near the tool, as the candidate set keeps it.
#pragma once

#include <cstdint>

#include "rendering/geometry/triangle.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// One member of the candidate set. Most candidates are gathered and never measured, so the fields
// that gathering writes come first, in one cache line.
struct alignas(64) Candidate {
  // The primitive of an object without a mesh; nullptr for a triangle.
  const Primitive* primitive = nullptr;
  // The number of the position (CandidateSet::move_to) from which `nearest` was measured; 0: never.
  std::uint64_t measured_at = 0;
  // The object's number in the scene.
  std::uint32_t object = 0;
  // The triangle's number in its mesh.
  std::uint32_t index = 0;
  // True if `triangle` is built.
  bool prepared = false;
  // True if the surface blocks from its front only.
  bool one_sided = true;
  // True if this object meets the tool's centre only (god_object).
  bool point_tool = false;
  // True if the surface is one-sided and the position is on its far side: it does not block then.
  bool behind = false;
  // The nearest point from the position of `measured_at`; world frame.
  Nearest nearest;
  // The triangle, built at its first measurement; world frame.
  Triangle triangle;
  // The primitive's distance and normal from the position of `measured_at`; world frame.
  SurfaceSample seen;
};

}  // namespace tactus::rendering
