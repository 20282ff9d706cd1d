// A pull to an anchor with damping: K d - B v.
#pragma once

#include "rendering/effects/law.h"
#include "rendering/effects/laws/spring.h"

namespace tactus::rendering {

struct SpringDamper {
  static constexpr std::string_view kName = "spring_damper";

  Spring spring;
  double damping_Ns_per_m = 0.0;

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    Spring::visit_fields(law.spring, visit);
    visit(kDampingField, law.damping_Ns_per_m);
  }
};

LawForce force_of(const SpringDamper& law, const LawInput& input);
double stored_by(const SpringDamper& law, const LawPlace& place);
LawSlopes steepest_of(const SpringDamper& law, double max_force_N);

}  // namespace tactus::rendering
