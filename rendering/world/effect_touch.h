// The effects of a scene on one tool, with the energy account of each. World keeps one for every
// tool.
#pragma once

#include <array>
#include <span>

#include "rendering/effects/effect.h"
#include "rendering/limits.h"
#include "rendering/state_archive.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// The states of all effects for one tool.
class EffectTouch {
 public:
  // Starts over: anchors, phases and accounts.
  void reset() { states_ = {}; }

  // Adds the effects' forces to `touch`. At most kMaxEffects, valid; the tool finite; tick_s > 0.
  // No heap.
  void add_to(Touch& touch, std::span<const Effect> effects, const ToolState& tool, double tick_s) {
    for (std::size_t i = 0; i < effects.size(); ++i) {
      touch.parts.effect_W += apply(effects[i], states_[i], tool, tick_s);
    }
    touch.force_W += touch.parts.effect_W;
  }

  // Ends the effects in a tick without a valid tool: the hand gets no force until the next. Call it
  // instead of add_to.
  void hold();

  // Returns the energy that effect `index` has given to the hand since the start, J.
  [[nodiscard]] double delivered_J(std::size_t index) const { return states_[index].delivered_J; }

  // Saves the state of the first `effects` effects to the archive, or restores it.
  void transfer(StateArchive& archive, std::size_t effects);

 private:
  // One state for each effect of the scene, in its order.
  std::array<EffectState, kMaxEffects> states_{};
};

}  // namespace tactus::rendering
