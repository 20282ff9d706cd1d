// The sizes of the controller's fixed arrays. A build has one profile, and its limits are those of
// rendering/limits.h and firmware/limits.h, which say what happens beyond each of them.
//
// A profile has sizes alone. What a result depends on (contact planes, sub-goals, budgets, patches)
// is the same in every profile, so that a tick gives the same bits wherever no size is reached.
#pragma once

#include <cstddef>
#include <string_view>

namespace tactus::rendering {

struct CapacityProfile {
  // The name that a build chooses it by: cmake -D TACTUS_PROFILE=name.
  std::string_view name;

  // The parts of a scene. One with more is refused when it is loaded.
  std::size_t objects;
  // The most tools of one world; the caller gives the storage of all but the first.
  std::size_t tools;
  // Objects that move or deform, and objects that the shared proxy does not meet; at most 254.
  std::size_t movers;
  std::size_t independent_objects;
  // Meshes that deform, and the vertices and hierarchy nodes of all of them.
  std::size_t deformables;
  std::size_t deformable_vertices;
  std::size_t deformable_nodes;
  // Bodies, at most 254, and the objects that they meet.
  std::size_t bodies;
  std::size_t obstacles;
  // Convex parts of one body, and of all bodies.
  std::size_t parts_of_body;
  std::size_t body_parts;
  std::size_t effects;
  // Objects that a needle pierces; at most 254.
  std::size_t tissues;

  // The most that a running scene uses. A tick that reaches one of the last three gives other bits
  // than it would in a larger profile, and says so in Touch::flags where limits.h names a flag.
  //
  // Objects whose material or method is changed while the scene runs; at most 254.
  std::size_t changed_objects;
  // Contacts between bodies, and triangles of one mesh near one body.
  std::size_t body_contacts;
  std::size_t near_triangles;
  // Triangles near one tool; a multiple of four, which are tested at a time.
  std::size_t candidates;

  // The largest size of a Controller of one device, without the scene image. The build fails if it
  // is larger.
  std::size_t controller_bytes;
  // The largest state that Controller::save writes for one device.
  std::size_t checkpoint_bytes;
  // Ticks of the flight recorder, which a Linux board has; a power of two.
  std::size_t flight_ticks;
  // Commands whose answers have not been taken, and the answers that have room, a power of two.
  std::size_t waiting_commands;
  std::size_t waiting_answers;
};

// Returns true if the profile keeps the bounds above, and every size is at least one.
constexpr bool is_sound(const CapacityProfile& profile) {
  constexpr std::size_t kMostNumbered = 254;
  const auto is_power_of_two = [](std::size_t size) {
    return size > 0 && (size & (size - 1)) == 0;
  };
  const auto is_numbered = [](std::size_t size) { return size >= 1 && size <= kMostNumbered; };
  const bool has_scene = !profile.name.empty() && profile.objects >= 1 && profile.tools >= 1 &&
                         is_numbered(profile.movers) && is_numbered(profile.independent_objects) &&
                         profile.deformables >= 1 && profile.deformable_vertices >= 1 &&
                         profile.deformable_nodes >= 1 && profile.effects >= 1 &&
                         is_numbered(profile.tissues);
  const bool has_bodies = is_numbered(profile.bodies) && profile.obstacles >= 1 &&
                          profile.parts_of_body >= 1 && profile.body_parts >= 1 &&
                          profile.body_contacts >= 1 && profile.near_triangles >= 1;
  return has_scene && has_bodies && is_numbered(profile.changed_objects) &&
         profile.candidates >= 4 && profile.candidates % 4 == 0 && profile.controller_bytes >= 1 &&
         profile.checkpoint_bytes >= 1 && profile.flight_ticks >= 8 &&
         is_power_of_two(profile.flight_ticks) && is_power_of_two(profile.waiting_commands) &&
         is_power_of_two(profile.waiting_answers) &&
         profile.waiting_answers > profile.waiting_commands;
}

}  // namespace tactus::rendering
