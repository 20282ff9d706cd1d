// The input and the output of a touch, each tick. World::touch takes a ToolState and returns a
// Touch.
#pragma once

#include <cstdint>

#include "rendering/geometry/triangle.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The tool's centre in the world frame W (right-handed: x right, y up, z toward the user).
struct ToolState {
  // The position, m.
  Vec3 p_W = Vec3::Zero();
  // The velocity, m/s.
  Vec3 v_W = Vec3::Zero();
};

// The feature of the surface that the proxy rests on; with several constraints that of the first.
enum class ContactKind : std::uint8_t { none = 0, face = 1, edge = 2, vertex = 3 };

// Returns the contact kind of a triangle's feature.
inline ContactKind kind_of(Feature feature) {
  switch (feature) {
    case Feature::face:
      return ContactKind::face;
    case Feature::edge:
      return ContactKind::edge;
    default:
      return ContactKind::vertex;
  }
}

// Whether the proxy sticks to the surface or slips. `free` means no contact, or one without
// friction.
enum class FrictionState : std::uint8_t { free = 0, stick = 1, slip = 2 };

// The limits that a touch reached, one bit each; 0 is a clean tick. With every bit the force stays
// bounded and the proxy has crossed nothing. The last one is of the whole world, and every tool has
// it. The capacities are in limits.h.
enum TouchFlags : std::uint32_t {
  kTouchClean = 0,
  // More triangles than kMaxCandidates are near the tool: a slower path is taken.
  kTouchCandidatesOverflow = 1U << 0,
  // The tick budget or kMaxSubGoals is spent: the proxy is short of its minimum in this tick.
  kTouchIterationsExhausted = 1U << 1,
  // There are more contact planes than kMaxContactPlanes.
  kTouchPlanesOverflow = 1U << 2,
  // The tool is not finite or beyond kWorldBound_m: the proxy is held and the force is zero.
  kTouchToolInvalid = 1U << 3,
  // Objects that moved left the proxy no room: some of them passed over it.
  kTouchPinched = 1U << 4,
  // An object that the tool began in or came out of is not felt until the tool is clear of it.
  kTouchOverlap = 1U << 5,
  // Bodies meet in more contacts than kMaxBodyContacts, or one is near more than kMaxNearTriangles
  // of a mesh: they go through what is left out.
  kTouchBodyContactsOverflow = 1U << 6,
};

// The parts of a touch's force, N on the hand, world frame. The rest of the force is the surfaces'
// own: the normal force and the damping.
struct ForceParts {
  // The friction: the part along the surface that holds the tool back.
  Vec3 friction_W = Vec3::Zero();
  // The part that bumps, stiffness maps and shading change.
  Vec3 texture_W = Vec3::Zero();
  // The part of the effects, which need no surface.
  Vec3 effect_W = Vec3::Zero();
  // The power to the hand by surfaces that move by themselves, W.
  double driven_power = 0.0;
};

// The result of one tick for one tool; world frame. With several contacts the fields that name one
// contact are those of the hardest.
struct Touch {
  // The position of the proxy, m. A free proxy is at the tool.
  Vec3 proxy_W = Vec3::Zero();
  // The unit normal of the contact, away from the surface; zero without contact.
  Vec3 normal_W = Vec3::Zero();
  // The force on the hand, N: K (proxy - tool) - B v in contact, plus the effects.
  Vec3 force_W = Vec3::Zero();
  // The penetration depth, m: (proxy - tool) . normal.
  double depth_m = 0.0;
  // The feature that is touched; none without contact.
  ContactKind contact = ContactKind::none;
  // The friction state of the contact.
  FrictionState friction = FrictionState::free;
  // The number of straight moves that the proxy made in this tick.
  std::uint16_t sub_goals = 0;
  // The number of constraints that hold the proxy: 0 to 3.
  std::uint16_t planes = 0;
  // The index of the touched object; meaningful in contact.
  std::uint32_t object = 0;
  // TouchFlags: the limits that the touch reached.
  std::uint32_t flags = kTouchClean;
  // The distance of the proxy from its goal when a limit ended its moves, m; 0 in a tick that ended
  // by itself. Where the goal was not known yet it is the distance to the tool, which is not less.
  // With several contacts it is the largest.
  double short_of_goal_m = 0.0;
  // The parts of the force.
  ForceParts parts;
};

}  // namespace tactus::rendering
