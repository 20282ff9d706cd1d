// The touch of one object by its contact method: the part of IndependentContacts that knows the
// methods.
#include <algorithm>
#include <utility>

#include "rendering/contact/potential_field.h"
#include "rendering/contact/tick_watcher.h"
#include "rendering/world/independent_contacts.h"

namespace tactus::rendering {
namespace {

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

double IndependentContacts::stretch_of(std::size_t k, const Object& object,
                                       const Vec3& tool_O) const {
  if (object.method != ContactMethod::potential_field) {
    return (proxies_[k].position_O(object.method) - tool_O).norm();
  }
  return left_out_[k] ? 0.0 : std::max(0.0, field_push(object, tool_O, tool_radius_m_).depth_m);
}

template <class Watch>
Touch IndependentContacts::rest_in_frame(const IndependentObject& independent, const Vec3& goal_O,
                                         Watch watch) {
  const auto& [k, object, own, moved_m] = independent;
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
      watch.see(proxies_[k].walker.feature());
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
      return touch_by_textbook(independent, goal_O, watch);
  }
}

template <class Watch>
Touch IndependentContacts::touch_by_textbook(const IndependentObject& independent,
                                             const Vec3& tool_O, Watch watch) {
  const auto& [k, object, material, moved_m] = independent;
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

template Touch IndependentContacts::rest_in_frame(const IndependentObject&, const Vec3&, Unwatched);
template Touch IndependentContacts::rest_in_frame(const IndependentObject&, const Vec3&,
                                                  ObjectWatched);

}  // namespace tactus::rendering
