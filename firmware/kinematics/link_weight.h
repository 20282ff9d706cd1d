// What gravity pulls on: the mass of a moving part and where along it the centre of mass lies.
//
// A mechanism's gravity effort is dU/dq of its weights' potential U = -sum m g . c(q): what the
// joints must give to hold it up. A mechanism without weights needs none.
#pragma once

namespace tactus::firmware {

struct LinkWeight {
  double mass_kg = 0.0;
  // From the link's inner joint along the line to its outer one; negative behind the inner joint,
  // as of a counterweight.
  double centre_m = 0.0;

  [[nodiscard]] double moment_kg_m() const { return mass_kg * centre_m; }
};

}  // namespace tactus::firmware
