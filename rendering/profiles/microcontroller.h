// The profile of microcontrollers with a few hundred kilobytes of memory, such as a Cortex-M7: one
// tool, a few objects and effects. Where more triangles are near a tool than it has room for, its
// ticks give other bits than those of the larger profiles.
#pragma once

#include "rendering/profiles/capacity_profile.h"

namespace tactus::rendering {

inline constexpr CapacityProfile kMicrocontrollerProfile{
    .name = "microcontroller",
    .objects = 16,
    .tools = 1,
    .movers = 4,
    .independent_objects = 4,
    .deformables = 1,
    .deformable_vertices = 64,
    .deformable_nodes = 128,
    .bodies = 1,
    .obstacles = 4,
    .parts_of_body = 2,
    .body_parts = 2,
    .effects = 4,
    .tissues = 4,
    .changed_objects = 4,
    .body_contacts = 6,
    .near_triangles = 32,
    .candidates = 128,
    .controller_bytes = std::size_t{176} << 10,
    .checkpoint_bytes = std::size_t{48} << 10,
    .flight_ticks = 1024,
    .waiting_commands = 8,
    .waiting_answers = 32,
};

}  // namespace tactus::rendering
