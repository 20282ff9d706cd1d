// A spring to where the tool last stuck. When it pulls harder than `break_force_N` it lets go and
// sticks anew where the tool is.
#pragma once

#include "rendering/effects/law.h"

namespace tactus::rendering {

struct StickSlip {
  static constexpr std::string_view kName = "stick_slip";

  double stiffness_N_per_m = 0.0;  // > 0
  double break_force_N = 0.0;

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(NumberField{.key = kStiffnessField.key,
                      .unit = kStiffnessField.unit,
                      .range = FieldRange::above_zero,
                      .example = kStiffnessField.example},
          law.stiffness_N_per_m);
    visit(NumberField{.key = "break_force_N", .unit = "N", .example = "0.5"}, law.break_force_N);
  }
};

LawForce force_of(const StickSlip& law, const LawInput& input);
double stored_by(const StickSlip& law, const LawPlace& place);
LawSlopes steepest_of(const StickSlip& law, double max_force_N);

}  // namespace tactus::rendering
