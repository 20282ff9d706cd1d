// A pull to an anchor: K d, where d is the vector from the tool to the anchor.
#pragma once

#include "rendering/effects/law.h"

namespace tactus::rendering {

struct Spring {
  static constexpr std::string_view kName = "spring";

  Vec3 anchor_W = Vec3::Zero();  // m
  double stiffness_N_per_m = 0.0;

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(kPositionField, law.anchor_W);
    visit(kStiffnessField, law.stiffness_N_per_m);
  }
};

LawForce force_of(const Spring& law, const LawInput& input);
double stored_by(const Spring& law, const LawPlace& place);
LawSlopes steepest_of(const Spring& law, double max_force_N);

}  // namespace tactus::rendering
