#include "rendering/world/effect_touch.h"

namespace tactus::rendering {

void EffectTouch::add_to(Touch& touch, std::span<const Effect> effects, const ToolState& tool,
                         double tick_s) {
  for (std::size_t i = 0; i < effects.size(); ++i) {
    touch.parts.effect_W += apply(effects[i], states_[i], tool, tick_s);
  }
  touch.force_W += touch.parts.effect_W;
}

void EffectTouch::hold() {
  for (EffectState& state : states_) {
    state.held_force_W = Vec3::Zero();
  }
}

}  // namespace tactus::rendering
