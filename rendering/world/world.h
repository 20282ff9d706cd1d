// The virtual world that one tool touches.
#pragma once

#include <span>

#include "rendering/world/object.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

struct WorldConfig {
  double tool_radius_m = 0.0;  // 0 is the god-object point
};

// Draft interface: the implementation follows.
class World {
 public:
  // Takes a scene; the views must outlive the world. At most kMaxObjects objects; false (and an
  // empty world) beyond.
  bool set_scene(std::span<const Object> objects, const WorldConfig& config);

  // Forgets the contact: the next touch starts with the proxy at the tool.
  void reset();

  // One tick. No heap, no exceptions, bounded work.
  Touch touch(const ToolState& tool);
};

}  // namespace tactus::rendering
