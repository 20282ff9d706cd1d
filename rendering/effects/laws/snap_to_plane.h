// A draw to a plane within the capture distance (snap.h); in the plane the tool slides freely.
#pragma once

#include "rendering/effects/law.h"
#include "rendering/effects/snap.h"

namespace tactus::rendering {

struct SnapToPlane {
  static constexpr std::string_view kName = "snap_to_plane";

  Vec3 point_W = Vec3::Zero();    // anywhere on it
  Vec3 normal_W = Vec3::UnitY();  // unit
  SnapLaw law;

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(kPositionField, law.point_W);
    SnapLaw::visit_fields(law.law, visit);
    visit(kDirectionField, law.normal_W);
  }
};

LawForce force_of(const SnapToPlane& law, const LawInput& input);
double stored_by(const SnapToPlane& law, const LawPlace& place);
LawSlopes steepest_of(const SnapToPlane& law, double max_force_N);

}  // namespace tactus::rendering
