// The friction of a material as the models of friction/ take it. The contact methods call it: the
// room friction knows nothing of materials.
#pragma once

#include "rendering/friction/surface_friction.h"
#include "rendering/material/material.h"

namespace tactus::rendering {

// Returns the sliding surface of a contact; the grain's direction is in the object's own frame.
inline SlidingSurface sliding_surface(const Material& material) {
  return {.friction = material.friction,
          .stiffness_N_per_m = material.stiffness_N_per_m,
          .grain = {.direction = to_vec3(material.grain.direction_O),
                    .along = material.grain.along,
                    .across = material.grain.across}};
}

// Returns true if the friction circle's exact rule (cone.h) applies and no model runs.
inline bool is_plain_cone(const Material& material) {
  return material.friction.kind == FrictionKind::cone && !material.grain.differs();
}

}  // namespace tactus::rendering
