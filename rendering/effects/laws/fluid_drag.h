// Resistance in a volume: -(B + C |v|) v inside it, growing from nothing at its surface to all at a
// depth of `rim_m`.
#pragma once

#include "rendering/effects/law.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

struct FluidDrag {
  static constexpr std::string_view kName = "fluid_drag";

  Primitive volume;
  double linear_Ns_per_m = 0.0;
  double quadratic_Ns2_per_m2 = 0.0;
  double rim_m = 0.0;  // >= 0

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(VolumeField{}, law.volume);
    visit(kDampingField, law.linear_Ns_per_m);
    visit(NumberField{.key = "quadratic_Ns2_per_m2", .unit = "Ns2_per_m2"},
          law.quadratic_Ns2_per_m2);
    visit(NumberField{.key = "rim_m", .unit = "m"}, law.rim_m);
  }
};

LawForce force_of(const FluidDrag& law, const LawInput& input);
double stored_by(const FluidDrag& law, const LawPlace& place);
LawSlopes steepest_of(const FluidDrag& law, double max_force_N);

}  // namespace tactus::rendering
