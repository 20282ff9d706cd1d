#include "rendering/world/effect_touch.h"

namespace tactus::rendering {

void EffectTouch::hold() {
  for (EffectState& state : states_) {
    state.held_force_W = Vec3::Zero();
  }
}

}  // namespace tactus::rendering
