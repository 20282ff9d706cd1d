// A pull like that of a pole under a skin of `core_m`: S d / (|d|^2 + core^2)^(3/2), with S such
// that the pull is `strength_N` where it is strongest, at core / sqrt(2). Negative strength pushes
// away.
#pragma once

#include "rendering/effects/law.h"

namespace tactus::rendering {

struct Magnet {
  static constexpr std::string_view kName = "magnet";

  Vec3 pole_W = Vec3::Zero();
  double strength_N = 0.0;
  double core_m = 0.01;  // > 0

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(kPositionField, law.pole_W);
    visit(NumberField{.key = "strength_N", .unit = "N", .range = FieldRange::any, .example = "2.0"},
          law.strength_N);
    visit(
        NumberField{
            .key = "core_m", .unit = "m", .range = FieldRange::above_zero, .example = "0.01"},
        law.core_m);
  }
};

LawForce force_of(const Magnet& law, const LawInput& input);
double stored_by(const Magnet& law, const LawPlace& place);
LawSlopes steepest_of(const Magnet& law, double max_force_N);

}  // namespace tactus::rendering
