#include "rendering/world/independent_contacts.h"

#include <algorithm>

#include "rendering/contact/no_pull.h"
#include "rendering/contact/tick_watcher.h"
#include "rendering/geometry/tangential.h"

namespace tactus::rendering {
namespace {

// Returns the tool in the object's frame, with its velocity relative to the surface there.
ToolState in_frame(const SceneObjects& scene, std::uint32_t number, const ToolState& tool) {
  const Mover* const mover = scene.mover_of(number);
  return {.p_W = point_in(mover, tool.p_W),
          .v_W = direction_in(mover, tool.v_W - scene.velocity_W(number, tool.p_W))};
}

// Turns the vectors of a touch from the object's frame to the world's.
void to_world(const Mover* mover, Touch& touch) {
  touch.proxy_W = point_from(mover, touch.proxy_W);
  touch.normal_W = direction_from(mover, touch.normal_W);
  touch.force_W = direction_from(mover, touch.force_W);
  touch.parts.friction_W = direction_from(mover, touch.parts.friction_W);
  touch.parts.texture_W = direction_from(mover, touch.parts.texture_W);
}

// Returns the place of an object among the independent ones, or where it would be.
std::size_t place_of(const SceneObjects& scene, std::uint32_t object) {
  const auto numbers = scene.independent_objects();
  return static_cast<std::size_t>(std::ranges::lower_bound(numbers, object) - numbers.begin());
}

// Move the entries from `k` to the `count`-th up by one place, and those behind `k` down by one.
template <class Entries>
void move_up(Entries& entries, std::size_t k, std::size_t count) {
  std::move_backward(entries.begin() + static_cast<std::ptrdiff_t>(k),
                     entries.begin() + static_cast<std::ptrdiff_t>(count),
                     entries.begin() + static_cast<std::ptrdiff_t>(count + 1));
}
template <class Entries>
void move_down(Entries& entries, std::size_t k, std::size_t count) {
  std::move(entries.begin() + static_cast<std::ptrdiff_t>(k + 1),
            entries.begin() + static_cast<std::ptrdiff_t>(count),
            entries.begin() + static_cast<std::ptrdiff_t>(k));
}

}  // namespace

void IndependentContacts::place(const SceneObjects& scene, const Vec3& p_W, double tool_radius_m) {
  tool_radius_m_ = tool_radius_m;
  last_tool_W_ = p_W;
  for (std::size_t k = 0; k < scene.independent_objects().size(); ++k) {
    place_one(scene, k);
  }
}

void IndependentContacts::place_one(const SceneObjects& scene, std::size_t k) {
  const std::uint32_t number = scene.independent_objects()[k];
  proxies_[k].place(point_in(scene.mover_of(number), last_tool_W_));
  details_[k] = {};
  awake_[k] = true;
  left_out_[k] = scene[number].method == ContactMethod::potential_field;
}

void IndependentContacts::insert(const SceneObjects& scene, std::uint32_t object) {
  const std::size_t k = place_of(scene, object);
  const std::size_t before = scene.independent_objects().size() - 1;
  move_up(awake_, k, before);
  move_up(proxies_, k, before);
  move_up(details_, k, before);
  move_up(left_out_, k, before);
  place_one(scene, k);
}

void IndependentContacts::remove(const SceneObjects& scene, std::uint32_t object) {
  const std::size_t k = place_of(scene, object);
  const std::size_t before = scene.independent_objects().size() + 1;
  move_down(awake_, k, before);
  move_down(proxies_, k, before);
  move_down(details_, k, before);
  move_down(left_out_, k, before);
}

void IndependentContacts::restart(const SceneObjects& scene, std::uint32_t object) {
  place_one(scene, place_of(scene, object));
}

std::size_t IndependentContacts::count_near(const SceneObjects& scene, const Vec3& p_W) const {
  std::size_t count = 0;
  for (std::size_t k = 0; k < scene.independent_objects().size(); ++k) {
    const std::uint32_t number = scene.independent_objects()[k];
    count += awake_[k] || is_near(scene.mover_of(number), scene[number], p_W) ? 1U : 0U;
  }
  return count;
}

bool IndependentContacts::any_near(const SceneObjects& scene, const Vec3& p_W) const {
  return count_near(scene, p_W) > 0;
}

// Every contact may spend an equal share of what those before it have left.
template <class Watch>
void IndependentContacts::add_to(Touch& touch, const SceneObjects& scene, const ToolState& tool,
                                 std::size_t limit, Watch watch) {
  budget_.begin_tick(limit);
  std::size_t to_come = count_near(scene, tool.p_W);
  tool_step_m_ = (tool.p_W - last_tool_W_).norm();
  Vec3 force = touch.force_W;
  ForceParts parts = touch.parts;
  double hardest = force.squaredNorm();
  for (std::size_t k = 0; k < scene.independent_objects().size(); ++k) {
    const std::uint32_t number = scene.independent_objects()[k];
    const Mover* const mover = scene.mover_of(number);
    const Object& object = scene[number];
    const bool near = is_near(mover, object, tool.p_W);
    if (!near && !awake_[k]) {
      continue;
    }
    // An object that comes near begins where the tool was in the last tick, so that this tick's
    // motion is seen whole.
    wake(k, mover);
    share_ = budget_.left() / to_come--;
    const Vec3 step_O = point_in(mover, tool.p_W) - point_in_before(mover, last_tool_W_);
    proxies_[k].tracker.begin_friction(step_O, scene.tick_s());
    proxies_[k].walker.begin_friction(step_O, scene.tick_s());
    Touch own = touch_in_frame(
        {.k = k, .object = object, .material = scene.material(number), .moved_m = step_O.norm()},
        in_frame(scene, number, tool),
        watch.of({.number = number, .object = &object, .mover = mover}));
    to_world(mover, own);
    own.object = number;
    awake_[k] = near || own.contact != ContactKind::none;
    force += own.force_W;
    parts.friction_W += own.parts.friction_W;
    parts.texture_W += own.parts.texture_W;
    parts.driven_power += own.force_W.dot(scene.velocity_W(number, tool.p_W));
    // The flags of all contacts add up; the other fields describe the one with the largest force.
    own.flags |= touch.flags;
    own.short_of_goal_m = std::max(own.short_of_goal_m, touch.short_of_goal_m);
    const double push = own.force_W.squaredNorm();
    if (own.contact != ContactKind::none &&
        (push > hardest || touch.contact == ContactKind::none)) {
      hardest = push;
      touch = own;
    }
    touch.flags = own.flags;
    touch.short_of_goal_m = own.short_of_goal_m;
  }
  touch.force_W = force;
  touch.parts = parts;
  last_tool_W_ = tool.p_W;
}

double IndependentContacts::stretch_m(const SceneObjects& scene, std::uint32_t object) const {
  const std::size_t k = place_of(scene, object);
  return awake_[k] ? stretch_of(k, scene[object], point_in(scene.mover_of(object), last_tool_W_))
                   : 0.0;
}

bool IndependentContacts::touches(const SceneObjects& scene, std::uint32_t object) const {
  // A free proxy is at the tool, up to the rounding of the way into a formula's frame and back.
  constexpr double kAtTool_m = 1e-12;
  const std::size_t k = place_of(scene, object);
  return awake_[k] && (left_out_[k] || details_[k].touched || stretch_m(scene, object) > kAtTool_m);
}

void IndependentContacts::hold(const SceneObjects& scene) {
  for (std::size_t k = 0; k < scene.independent_objects().size(); ++k) {
    wake(k, scene.mover_of(scene.independent_objects()[k]));
  }
}

// Returns true if the tool's path since the last tick, seen from the object, enters the object's
// box.
bool IndependentContacts::is_near(const Mover* mover, const Object& object, const Vec3& p_W) const {
  // The box grows by the tool's radius and a millimetre, far beyond the contact margins.
  constexpr double kMargin_m = 1e-3;
  const Vec3 from = point_in_before(mover, last_tool_W_);
  const Vec3 to = point_in(mover, p_W);
  const Bounds box = bounds_of(object);
  const double margin = tool_radius_m_ + kMargin_m;
  return ((from.cwiseMax(to).array() >= box.lower_W.array() - margin) &&
          (from.cwiseMin(to).array() <= box.upper_W.array() + margin))
      .all();
}

// Starts a contact that was asleep, out of contact, where the tool was in the last tick.
void IndependentContacts::wake(std::size_t k, const Mover* mover) {
  if (awake_[k]) {
    return;
  }
  const Vec3 p_O = point_in_before(mover, last_tool_W_);
  proxies_[k].place(p_O);
  details_[k] = {};
  awake_[k] = true;
}

template <class Watch>
Touch IndependentContacts::touch_in_frame(const IndependentObject& independent,
                                          const ToolState& tool_O, Watch watch) {
  const auto& [k, object, material, moved_m] = independent;
  const bool detailed = !object.detail.empty();
  ForceShading& shading = details_[k].shading;
  Touch touch;
  if (detailed) {
    shading.begin({.proxy_W = proxies_[k].position_O(object.method),
                   .tool_W = tool_O.p_W,
                   .moved_m = moved_m},
                  ForceShading::Passes::one);
    touch = rest_in_frame(independent, tool_O.p_W + shading.offset(), watch);
    if (touch.contact == ContactKind::none && shading.is_on()) {
      shading.reset();
      touch = rest_in_frame(independent, tool_O.p_W, watch);
    }
  } else {
    touch = rest_in_frame(independent, tool_O.p_W, watch);
  }
  if (touch.contact == ContactKind::none) {
    if (detailed) {
      details_[k] = {};
    }
    return touch;
  }
  // F = K (proxy - tool) - B v without a pull, with the velocity relative to the surface.
  const Vec3 stretch = touch.proxy_W - tool_O.p_W;
  const double stiffness = material.stiffness_N_per_m;
  touch.force_W =
      without_pull(stiffness * stretch - material.damping_Ns_per_m * tool_O.v_W, touch.normal_W);
  touch.parts.friction_W = stiffness * tangential(stretch, touch.normal_W);
  if (!has_friction(material.friction)) {
    touch.friction = FrictionState::free;
  }
  if (detailed) {
    shade_in_frame(independent, tool_O, touch);
  }
  return touch;
}

// Applies detail with one pass per tick: its result shifts the goal of the next tick.
void IndependentContacts::shade_in_frame(const IndependentObject& independent,
                                         const ToolState& tool_O, Touch& touch) {
  const auto& [k, object, material, moved_m] = independent;
  DetailState& state = details_[k];
  SurfaceContact contact{.point_O = touch.proxy_W, .normal_O = touch.normal_W};
  contact.travel_m = state.touched ? (touch.proxy_W - state.point_O).norm() : tool_step_m_;
  if (object.method == ContactMethod::feature_walk) {
    const MeshFeature& feature = proxies_[k].walker.feature();
    contact.triangle = feature.triangle;
    contact.feature = feature.kind;
    contact.edge = feature.number;
  }
  const Detail detail =
      detail_at(object.detail, {object.mesh, object.neighbours, object.vertex_normals}, contact);
  const Vec3 stretch = touch.proxy_W - tool_O.p_W;
  touch.depth_m = stretch.dot(touch.normal_W);
  // The force is that of the depth below the bump's surface; its share of the depth also scales the
  // lean and the friction.
  const double effective_depth = std::max(touch.depth_m + detail.height_m, 0.0);
  const double share = touch.depth_m > 0.0 ? effective_depth / touch.depth_m : 0.0;
  const Vec3 lean = lean_of(detail.normal_O, touch.normal_W);
  if (!state.shading.is_at_rest()) {
    state.shading.improve(
        {.normal_W = touch.normal_W, .lean = share * lean, .depth_m = touch.depth_m});
    state.friction_factor = share * detail.friction_factor;
  }
  state.point_O = touch.proxy_W;
  state.touched = true;
  touch.force_W = Vec3::Zero();
  touch.parts = {};
  if (effective_depth > 0.0) {
    const double stiffness = detail.stiffness_factor * material.stiffness_N_per_m;
    const Vec3 along = stiffness * effective_depth * lean;
    touch.force_W =
        without_pull(stiffness * (stretch - (touch.depth_m - effective_depth) * touch.normal_W) -
                         material.damping_Ns_per_m * tool_O.v_W,
                     touch.normal_W);
    touch.parts.friction_W = stiffness * tangential(stretch, touch.normal_W) - along;
    touch.parts.texture_W =
        along +
        (stiffness * effective_depth - material.stiffness_N_per_m * touch.depth_m) * touch.normal_W;
  }
}

template void IndependentContacts::add_to(Touch&, const SceneObjects&, const ToolState&,
                                          std::size_t, Unwatched);
template void IndependentContacts::add_to(Touch&, const SceneObjects&, const ToolState&,
                                          std::size_t, Watched);

}  // namespace tactus::rendering
