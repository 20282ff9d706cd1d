// Saves and restores the state of the shared proxy.
//
// The candidate set is saved and not gathered again: the capsule's position decides where moves are
// cut, so another one would give other sub-goals. The candidates' numbers and tangents are saved;
// triangles and distances follow from the scene.
#include "rendering/contact/candidate_set.h"
#include "rendering/contact/sphere_proxy.h"
#include "rendering/state/plain_states.h"
#include "rendering/world/proxy_touch.h"

namespace tactus::rendering {

inline void transfer(StateArchive& archive, Plane& plane) {
  auto& [normal, offset] = plane;
  archive(normal, offset);
}

inline void transfer(StateArchive& archive, FrictionFactors& factors) {
  auto& [object, factor, count, depth_m] = factors;
  archive(object, factor, depth_m);
  archive.up_to(count, object.size());
}

namespace {

void transfer_planes(StateArchive& archive, const SceneObjects& scene,
                     std::span<ContactPlane> planes, std::size_t& count) {
  archive.up_to(count, planes.size());
  for (std::size_t i = 0; i < count; ++i) {
    auto& [plane, nearest, object, triangle, candidate] = planes[i];
    archive(plane, nearest, object, triangle);
    archive.up_to(candidate, kMaxCandidates - 1);
    require_place(archive, scene, object, triangle);
  }
}

}  // namespace

void TickBudget::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [done, most, saved] = *this;
  archive(done);
  archive.up_to(saved, kMaxSaved);
}

void CandidateSet::transfer(StateArchive& archive, const SceneObjects& scene,
                            const ContactMargins& margins) {
  [[maybe_unused]] auto& [place, trust, wanted_length_m, slimness, own_margins, places, size,
                          tested, peak, gatherings, first_gathering, to_walk, smaller, is_full,
                          may_pause, first_place, waited, budget, left_out, normal_x, normal_y,
                          normal_z, height, here, there, here_place, here_gathering, slots] = *this;
  archive(left_out);
  archive(place, trust, wanted_length_m, slimness, places, first_place, tested, peak, gatherings);
  archive.require(places > 0);
  archive.up_to(size, kMaxCandidates);
  if (archive.is_reading()) {
    own_margins = margins;
    is_full = false;
  }
  archive.up_to(smaller, kMostSmaller);
  transfer_walk(archive, scene);
  for (std::size_t i = 0; i < size && archive.good(); ++i) {
    transfer_candidate(archive, scene, i);
  }
  transfer_here(archive);
  if (archive.is_reading()) {
    fill_last_four();
  }
  archive(budget);  // which measuring again has added to
}

void CandidateSet::transfer_walk(StateArchive& archive, const SceneObjects& scene) {
  auto& [meshes, count, left] = to_walk_;
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

// Saves the candidates within reach. A new search could lack those that the tangents have put out
// of reach since.
void CandidateSet::transfer_here(StateArchive& archive) {
  auto& [number, count] = here_;
  bool is_known = here_place_ == places_ && here_gathering_ == gatherings_;
  archive(is_known);
  if (archive.is_reading()) {
    here_place_ = is_known ? places_ : 0;
    here_gathering_ = gatherings_;
  }
  if (!is_known) {
    return;
  }
  archive.up_to(count, size_);
  for (std::size_t i = 0; i < count && archive.good(); ++i) {
    archive(number[i]);
    archive.require(number[i] < size_ && (i == 0 || number[i - 1] < number[i]));
  }
}

void CandidateSet::transfer_candidate(StateArchive& archive, const SceneObjects& scene,
                                      std::size_t i) {
  Candidate& slot = slots_[i];
  [[maybe_unused]] auto& [primitive, measured_at, object, index, prepared, one_sided, point_tool,
                          behind, nearest_, triangle, seen] = slot;
  bool measured = is_measured(i);
  archive(object, index, prepared, measured);
  archive(normal_x_[i], normal_y_[i], normal_z_[i], height_[i]);
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

void SphereProxy::transfer(StateArchive& archive, const SceneObjects& scene) {
  [[maybe_unused]] auto& [margins, p, friction, model, start_model, carried_W, last_contact,
                          factors, start, start_friction, start_last_contact, slipped,
                          last_crease_move, least_left_m, candidate_set, contacts, contact_count,
                          planes, last_constraints, recalled, recalled_count, just_placed, overlaps,
                          above_first_plane, blocking_candidates, blocking_count] = *this;
  archive(p, model, carried_W, factors, just_placed);
  archive.choice(friction, FrictionState::slip);
  auto& [object, triangle, normal_W] = last_contact;
  archive(object, triangle, normal_W);
  if (object == kNoObject) {
    archive.require(normal_W.isZero(0.0));
  } else {
    require_place(archive, scene, object, triangle);
  }
  candidate_set.transfer(archive, scene, margins);
  // The planes are saved only while a gathering is under way; otherwise the next tick collects them
  // again.
  std::size_t waiting = candidate_set.is_begun() ? contact_count : 0;
  transfer_planes(archive, scene, contacts, waiting);
  if (archive.is_reading()) {
    contact_count = waiting;
  }
}

void ProxyTouch::transfer(StateArchive& archive, const SceneObjects& scene) {
  [[maybe_unused]] auto& [proxy, shading, friction, before, here, last_tool_W, tool_step_m,
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
