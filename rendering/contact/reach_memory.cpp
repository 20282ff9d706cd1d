#include "rendering/contact/reach_memory.h"

namespace tactus::rendering {

void ReachMemory::move_there(const Vec3& p, const Key& now) {
  const TangentBounds::Position at = bounds_.at(p);
  here_.count = 0;
  for (const std::uint16_t i : there_.all()) {
    here_.numbers[here_.count] = i;
    here_.count += bounds_.may_reach(i, at) ? 1U : 0U;
  }
  known_for_ = now;
}

}  // namespace tactus::rendering
