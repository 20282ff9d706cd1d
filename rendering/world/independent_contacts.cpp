#include "rendering/world/independent_contacts.h"

#include <algorithm>
#include <utility>

#include "rendering/contact/no_pull.h"
#include "rendering/contact/potential_field.h"
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

// Returns the object's mesh with its neighbours and normals.
ConnectedMesh mesh_of(const Object& object) {
  return {object.mesh, object.neighbours, object.vertex_normals};
}

// Returns the push of a potential field at the tool, in the object's frame.
FieldPush field_push(const Object& object, const Vec3& tool_O, double tool_radius_m) {
  return object.surface == SurfaceKind::primitive
             ? potential_field(object.primitive, tool_O, tool_radius_m)
             : potential_field(mesh_of(object), tool_O, tool_radius_m);
}

// Turns the vectors of a touch from the object's frame to the world's.
void to_world(const Mover* mover, Touch& touch) {
  touch.proxy_W = point_from(mover, touch.proxy_W);
  touch.normal_W = direction_from(mover, touch.normal_W);
  touch.force_W = direction_from(mover, touch.force_W);
  touch.parts.friction_W = direction_from(mover, touch.parts.friction_W);
  touch.parts.texture_W = direction_from(mover, touch.parts.texture_W);
}

// Make the common touch of what each method gives. A potential field has no friction.
Touch touch_of(const ImplicitRest& rest) {
  return {.proxy_W = rest.proxy_W,
          .normal_W = rest.normal_W,
          .depth_m = rest.depth_m,
          .contact = rest.planes > 0 ? ContactKind::face : ContactKind::none,
          .friction = rest.friction,
          .sub_goals = rest.sub_goals,
          .planes = rest.planes,
          .flags = rest.flags};
}

Touch touch_of(const FeatureRest& rest) {
  const bool in_contact = rest.contact != ContactKind::none;
  return {.proxy_W = rest.proxy_W,
          .normal_W = rest.normal_W,
          .depth_m = rest.depth_m,
          .contact = rest.contact,
          .friction = rest.friction,
          .planes = static_cast<std::uint16_t>(in_contact ? 1 : 0),
          .flags = rest.flags};
}

Touch touch_of(const TextbookRest& rest) {
  return {.proxy_W = rest.proxy,
          .normal_W = rest.normal,
          .depth_m = rest.depth_m,
          .contact = rest.planes > 0 ? ContactKind::face : ContactKind::none,
          .friction = rest.friction,
          .sub_goals = rest.segments,
          .planes = rest.planes,
          .flags = rest.flags};
}

Touch touch_of(const PlainRest& rest) {
  return {.proxy_W = rest.proxy_W,
          .normal_W = rest.normal_W,
          .depth_m = rest.depth_m,
          .contact = rest.in_contact ? ContactKind::face : ContactKind::none,
          .sub_goals = static_cast<std::uint16_t>(rest.steps),
          .planes = static_cast<std::uint16_t>(rest.in_contact ? 1 : 0),
          .flags = rest.flags};
}

// Returns the rule of a textbook's method on meshes.
TextbookRule textbook_rule(ContactMethod method) {
  return static_cast<TextbookRule>(std::to_underlying(method) -
                                   std::to_underlying(ContactMethod::one_plane));
}

Touch touch_of(const FieldPush& push, const Vec3& tool_O) {
  if (!(push.depth_m > 0.0)) {
    return {.proxy_W = tool_O};
  }
  return {.proxy_W = tool_O + push.depth_m * push.normal_W,
          .normal_W = push.normal_W,
          .depth_m = push.depth_m,
          .contact = ContactKind::face,
          .planes = 1};
}

// Notes how far a contact that a limit ended is from its goal.
void note_short_of_goal(const Vec3& goal_O, Touch& touch) {
  if ((touch.flags & kTouchIterationsExhausted) != 0) {
    touch.short_of_goal_m = (goal_O - touch.proxy_W).norm();
  }
}

}  // namespace

void IndependentContacts::place(const SceneObjects& scene, const Vec3& p_W, double tool_radius_m) {
  tool_radius_m_ = tool_radius_m;
  last_tool_W_ = p_W;
  for (std::size_t k = 0; k < scene.independent_objects().size(); ++k) {
    const Mover* const mover = scene.mover_of(scene.independent_objects()[k]);
    const Vec3 p_O = point_in(mover, p_W);
    proxies_[k].place(p_O);
    details_[k] = {};
    awake_[k] = true;
    left_out_[k] = scene[scene.independent_objects()[k]].method == ContactMethod::potential_field;
  }
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
void IndependentContacts::add_to(Touch& touch, const SceneObjects& scene, const ToolState& tool,
                                 std::size_t limit, TickWatcher* watcher) {
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
        {.k = k,
         .object = object,
         .material = scene.material(number),
         .moved_m = step_O.norm(),
         .watch = {.watcher = watcher, .number = number, .object = &object, .mover = mover}},
        in_frame(scene, number, tool));
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
  const auto numbers = scene.independent_objects();
  const auto k = static_cast<std::size_t>(std::ranges::find(numbers, object) - numbers.begin());
  if (k == numbers.size() || !awake_[k]) {
    return 0.0;
  }
  const Object& independent = scene[object];
  const Vec3 tool_O = point_in(scene.mover_of(object), last_tool_W_);
  if (independent.method != ContactMethod::potential_field) {
    return (proxies_[k].position_O(independent.method) - tool_O).norm();
  }
  return left_out_[k] ? 0.0
                      : std::max(0.0, field_push(independent, tool_O, tool_radius_m_).depth_m);
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

Touch IndependentContacts::rest_in_frame(const IndependentObject& independent, const Vec3& goal_O) {
  const auto& [k, object, own, moved_m, watch] = independent;
  Material material = own;
  material.friction = scaled(material.friction, details_[k].friction_factor);
  switch (object.method) {
    case ContactMethod::tracking: {
      const ImplicitRest rest = proxies_[k].tracker.advance(
          object.implicit, material, goal_O,
          std::min(kMaxFormulaBudget, kFormulaStepsPerUnit * share_), watch);
      budget_.spend(rest.evaluated / kFormulaStepsPerUnit);
      Touch touch = touch_of(rest);
      note_short_of_goal(goal_O, touch);
      return touch;
    }
    case ContactMethod::feature_walk: {
      const FeatureRest rest =
          proxies_[k].walker.advance(mesh_of(object), object.sides, material, goal_O,
                                     std::min(kMaxFeatureVisits, share_ / kCostOfFeatureVisit));
      if (watch.watcher != nullptr) {
        watch.watcher->see(watch, proxies_[k].walker.feature());
      }
      budget_.spend(kCostOfFeatureVisit * (std::size_t{rest.visited} + rest.approached));
      Touch touch = touch_of(rest);
      note_short_of_goal(goal_O, touch);
      return touch;
    }
    case ContactMethod::plain_tracking: {
      const PlainRest rest = proxies_[k].plain_tracker.advance(object.implicit, goal_O, watch);
      budget_.spend(static_cast<std::size_t>(rest.steps) *
                    object.implicit.formula.instructions.size() / kFormulaStepsPerUnit);
      return touch_of(rest);
    }
    case ContactMethod::potential_field:
      budget_.spend(kCostOfField);
      return touch_of_field(k, object, goal_O);
    default:
      return touch_by_textbook(independent, goal_O);
  }
}

Touch IndependentContacts::touch_by_textbook(const IndependentObject& independent,
                                             const Vec3& tool_O) {
  const auto& [k, object, material, moved_m, watch] = independent;
  const TextbookRest rest = proxies_[k].textbook.advance(
      textbook_rule(object.method),
      {.mesh = object.mesh,
       .sides = object.sides,
       .material = material,
       .push_out_m = object.push_out_m},
      tool_O, std::min(kMaxFeatureVisits, share_ / kCostOfFeatureVisit), watch);
  budget_.spend(kCostOfFeatureVisit * rest.visited);
  Touch touch = touch_of(rest);
  note_short_of_goal(tool_O, touch);
  return touch;
}

// Computes a potential field. A field in which the tool began acts from the tick in which the tool
// is clear of it.
Touch IndependentContacts::touch_of_field(std::size_t k, const Object& object, const Vec3& tool_O) {
  const FieldPush push = field_push(object, tool_O, tool_radius_m_);
  left_out_[k] = left_out_[k] && push.depth_m > 0.0;
  if (left_out_[k]) {
    return {.proxy_W = tool_O, .flags = kTouchOverlap};
  }
  return touch_of(push, tool_O);
}

Touch IndependentContacts::touch_in_frame(const IndependentObject& independent,
                                          const ToolState& tool_O) {
  const auto& [k, object, material, moved_m, watch] = independent;
  const bool detailed = !object.detail.empty();
  ForceShading& shading = details_[k].shading;
  Touch touch;
  if (detailed) {
    shading.begin({.proxy_W = proxies_[k].position_O(object.method),
                   .tool_W = tool_O.p_W,
                   .moved_m = moved_m},
                  ForceShading::Passes::one);
    touch = rest_in_frame(independent, tool_O.p_W + shading.offset());
    if (touch.contact == ContactKind::none && shading.is_on()) {
      shading.reset();
      touch = rest_in_frame(independent, tool_O.p_W);
    }
  } else {
    touch = rest_in_frame(independent, tool_O.p_W);
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
  const auto& [k, object, material, moved_m, watch] = independent;
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

void IndependentContacts::Proxies::place(const Vec3& p_O) {
  tracker.place(p_O);
  walker.place(p_O);
  textbook.place(p_O);
  plain_tracker.place(p_O);
}

const Vec3& IndependentContacts::Proxies::position_O(ContactMethod method) const {
  switch (method) {
    case ContactMethod::tracking:
      return tracker.position_W();
    case ContactMethod::plain_tracking:
      return plain_tracker.position_W();
    case ContactMethod::feature_walk:
      return walker.position_W();
    default:
      return textbook.position();
  }
}

}  // namespace tactus::rendering
