#include "rendering/needle/shaft_bristle.h"

#include <algorithm>

namespace tactus::rendering {
namespace {

// One direction of a shaft that may slip. Forces and ways are positive in that direction.
struct Direction {
  double breaks_at_N;
  double slides_at_N;
};

// The force after a way, and the energy that a slip took.
struct Step {
  double force_N;
  double lost_J;
  bool slips;
};

// Moves the spring by a way in its direction. The energy is exact for a straight way: the spring is
// stretched until it breaks away, and the rest of the way it slides.
Step stretch(double force_N, double travel_m, double stiffness, const Direction& direction) {
  double lost = 0.0;
  if (force_N > direction.breaks_at_N) {
    // The friction has become less than the spring holds.
    lost += (force_N * force_N - direction.breaks_at_N * direction.breaks_at_N) / (2.0 * stiffness);
    force_N = direction.breaks_at_N;
  }
  const double wanted_N = force_N + stiffness * travel_m;
  if (wanted_N <= direction.breaks_at_N) {
    return {.force_N = wanted_N, .lost_J = lost, .slips = false};
  }
  const double slide_m = travel_m - (direction.breaks_at_N - force_N) / stiffness;
  lost += (direction.breaks_at_N * direction.breaks_at_N -
           direction.slides_at_N * direction.slides_at_N) /
              (2.0 * stiffness) +
          direction.slides_at_N * slide_m;
  return {.force_N = direction.slides_at_N, .lost_J = lost, .slips = true};
}

}  // namespace

double ShaftBristle::stored_J(const Tissue& tissue, double length_m) const {
  const double stiffness = tissue.shaft_stiffness_N_per_m2 * length_m;
  return stiffness > 0.0 ? force_N * force_N / (2.0 * stiffness) : 0.0;
}

// A longer shaft keeps the force, a shorter one the stretch: both lessen the energy.
void ShaftBristle::take_length(const Tissue& tissue, const ShaftMotion& motion,
                               NeedleEnergy& energy) {
  const double before = stored_J(tissue, motion.length_before_m);
  if (motion.length_m < motion.length_before_m) {
    force_N *= motion.length_m / motion.length_before_m;
  }
  energy.friction_J += before - stored_J(tissue, motion.length_m);
}

double ShaftBristle::advance(const Tissue& tissue, const ShaftMotion& motion,
                             NeedleEnergy& energy) {
  take_length(tissue, motion, energy);
  const double length = motion.length_m;
  const double stiffness = tissue.shaft_stiffness_N_per_m2 * length;
  if (!(stiffness > 0.0)) {
    *this = {};
    return 0.0;
  }
  slips_in = slips_in && motion.v_m_per_s >= kNeedleRest_m_per_s;
  slips_out = slips_out && motion.v_m_per_s <= -kNeedleRest_m_per_s;
  const Direction in{
      .breaks_at_N = length * (slips_in ? tissue.in.dynamic_N_per_m : tissue.in.static_N_per_m),
      .slides_at_N = length * tissue.in.dynamic_N_per_m};
  const Direction out{
      .breaks_at_N = length * (slips_out ? tissue.out.dynamic_N_per_m : tissue.out.static_N_per_m),
      .slides_at_N = length * tissue.out.dynamic_N_per_m};
  const bool goes_in = motion.travel_m > 0.0 || (motion.travel_m == 0.0 && force_N > 0.0);
  const double sign = goes_in ? 1.0 : -1.0;
  const Step step = stretch(sign * force_N, sign * motion.travel_m, stiffness, goes_in ? in : out);
  force_N = sign * step.force_N;
  slips_in = goes_in ? step.slips || slips_in : slips_in;
  slips_out = goes_in ? slips_out : step.slips || slips_out;
  energy.friction_J += step.lost_J;
  const double viscous =
      motion.v_m_per_s > 0.0 ? tissue.in.viscous_Ns_per_m2 : tissue.out.viscous_Ns_per_m2;
  const double viscous_N = viscous * length * motion.v_m_per_s;
  energy.friction_J += viscous_N * motion.travel_m;
  return force_N + viscous_N;
}

}  // namespace tactus::rendering
