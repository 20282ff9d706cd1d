// The profile of computers with memory to spare: simulation, baking, and boards of the size of a
// desktop.
#pragma once

#include "rendering/profiles/capacity_profile.h"

namespace tactus::rendering {

inline constexpr CapacityProfile kDesktopProfile{
    .name = "desktop",
    .objects = 1024,
    .tools = 10,
    .movers = 64,
    .independent_objects = 64,
    .deformables = 8,
    .deformable_vertices = 4096,
    .deformable_nodes = 6144,
    .bodies = 32,
    .obstacles = 64,
    .parts_of_body = 16,
    .body_parts = 128,
    .effects = 16,
    .tissues = 16,
    .changed_objects = 64,
    .body_contacts = 128,
    .near_triangles = 128,
    .candidates = 512,
    .controller_bytes = std::size_t{3} << 20,
    .checkpoint_bytes = std::size_t{512} << 10,
    .flight_ticks = 16384,
    .waiting_commands = 16,
    .waiting_answers = 64,
};

}  // namespace tactus::rendering
