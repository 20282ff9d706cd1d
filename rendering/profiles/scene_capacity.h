// Compares a scene with a profile: the one check of whether the controller has room for it. Baking,
// SceneImage::open, World::set_scene and `tactus inspect` use it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "rendering/profiles/capacity_profile.h"

namespace tactus::rendering {

// The numbers of a scene that the sizes of a profile bound; see CapacityProfile.
struct SceneCounts {
  std::size_t objects = 0;
  std::size_t tools = 0;
  std::size_t movers = 0;
  std::size_t independent_objects = 0;
  std::size_t deformables = 0;
  std::size_t deformable_vertices = 0;
  std::size_t deformable_nodes = 0;
  std::size_t bodies = 0;
  std::size_t obstacles = 0;
  // The parts of the body that has the most of them.
  std::size_t parts_of_body = 0;
  std::size_t body_parts = 0;
  std::size_t effects = 0;
  std::size_t tissues = 0;
};

// A size of a profile that bounds scenes.
struct SceneCapacity {
  // The name of the profile's member, and the noun of what it counts.
  std::string_view name;
  std::string_view noun;
  std::size_t SceneCounts::* count;
  std::size_t CapacityProfile::* limit;
};

// All of them, in the order in which a scene is checked.
inline constexpr std::array kSceneCapacities{
    SceneCapacity{"objects", "objects", &SceneCounts::objects, &CapacityProfile::objects},
    SceneCapacity{"tools", "tools", &SceneCounts::tools, &CapacityProfile::tools},
    SceneCapacity{"effects", "effects", &SceneCounts::effects, &CapacityProfile::effects},
    SceneCapacity{"bodies", "bodies", &SceneCounts::bodies, &CapacityProfile::bodies},
    SceneCapacity{"parts_of_body", "convex parts of one body", &SceneCounts::parts_of_body,
                  &CapacityProfile::parts_of_body},
    SceneCapacity{"body_parts", "convex parts of all bodies", &SceneCounts::body_parts,
                  &CapacityProfile::body_parts},
    SceneCapacity{"tissues", "objects with tissue", &SceneCounts::tissues,
                  &CapacityProfile::tissues},
    SceneCapacity{"movers", "objects that move or deform", &SceneCounts::movers,
                  &CapacityProfile::movers},
    SceneCapacity{"independent_objects",
                  "objects with a contact other than sphere_proxy and god_object",
                  &SceneCounts::independent_objects, &CapacityProfile::independent_objects},
    SceneCapacity{"deformables", "meshes that deform", &SceneCounts::deformables,
                  &CapacityProfile::deformables},
    SceneCapacity{"deformable_vertices", "vertices of meshes that deform",
                  &SceneCounts::deformable_vertices, &CapacityProfile::deformable_vertices},
    SceneCapacity{"deformable_nodes", "boxes of meshes that deform", &SceneCounts::deformable_nodes,
                  &CapacityProfile::deformable_nodes},
    SceneCapacity{"obstacles", "objects without a body beside bodies", &SceneCounts::obstacles,
                  &CapacityProfile::obstacles},
};

// A capacity with less room than a scene needs. Name and noun are those of SceneCapacity.
struct ExceededCapacity {
  std::string_view name;
  std::string_view noun;
  // The number that the scene has, and the most that the profile has room for.
  std::size_t count = 0;
  std::size_t limit = 0;
};

// Returns the capacity if the scene exceeds it.
std::optional<ExceededCapacity> exceeded(const SceneCapacity& capacity, const SceneCounts& counts,
                                         const CapacityProfile& profile);

// Returns the first capacity of the profile that the scene exceeds; nothing if the scene fits.
std::optional<ExceededCapacity> first_exceeded(const SceneCounts& counts,
                                               const CapacityProfile& profile);

// Returns the capacity, both numbers, this build's profile and the remedy in words: which profile
// has room, if one has. The text is written into `room` and cut at its end; 256 bytes are enough.
std::string_view exceeded_words(const ExceededCapacity& capacity, std::span<char> room);

}  // namespace tactus::rendering
