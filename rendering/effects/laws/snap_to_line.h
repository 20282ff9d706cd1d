// A draw to a line within the capture distance (snap.h); along the line the tool slides freely.
#pragma once

#include "rendering/effects/law.h"
#include "rendering/effects/snap.h"

namespace tactus::rendering {

struct SnapToLine {
  static constexpr std::string_view kName = "snap_to_line";

  Vec3 point_W = Vec3::Zero();       // anywhere on it
  Vec3 direction_W = Vec3::UnitX();  // unit
  SnapLaw law;

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(kPositionField, law.point_W);
    SnapLaw::visit_fields(law.law, visit);
    visit(kDirectionField, law.direction_W);
  }
};

LawForce force_of(const SnapToLine& law, const LawInput& input);
double stored_by(const SnapToLine& law, const LawPlace& place);
LawSlopes steepest_of(const SnapToLine& law, double max_force_N);

}  // namespace tactus::rendering
