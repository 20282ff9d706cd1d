// Shows which profiles of the controller have room for a scene. The verb inspect uses it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "rendering/profiles/capacity_profile.h"
#include "rendering/profiles/scene_capacity.h"

namespace tactus::host {

// Returns for each profile whether the scene fits, and every capacity that it exceeds.
nlohmann::ordered_json json_of_profiles(const rendering::SceneCounts& counts,
                                        std::span<const rendering::CapacityProfile> profiles);

// Prints the same, one profile a line.
void print_profiles(const rendering::SceneCounts& counts,
                    std::span<const rendering::CapacityProfile> profiles);

}  // namespace tactus::host
