// The surfaces near the proxy, as the steps of a tick pass them on.
#pragma once

#include "rendering/contact/candidate_set.h"
#include "rendering/contact/sphere_sweep.h"
#include "rendering/objects/scene_objects.h"

namespace tactus::rendering {

// The scene, the tool's contact margins and the candidates, which belong together.
struct NearbySurfaces {
  const SceneObjects& scene;
  const ContactMargins& margins;
  CandidateSet& candidates;  // gathered from `scene` with `margins`
};

}  // namespace tactus::rendering
