#include "rendering/world/world.h"

#include <algorithm>
#include <limits>

namespace tactus::rendering {

bool World::set_scene(std::span<const Object> objects, const WorldConfig& config) {
  const bool good_config =
      config.tool_radius_m >= 0.0 && config.tool_count >= 1 && config.tool_count <= kMaxTools;
  const bool good = scenery_.set(good_config ? objects : std::span<const Object>{}) && good_config;
  time_s_ = 0.0;
  tool_count_ = good ? config.tool_count : 1;
  for (ToolTouch& tool : tools_) {
    tool.start(good ? config.tool_radius_m : 0.0);
  }
  return good;
}

void World::reset() {
  for (ToolTouch& tool : tools_) {
    tool.reset();
  }
}

Touch World::touch(const ToolState& tool, ProxyPath* path) {
  scenery_.begin_tick(time_s_);
  time_s_ += tick_s_;
  return tools_[0].touch(scenery_, tool, path);
}

void World::touch(std::span<const ToolState> tools, std::span<Touch> touches) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  scenery_.begin_tick(time_s_);
  time_s_ += tick_s_;
  for (std::size_t i = 0; i < tool_count_; ++i) {
    const ToolState tool = i < tools.size() ? tools[i] : ToolState{.p_W = Vec3::Constant(kNone)};
    const Touch touch = tools_[i].touch(scenery_, tool, nullptr);
    if (i < touches.size()) {
      touches[i] = touch;
    }
  }
}

std::size_t World::peak_candidates() const {
  return std::ranges::max_element(tools_, {}, &ToolTouch::peak_candidates)->peak_candidates();
}

}  // namespace tactus::rendering
