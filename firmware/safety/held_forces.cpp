#include "firmware/safety/held_forces.h"

namespace tactus::firmware {

void HeldForces::restart() {
  ring_.fill({});
  newest_ = 0;
}

HeldForce HeldForces::acting() const {
  const HeldForce& late = back(whole_);
  const HeldForce& later = back(whole_ + 1);
  return {.all_W = late.all_W + share_ * (later.all_W - late.all_W),
          .rendered_W = late.rendered_W + share_ * (later.rendered_W - late.rendered_W),
          .effect_W = late.effect_W + share_ * (later.effect_W - late.effect_W)};
}

HeldForce HeldForces::acting_over(std::size_t ticks) {
  HeldForce mean = acting();
  const std::size_t more = std::min(ticks, kMost) - 1;
  for (std::size_t tick = 0; tick < more; ++tick) {
    push(HeldForce(newest()));
    const HeldForce next = acting();
    const double weight = 1.0 / static_cast<double>(tick + 2);
    mean.all_W += weight * (next.all_W - mean.all_W);
    mean.rendered_W += weight * (next.rendered_W - mean.rendered_W);
    mean.effect_W += weight * (next.effect_W - mean.effect_W);
  }
  return mean;
}

}  // namespace tactus::firmware
