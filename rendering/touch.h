// The input and the output of a touch, each tick.
#pragma once

#include <cstdint>

#include "rendering/geometry/triangle.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The tool's centre in the world frame W (right-handed: x right, y up, z toward the user).
struct ToolState {
  Vec3 p_W = Vec3::Zero();  // m
  Vec3 v_W = Vec3::Zero();  // m/s
};

// The feature of the surface that the proxy rests on; with several constraints that of the first.
enum class ContactKind : std::uint8_t { none = 0, face = 1, edge = 2, vertex = 3 };

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

// The friction cone's state. `free` means no contact.
enum class FrictionState : std::uint8_t { free = 0, stick = 1, slip = 2 };

// The limits that a touch reached, one bit each; 0 is a clean tick. With every bit the force stays
// bounded and the proxy has crossed nothing.
enum TouchFlags : std::uint32_t {
  kTouchClean = 0,
  kTouchCandidatesOverflow =
      1U << 0,  // more triangles near the tool than kMaxCandidates: slower path taken
  kTouchIterationsExhausted = 1U << 1,  // the tick budget or kMaxSubGoals is spent: the proxy is
                                        // short of its minimum this tick
  kTouchPlanesOverflow = 1U << 2,       // more contact planes than kMaxContactPlanes
  kTouchToolInvalid = 1U << 3,  // not finite or beyond kWorldBound_m: proxy held, zero force
  kTouchPinched =
      1U << 4,  // objects that moved left the proxy no room: some of them passed over it
  kTouchOverlap = 1U << 5,  // an object that the tool began in or came out of is not felt until the
                            // tool is clear of it
};

// The parts of a touch's force, N on the hand, world frame. The rest of the force is the surfaces'
// own: the normal force and the damping.
struct ForceParts {
  Vec3 friction_W = Vec3::Zero();  // what holds the tool back along the surface
  Vec3 texture_W = Vec3::Zero();   // what bumps, stiffness maps and shading change
  Vec3 effect_W = Vec3::Zero();    // effects, which need no surface
  double driven_power = 0.0;       // watts to the hand by surfaces that move by themselves
};

struct Touch {
  Vec3 proxy_W = Vec3::Zero();   // m
  Vec3 normal_W = Vec3::Zero();  // unit, away from the surface; zero without contact
  Vec3 force_W = Vec3::Zero();   // N, on the hand: K (proxy - tool) - B v; zero without contact
  double depth_m = 0.0;          // (proxy - tool) . normal
  ContactKind contact = ContactKind::none;
  FrictionState friction = FrictionState::free;
  std::uint16_t sub_goals = 0;  // straight moves that the proxy made this tick
  std::uint16_t planes = 0;     // constraints that hold the proxy: 0 to 3
  std::uint32_t object = 0;     // index of the touched object, meaningful in contact
  std::uint32_t flags = kTouchClean;
  ForceParts parts;
};

}  // namespace tactus::rendering
