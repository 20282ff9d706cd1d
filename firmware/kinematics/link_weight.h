// The mass of a moving link and the place of its centre of mass.
//
// A mechanism's gravity effort is dU/dq of its weights' potential U = -sum m g . c(q): the joint
// efforts that hold it. A mechanism without weights needs none.
#pragma once

#include "rendering/state_archive.h"

namespace tactus::firmware {

// The weight of one link. The default has none.
struct LinkWeight {
  double mass_kg = 0.0;
  // Distance of the centre of mass from the link's inner joint, along the line to its outer joint.
  // Negative behind the inner joint, as for a counterweight.
  double centre_m = 0.0;

  // Returns mass times distance: gravity times it is the joint's effort with the link level.
  [[nodiscard]] double moment_kg_m() const { return mass_kg * centre_m; }
};

inline void transfer(rendering::StateArchive& archive, LinkWeight& weight) {
  auto& [mass_kg, centre_m] = weight;
  archive(mass_kg, centre_m);
}

}  // namespace tactus::firmware
