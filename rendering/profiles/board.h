// The profile of Linux boards. It refuses larger scenes than the profile desktop; a scene that it
// takes gives the same bits in both, because the sizes that a tick can reach are the same.
#pragma once

#include "rendering/profiles/capacity_profile.h"

namespace tactus::rendering {

inline constexpr CapacityProfile kBoardProfile{
    .name = "board",
    .objects = 256,
    .tools = 10,
    .movers = 64,
    .independent_objects = 64,
    .deformables = 8,
    .deformable_vertices = 3072,
    .deformable_nodes = 4608,
    .bodies = 32,
    .obstacles = 32,
    .parts_of_body = 16,
    .body_parts = 64,
    .effects = 16,
    .tissues = 16,
    .changed_objects = 64,
    .body_contacts = 128,
    .near_triangles = 128,
    .candidates = 512,
    .controller_bytes = std::size_t{2} << 20,
    .checkpoint_bytes = std::size_t{512} << 10,
    .flight_ticks = 16384,
    .waiting_commands = 16,
    .waiting_answers = 64,
};

}  // namespace tactus::rendering
