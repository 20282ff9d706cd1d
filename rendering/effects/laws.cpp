#include "rendering/effects/laws.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {
namespace {

// `v` shortened to the length `most`.
Vec3 bounded(const Vec3& v, double most) {
  const double length = v.norm();
  return length > most ? Vec3{most / length * v} : v;
}

// The energy of a spring of length d whose pull stops growing at `most`.
double spring_energy(double stiffness, double d, double most) {
  if (stiffness * d <= most) {
    return 0.5 * stiffness * d * d;
  }
  return most * (d - 0.5 * most / stiffness);
}

// `offset` leads from the tool to the target, `velocity` is what of the tool's is to be damped.
LawForce snap(const SnapLaw& law, const Vec3& offset, const Vec3& velocity, double most) {
  const double r = offset.norm();
  if (!(r < law.capture_m)) {
    return {};
  }
  const double grip = std::min(1.0, 2.0 * (1.0 - r / law.capture_m));
  const double pull = law.stiffness_N_per_m * std::min(r, law.capture_m - r);
  LawForce force{.damping_W = -grip * law.damping_Ns_per_m * velocity};
  if (r > 0.0) {
    force.elastic_W = std::min(pull, most) / r * offset;
  }
  return force;
}

// The integral of snap's pull from 0 to r: that of the rising side, of a level top where the bound
// cuts it off, and the mirror image of the rising side.
double snap_energy(const SnapLaw& law, double r, double most) {
  const double half = 0.5 * law.capture_m;
  const double rising = spring_energy(law.stiffness_N_per_m, std::min(r, half), most);
  if (r <= half) {
    return rising;
  }
  const double left = std::max(0.0, law.capture_m - r);
  return 2.0 * rising - spring_energy(law.stiffness_N_per_m, left, most);
}

Vec3 toward(const SnapToPoint& law, const Vec3& p) {
  return law.point_W - p;
}

Vec3 toward(const SnapToLine& law, const Vec3& p) {
  const Vec3 offset = law.point_W - p;
  return offset - offset.dot(law.direction_W) * law.direction_W;
}

Vec3 toward(const SnapToPlane& law, const Vec3& p) {
  return (law.point_W - p).dot(law.normal_W) * law.normal_W;
}

// S of the magnet, N m^2: the pull S d / (d^2 + core^2)^(3/2) is strongest at core / sqrt(2).
double pole_strength(const Magnet& law, double most) {
  constexpr double kHalfOf3Root3 = 2.598076211353316;
  return kHalfOf3Root3 * std::clamp(law.strength_N, -most, most) * law.core_m * law.core_m;
}

}  // namespace

LawForce force_of(const Spring& law, const LawInput& input) {
  const Vec3 pull = law.stiffness_N_per_m * (law.anchor_W - input.tool.p_W);
  return {.elastic_W = bounded(pull, input.max_force_N)};
}

LawForce force_of(const SpringDamper& law, const LawInput& input) {
  LawForce force = force_of(law.spring, input);
  force.damping_W = -law.damping_Ns_per_m * input.tool.v_W;
  return force;
}

LawForce force_of(const FluidDrag& law, const LawInput& input) {
  const double depth = -sample(law.volume, input.tool.p_W).distance_m;
  if (depth <= 0.0) {
    return {};
  }
  const double share = depth < law.rim_m ? depth / law.rim_m : 1.0;
  const double drag = law.linear_Ns_per_m + law.quadratic_Ns2_per_m2 * input.tool.v_W.norm();
  return {.damping_W = -share * drag * input.tool.v_W};
}

LawForce force_of(const Magnet& law, const LawInput& input) {
  const Vec3 to_pole = law.pole_W - input.tool.p_W;
  const double squared = to_pole.squaredNorm() + law.core_m * law.core_m;
  const double strength = pole_strength(law, input.max_force_N);
  return {.elastic_W = strength / (squared * std::sqrt(squared)) * to_pole};
}

LawForce force_of(const ConstantField& law, const LawInput& input) {
  return {.elastic_W = bounded(law.force_W, input.max_force_N)};
}

LawForce force_of(const Vibration& law, const LawInput& input) {
  const double turns = law.frequency_Hz * input.dt_s;
  if (!(turns < 0.5)) {
    return {};
  }
  const double push = std::min(law.amplitude_N, input.max_force_N) * sine(input.state.phase);
  input.state.phase += phase_of_turns(turns);
  return {.elastic_W = push * law.direction_W};
}

LawForce force_of(const StickSlip& law, const LawInput& input) {
  const double most = std::min(law.break_force_N, input.max_force_N);
  const Vec3 pull = law.stiffness_N_per_m * (input.state.anchor_W - input.tool.p_W);
  if (pull.squaredNorm() > most * most) {
    input.state.anchor_W = input.tool.p_W;
    return {};
  }
  return {.elastic_W = pull};
}

LawForce force_of(const SnapToPoint& law, const LawInput& input) {
  return snap(law.law, toward(law, input.tool.p_W), input.tool.v_W, input.max_force_N);
}

LawForce force_of(const SnapToLine& law, const LawInput& input) {
  const Vec3 across =
      input.tool.v_W - input.tool.v_W.dot(law.direction_W) * law.direction_W;  // slides freely
  return snap(law.law, toward(law, input.tool.p_W), across, input.max_force_N);
}

LawForce force_of(const SnapToPlane& law, const LawInput& input) {
  const Vec3 across = input.tool.v_W.dot(law.normal_W) * law.normal_W;
  return snap(law.law, toward(law, input.tool.p_W), across, input.max_force_N);
}

double stored_by(const Spring& law, const LawPlace& place) {
  return spring_energy(law.stiffness_N_per_m, (law.anchor_W - place.p_W).norm(), place.max_force_N);
}

double stored_by(const SpringDamper& law, const LawPlace& place) {
  return stored_by(law.spring, place);
}

double stored_by(const FluidDrag& /*law*/, const LawPlace& /*place*/) {
  return 0.0;
}

double stored_by(const Magnet& law, const LawPlace& place) {
  const double strength = pole_strength(law, place.max_force_N);
  const double squared = (law.pole_W - place.p_W).squaredNorm() + law.core_m * law.core_m;
  const double to_infinity = -strength / std::sqrt(squared);
  return strength > 0.0 ? strength / law.core_m + to_infinity : to_infinity;
}

double stored_by(const ConstantField& law, const LawPlace& place) {
  return -bounded(law.force_W, place.max_force_N).dot(place.p_W);
}

double stored_by(const Vibration& /*law*/, const LawPlace& /*place*/) {
  return 0.0;
}

double stored_by(const StickSlip& law, const LawPlace& place) {
  if (!place.state.started) {
    return 0.0;
  }
  const double most = std::min(law.break_force_N, place.max_force_N);
  const double pull = law.stiffness_N_per_m * (place.state.anchor_W - place.p_W).norm();
  return pull > most ? 0.0 : 0.5 * pull * pull / law.stiffness_N_per_m;
}

double stored_by(const SnapToPoint& law, const LawPlace& place) {
  return snap_energy(law.law, toward(law, place.p_W).norm(), place.max_force_N);
}

double stored_by(const SnapToLine& law, const LawPlace& place) {
  return snap_energy(law.law, toward(law, place.p_W).norm(), place.max_force_N);
}

double stored_by(const SnapToPlane& law, const LawPlace& place) {
  return snap_energy(law.law, toward(law, place.p_W).norm(), place.max_force_N);
}

}  // namespace tactus::rendering
