// Tells whether a device reaches the objects of a scene, which its file puts somewhere in its
// reach.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/reach/reach_map.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// An object and the share of its box that the handle reaches.
struct ObjectReach {
  std::string name;
  double reached_share = 0.0;
  // The box in the device's frame, m.
  ReachBox box_B;
};

// Returns the reach of every object. A name may be empty; the object is then known by its number.
std::vector<ObjectReach> reach_of_objects(const ReachMap& map,
                                          std::span<const rendering::Object> objects,
                                          std::span<const std::string_view> names);

// Returns the workspace_origin_m, m, with which the middle of all objects lies in the middle of the
// workspace.
Vec3 centred_origin(const ReachMap& map, std::span<const ObjectReach> objects);

// Returns the reach in words, one line an object, and the remedy if some are out of reach.
std::string scene_reach_text(const ReachMap& map, std::span<const ObjectReach> objects);

}  // namespace tactus::host
