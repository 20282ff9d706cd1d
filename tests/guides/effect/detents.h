// Notches along a direction, one every `pitch_m`: the force is -amplitude sin(2 pi s / pitch),
// where s is the tool's coordinate along the direction.
#pragma once

#include "rendering/effects/law.h"

namespace tactus::rendering {

struct Detents {
  static constexpr std::string_view kName = "detents";

  Vec3 direction_W = Vec3::UnitX();  // unit
  double amplitude_N = 0.0;
  double pitch_m = 0.01;  // > 0

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(kDirectionField, law.direction_W);
    visit(NumberField{.key = "amplitude_N", .unit = "N", .example = "0.5"}, law.amplitude_N);
    visit(
        NumberField{
            .key = "pitch_m", .unit = "m", .range = FieldRange::above_zero, .example = "0.01"},
        law.pitch_m);
  }
};

LawForce force_of(const Detents& law, const LawInput& input);
double stored_by(const Detents& law, const LawPlace& place);
LawSlopes steepest_of(const Detents& law, double max_force_N);

}  // namespace tactus::rendering
