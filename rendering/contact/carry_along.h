// What objects that move do to a proxy that rests: the one that it touches takes it along, and
// those that come its way push it, at any speed.
#pragma once

#include <cstdint>

#include "rendering/contact/left_out.h"
#include "rendering/contact/sphere_sweep.h"
#include "rendering/world/scene_objects.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

// What held the proxy last.
struct LastContact {
  std::uint32_t object = kNoObject;
  std::uint32_t triangle = 0;    // of its mesh
  Vec3 normal_W = Vec3::Zero();  // unit, of the joint push of all that held it
};

struct Carried {
  Vec3 p_W = Vec3::Zero();            // m; clear of every object where it is now
  std::uint32_t flags = kTouchClean;  // pinched
};

// Of a proxy at p_W, clear of every object where it was in the last tick, but for those that are
// left out. Seen from each object the
// proxy goes straight from where it was to where it is, and crosses nothing. Real time: bounded
// work, no heap.
Carried carry_along(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p_W,
                    const LastContact& last_contact, const LeftOut& left_out = {});

}  // namespace tactus::rendering
