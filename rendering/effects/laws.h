// Each law of effect.h for itself: is it valid, what does it push, what does it store. Used by
// effect.cpp alone.
#pragma once

#include "rendering/effects/effect.h"

namespace tactus::rendering {

struct LawInput {
  const ToolState& tool;
  EffectState& state;  // anchor and phase are the law's to change
  double dt_s;
  double max_force_N;
};

struct LawForce {
  Vec3 elastic_W = Vec3::Zero();  // N, no longer than max_force_N
  Vec3 damping_W = Vec3::Zero();  // N, any length, never with the velocity
};

struct LawPlace {
  const EffectState& state;
  const Vec3& p_W;
  double max_force_N;
};

bool valid_law(const Spring& law);
bool valid_law(const SpringDamper& law);
bool valid_law(const FluidDrag& law);
bool valid_law(const Magnet& law);
bool valid_law(const ConstantField& law);
bool valid_law(const Vibration& law);
bool valid_law(const StickSlip& law);
bool valid_law(const SnapToPoint& law);
bool valid_law(const SnapToLine& law);
bool valid_law(const SnapToPlane& law);

LawForce force_of(const Spring& law, const LawInput& input);
LawForce force_of(const SpringDamper& law, const LawInput& input);
LawForce force_of(const FluidDrag& law, const LawInput& input);
LawForce force_of(const Magnet& law, const LawInput& input);
LawForce force_of(const ConstantField& law, const LawInput& input);
LawForce force_of(const Vibration& law, const LawInput& input);
LawForce force_of(const StickSlip& law, const LawInput& input);
LawForce force_of(const SnapToPoint& law, const LawInput& input);
LawForce force_of(const SnapToLine& law, const LawInput& input);
LawForce force_of(const SnapToPlane& law, const LawInput& input);

double stored_by(const Spring& law, const LawPlace& place);
double stored_by(const SpringDamper& law, const LawPlace& place);
double stored_by(const FluidDrag& law, const LawPlace& place);
double stored_by(const Magnet& law, const LawPlace& place);
double stored_by(const ConstantField& law, const LawPlace& place);
double stored_by(const Vibration& law, const LawPlace& place);
double stored_by(const StickSlip& law, const LawPlace& place);
double stored_by(const SnapToPoint& law, const LawPlace& place);
double stored_by(const SnapToLine& law, const LawPlace& place);
double stored_by(const SnapToPlane& law, const LawPlace& place);

}  // namespace tactus::rendering
