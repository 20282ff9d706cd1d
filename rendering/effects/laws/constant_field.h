// A constant field: the same force everywhere.
#pragma once

#include "rendering/effects/law.h"

namespace tactus::rendering {

struct ConstantField {
  static constexpr std::string_view kName = "constant_field";

  Vec3 force_W = Vec3::Zero();  // N

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(VectorField{.key = "force_N",
                      .unit = "N",
                      .use = VectorUse::quantity,
                      .example = "[0.0, -0.5, 0.0]"},
          law.force_W);
  }
};

LawForce force_of(const ConstantField& law, const LawInput& input);
double stored_by(const ConstantField& law, const LawPlace& place);
LawSlopes steepest_of(const ConstantField& law, double max_force_N);

}  // namespace tactus::rendering
