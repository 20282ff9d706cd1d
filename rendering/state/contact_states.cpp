// Saves and restores the state of friction, shading and the proxies of independent contacts. A
// transfer names every member and leaves out the configuration's, and those that each tick sets
// before it reads them.
#include <algorithm>
#include <cstddef>
#include <span>

#include "rendering/contact/feature_walk.h"
#include "rendering/contact/implicit_tracking.h"
#include "rendering/contact/textbook/plain_tracking.h"
#include "rendering/contact/textbook/textbook_proxy.h"
#include "rendering/friction/joint_friction.h"
#include "rendering/material/force_shading.h"
#include "rendering/state/plain_states.h"
#include "rendering/world/independent_contacts.h"

namespace tactus::rendering {

void SurfaceFriction::transfer(StateArchive& archive) {
  auto& [memory, normal, depth_m, force_N, stiffness_N_per_m, share, tool_step, tick_s, state, ran,
         is_held] = *this;
  archive(memory, normal, depth_m, force_N, stiffness_N_per_m, share, tool_step, tick_s, ran,
          is_held);
  archive.choice(state, FrictionState::slip);
}

void JointFriction::transfer(StateArchive& archive) {
  auto& [surfaces, models, is_in_use, normal, depth_m, tool_step, tick_s] = *this;
  archive(surfaces, models, is_in_use, normal, depth_m, tool_step, tick_s);
  // The numbers differ; only places without a surface are alike.
  for (std::size_t i = 1; i < kMost; ++i) {
    const auto before = std::span(surfaces).first(i);
    archive.require(surfaces[i] == kNoSurface ||
                    std::ranges::find(before, surfaces[i]) == before.end());
  }
}

void ForceShading::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [tool_radius_m, normal, stretch, depth_m, interpolated, offset,
                          lifted_from_m, relaxation] = *this;
  archive(normal, stretch, depth_m, interpolated, offset, lifted_from_m, relaxation);
}

void Relaxation::transfer(StateArchive& archive) {
  auto& [residual, has_residual, share, ceiling] = *this;
  archive(residual, has_residual, share, ceiling);
}

void FeatureWalker::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [p, feature, side, friction, model, in_contact, most_visits] = *this;
  archive(p, feature, side, model, in_contact);
  archive.choice(friction, FrictionState::slip);
}

void ImplicitTracker::transfer(StateArchive& archive) {
  auto& [p_W, placed, state] = *this;
  auto& [p_O, side, friction, model, walls] = state;
  archive(p_W, placed, p_O, side, model, walls);
  archive.choice(friction, FrictionState::slip);
}

void TextbookProxy::transfer(StateArchive& archive) {
  auto& [p, friction, step_planes, steps] = *this;
  archive(p, step_planes, steps);
  archive.choice(friction, FrictionState::slip);
  archive.require(steps <= step_planes.size());
}

void PlainTracker::transfer(StateArchive& archive) {
  auto& [p_W, side, in_contact] = *this;
  archive(p_W, side, in_contact);
}

void CreaseWalls::transfer(StateArchive& archive) {
  auto& [offsets_O, count] = *this;
  archive(offsets_O, count);
  archive.require(count <= offsets_O.size());
}

void IndependentContacts::transfer(StateArchive& archive, const SceneObjects& scene) {
  [[maybe_unused]] auto& [tool_radius_m, last_tool_W, tool_step_m, budget, share, awake, proxies,
                          details, left_out] = *this;
  archive(tool_radius_m, last_tool_W);
  for (std::size_t k = 0; k < scene.independent_objects().size(); ++k) {
    auto& [shading, point_O, touched, friction_factor] = details[k];
    auto& [tracker, walker, textbook, plain_tracker] = proxies[k];
    archive(awake[k], left_out[k], tracker, walker, textbook, plain_tracker, shading, point_O,
            touched, friction_factor);
    const std::size_t triangles = scene[scene.independent_objects()[k]].mesh.triangles.size();
    const std::uint32_t triangle = walker.feature().triangle;
    // The triangle comes from outside, and the walk will read it.
    archive.require(triangle == 0 || triangle < triangles);
  }
}

}  // namespace tactus::rendering
