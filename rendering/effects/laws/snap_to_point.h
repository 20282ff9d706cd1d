// A draw to a point within the capture distance (snap.h).
#pragma once

#include "rendering/effects/law.h"
#include "rendering/effects/snap.h"

namespace tactus::rendering {

struct SnapToPoint {
  static constexpr std::string_view kName = "snap_to_point";

  Vec3 point_W = Vec3::Zero();
  SnapLaw law;

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(kPositionField, law.point_W);
    SnapLaw::visit_fields(law.law, visit);
  }
};

LawForce force_of(const SnapToPoint& law, const LawInput& input);
double stored_by(const SnapToPoint& law, const LawPlace& place);
LawSlopes steepest_of(const SnapToPoint& law, double max_force_N);

}  // namespace tactus::rendering
