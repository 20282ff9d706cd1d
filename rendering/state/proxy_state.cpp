// Saves and restores the state of the shared proxy.
//
// The candidate set is saved and not gathered again: the capsule's position decides where moves are
// cut, so another one would give other sub-goals. The candidates' numbers and tangents are saved;
// triangles and distances follow from the scene.
#include <span>

#include "rendering/contact/candidate_set.h"
#include "rendering/contact/sphere_proxy.h"
#include "rendering/state/plain_states.h"
#include "rendering/world/proxy_touch.h"

namespace tactus::rendering {

// The count bounds an index and so is checked when it is read.
inline void transfer(StateArchive& archive, FrictionFactors& factors) {
  auto& [object, factor, count, depth_m] = factors;
  archive(object, factor, depth_m);
  archive.up_to(count, object.size());
}

// The planes that are not kept are collected again by the next tick.
void ContactPlanes::transfer(StateArchive& archive, const SceneObjects& scene, bool are_kept) {
  [[maybe_unused]] auto& [contacts, count, is_above_first, planes] = *this;
  std::size_t kept = are_kept ? count : 0;
  archive.up_to(kept, contacts.size());
  for (std::size_t i = 0; i < kept; ++i) {
    auto& [plane, nearest, object, triangle, candidate] = contacts[i];
    archive(plane, nearest, object, triangle);
    archive.up_to(candidate, kMaxCandidates - 1);
    require_place(archive, scene, object, triangle);
  }
  if (archive.is_reading()) {
    count = kept;
  }
}

void UnpressedDepths::transfer(StateArchive& archive, const SceneObjects& scene) {
  auto& [planes, count, only_object] = *this;
  archive(only_object);
  archive.require(only_object == kNoObject || only_object < scene.size());
  archive.up_to(count, planes.size());
  for (Plane& plane : std::span(planes).first(count)) {
    auto& [object, normal_W, pressure_m, depth_m, softer_N_per_m, dual_W] = plane;
    archive(object, normal_W, pressure_m, depth_m, softer_N_per_m, dual_W);
    archive.require(object < scene.size());
  }
}

void CapsulePlan::transfer(StateArchive& archive) {
  auto& [length_m, slimness] = *this;
  archive(length_m, slimness);
}

void TangentBounds::transfer(StateArchive& archive, std::size_t i) {
  [[maybe_unused]] auto& [origin, reach_m, normal_x, normal_y, normal_z, height] = *this;
  archive(normal_x[i], normal_y[i], normal_z[i], height[i]);
}

void ReachMemory::transfer(StateArchive& archive, std::size_t size, const Key& now) {
  [[maybe_unused]] auto& [bounds, here, known_for, there] = *this;
  bool is_known = knows(now);
  archive(is_known);
  if (archive.is_reading()) {
    known_for = is_known ? now : Key{};
  }
  if (!is_known) {
    return;
  }
  auto& [number, count] = here;
  archive.up_to(count, size);
  for (std::size_t i = 0; i < count && archive.good(); ++i) {
    archive(number[i]);
    archive.require(number[i] < size && (i == 0 || number[i - 1] < number[i]));
  }
}

// The capsule, the plan, the counts and the candidates. The fields that follow from the scene and
// the margins are made anew by a reader.
void CandidateSet::transfer(StateArchive& archive, const SceneObjects& scene,
                            const ContactMargins& margins) {
  [[maybe_unused]] auto& [place, trusted, own_margins, size, counts, progress, budget, left_out,
                          reach, slots] = *this;
  [[maybe_unused]] auto& [p, number, first_of_tick, waited] = place;
  auto& [trust, plan] = trusted;
  left_out.transfer(archive, scene.size());
  archive(p, trust, plan, number, first_of_tick, progress.tested, counts.peak, counts.gatherings);
  archive.require(number > 0);
  archive.up_to(size, kMaxCandidates);
  if (archive.is_reading()) {
    own_margins = margins;
    reach.bounds().start(trust.start, margins.sphere.reach_m);
    progress.is_full = false;
  }
  archive.up_to(progress.smaller, kMostSmaller);
  transfer_walk(archive, scene);
  for (std::size_t i = 0; i < size && archive.good(); ++i) {
    transfer_candidate(archive, scene, i);
  }
  reach.transfer(archive, size, now());
  if (archive.is_reading()) {
    reach.bounds().fill_last_four(size);
  }
}

// Saves the gathering that has begun: the meshes that are left, and the nodes that the walk of the
// last of them has still to look at.
void CandidateSet::transfer_walk(StateArchive& archive, const SceneObjects& scene) {
  [[maybe_unused]] auto& [meshes, count, left, tested, smaller, is_full, may_pause] = progress_;
  archive.up_to(count, meshes.size());
  std::size_t waiting = left.count();
  archive.up_to(waiting, WalkLeft::kMostLeft);
  for (std::size_t i = 0; i < count && archive.good(); ++i) {
    archive(meshes[i]);
    archive.require(meshes[i] < scene.size());
    archive.require(archive.good() && meets_proxy(scene[meshes[i]]) &&
                    scene[meshes[i]].surface == SurfaceKind::mesh);
  }
  const std::size_t nodes =
      count > 0 && archive.good() ? scene[meshes[count - 1]].mesh.nodes.size() : 0;
  if (archive.is_reading()) {
    left.begin = 0;
    left.end = static_cast<std::uint32_t>(archive.good() ? waiting : 0);
  }
  for (std::uint32_t place = left.begin; place != left.end && archive.good(); ++place) {
    archive(left.at(place));
    archive.require(left.at(place) < nodes);
  }
}

// Saves one candidate. A reader builds its triangle and measures it again, which gives the same
// bits.
void CandidateSet::transfer_candidate(StateArchive& archive, const SceneObjects& scene,
                                      std::size_t i) {
  Candidate& slot = slots_[i];
  [[maybe_unused]] auto& [primitive, measured_at, object, index, prepared, one_sided, point_tool,
                          behind, nearest_, triangle, seen] = slot;
  bool measured = is_measured(i);
  archive(object, index, prepared, measured);
  reach_.bounds().transfer(archive, i);
  require_place(archive, scene, object, index);
  archive.require(archive.good() && (!prepared || scene[object].surface != SurfaceKind::primitive));
  if (!archive.is_reading() || !archive.good()) {
    return;
  }
  const Object& of = scene[object];
  primitive = of.surface == SurfaceKind::primitive ? &scene.primitive_W(object) : nullptr;
  one_sided = of.sides == Sides::one;
  point_tool = is_point_tool(of);
  measured_at = 0;
  if (prepared) {
    triangle = triangle_W(scene, object, index);
  }
  if (measured) {
    nearest(i, scene);
  }
}

// `start` and the tool's step are set by the next tick, so they are not saved.
void SphereProxy::transfer(StateArchive& archive, const SceneObjects& scene) {
  [[maybe_unused]] auto& [margins, state, start, carried_W, tool_step_W, turned_W, factors,
                          just_placed, candidate_set, planes] = *this;
  auto& [p_W, friction, model, last_contact, held_by, unpressed, is_settled, settled_for_W] = state;
  archive(p_W, model, is_settled, settled_for_W, carried_W, turned_W, factors, just_placed);
  unpressed.transfer(archive, scene);
  archive.choice(friction, FrictionState::slip);
  auto& [object, triangle, normal_W] = last_contact;
  archive(object, triangle, normal_W);
  for (HeldBy::Surface& surface : held_by.surfaces) {
    archive(surface.object, surface.triangle);
  }
  if (object == kNoObject) {
    archive.require(normal_W.isZero(0.0));
  } else {
    require_place(archive, scene, object, triangle);
  }
  candidate_set.transfer(archive, scene, margins);
  planes.transfer(archive, scene, candidate_set.is_begun());
}

// The points in this pass and its travel are set by the next touch.
void ProxyTouch::transfer(StateArchive& archive, const SceneObjects& scene) {
  [[maybe_unused]] auto& [proxy, grips, shading, friction, before, here, last_tool_W, tool_step_m,
                          travel_m, first_pass, detailed] = *this;
  proxy.transfer(archive, scene);
  archive(shading, friction, last_tool_W, detailed);
  auto& [points, count] = before;
  archive.up_to(count, points.size());
  for (std::size_t i = 0; i < count; ++i) {
    auto& [object, point_O] = points[i];
    archive(object, point_O);
  }
}

}  // namespace tactus::rendering
