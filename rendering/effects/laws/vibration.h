// A sine along a direction: amplitude sin(2 pi frequency t). It is silent where the frequency is
// half the tick rate or more: it would come out as another one.
#pragma once

#include "rendering/effects/law.h"

namespace tactus::rendering {

struct Vibration {
  static constexpr std::string_view kName = "vibration";

  Vec3 direction_W = Vec3::UnitY();  // unit
  double amplitude_N = 0.0;
  double frequency_Hz = 0.0;

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(kDirectionField, law.direction_W);
    visit(NumberField{.key = "amplitude_N", .unit = "N", .example = "0.3"}, law.amplitude_N);
    visit(NumberField{.key = "frequency_Hz", .unit = "Hz", .example = "120.0"}, law.frequency_Hz);
  }
};

LawForce force_of(const Vibration& law, const LawInput& input);
double stored_by(const Vibration& law, const LawPlace& place);
LawSlopes steepest_of(const Vibration& law, double max_force_N);

}  // namespace tactus::rendering
