// The contact methods: their names, and what each of them can render. Baking a scene and changing a
// method while the controller runs both ask here (can_render in object.h asks for all at once).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "rendering/friction/friction_model.h"

namespace tactus::rendering {

// The kind of the surface that is touched.
enum class SurfaceKind : std::uint8_t { mesh = 0, primitive = 1, implicit = 2 };

// The contact method: it keeps the tool out of an object, or pushes it out.
enum class ContactMethod : std::uint8_t {
  sphere_proxy = 0,     // a proxy with the tool's radius; meshes and primitives
  god_object = 1,       // a point proxy: to this object the tool has no radius
  potential_field = 2,  // the baseline, with its faults: closed meshes and primitives
  feature_walk = 3,     // a point that walks from feature to feature; meshes
  tracking = 4,         // a point that follows the tangent plane; implicit surfaces
  // The textbook's methods with their faults (contact/textbook), for comparison: a point on meshes,
  // the last one on implicit surfaces.
  one_plane = 5,
  three_sub_goals = 6,
  three_step = 7,
  one_step = 8,
  plain_tracking = 9,
};

// The last of the methods.
inline constexpr ContactMethod kLastContactMethod = ContactMethod::plain_tracking;

// A contact method with its name in scenes and commands.
struct NamedContactMethod {
  std::string_view name;
  ContactMethod method;
};
// The methods, in the order of their numbers.
inline constexpr auto kContactMethods = std::to_array<NamedContactMethod>({
    {"sphere_proxy", ContactMethod::sphere_proxy},
    {"god_object", ContactMethod::god_object},
    {"potential_field", ContactMethod::potential_field},
    {"feature_walk", ContactMethod::feature_walk},
    {"tracking", ContactMethod::tracking},
    {"one_plane", ContactMethod::one_plane},
    {"three_sub_goals", ContactMethod::three_sub_goals},
    {"three_step", ContactMethod::three_step},
    {"one_step", ContactMethod::one_step},
    {"plain_tracking", ContactMethod::plain_tracking},
});
static_assert([] {
  for (std::size_t i = 0; i < kContactMethods.size(); ++i) {
    if (kContactMethods[i].method != static_cast<ContactMethod>(i)) {
      return false;
    }
  }
  return kContactMethods.back().method == kLastContactMethod;
}());

// Returns true if objects of the method share one proxy, false if each gives its own force.
constexpr bool meets_proxy(ContactMethod method) {
  return method == ContactMethod::sphere_proxy || method == ContactMethod::god_object;
}

// Returns true for the textbook's methods on meshes.
constexpr bool is_textbook_on_mesh(ContactMethod method) {
  return method >= ContactMethod::one_plane && method <= ContactMethod::one_step;
}

// Returns true for all of the textbook's methods.
constexpr bool is_textbook(ContactMethod method) {
  return method >= ContactMethod::one_plane;
}

// Returns true for the methods that follow a formula.
constexpr bool follows_formula(ContactMethod method) {
  return method == ContactMethod::tracking || method == ContactMethod::plain_tracking;
}

// Returns true if the method can render a surface of that kind.
constexpr bool renders_surface(ContactMethod method, SurfaceKind surface) {
  switch (surface) {
    case SurfaceKind::primitive:
      return meets_proxy(method) || method == ContactMethod::potential_field;
    case SurfaceKind::implicit:
      return follows_formula(method);
    default:
      return !follows_formula(method);
  }
}

// Returns true if the method can render a mesh whose vertices move.
constexpr bool renders_deforming(ContactMethod method) {
  return meets_proxy(method);
}

// Returns true if the method renders shading and textures.
constexpr bool renders_detail(ContactMethod method) {
  return method != ContactMethod::potential_field && !is_textbook(method);
}

// Returns true if the method renders friction that differs with the direction.
constexpr bool renders_grain(ContactMethod method) {
  return method != ContactMethod::potential_field && !is_textbook(method);
}

// Returns true if the method renders that friction or, as a potential field, leaves out whatever
// friction the material has. The textbook's methods have the friction cone only, and plain_tracking
// has no friction.
inline bool renders_friction(ContactMethod method, const FrictionParameters& friction) {
  if (!is_textbook(method)) {
    return true;
  }
  return friction.kind == FrictionKind::cone &&
         (method != ContactMethod::plain_tracking || !has_friction(friction));
}

}  // namespace tactus::rendering
