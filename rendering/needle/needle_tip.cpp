#include "rendering/needle/needle_tip.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {

void NeedleTip::let_go(const Needle& needle, NeedleEnergy& energy) {
  energy.freed_J += stored_J(needle);
  force_N = 0.0;
}

void NeedleTip::press(const Needle& needle, double travel_m, double level_N, NeedleEnergy& energy) {
  const double stiffness = needle.tip_stiffness_N_per_m;
  const double before_J = stored_J(needle);
  const double wanted_N = std::max(force_N + stiffness * travel_m, 0.0);
  const double first_N = std::min(force_N, level_N);
  force_N = std::min(wanted_N, level_N);
  // The level falls along the way and is taken as its last value; the rest of the store is lost.
  const double work_J = 0.5 * (first_N + force_N) * travel_m;
  energy.friction_J += std::max(work_J + before_J - stored_J(needle), 0.0);
}

void NeedleTip::cut(const Tissue& tissue, const Needle& needle, const TipPlace& place,
                    double tick_s, double& front_m, NeedleEnergy& energy) {
  const double stiffness = needle.tip_stiffness_N_per_m;
  const double fracture_N = fracture_force_N(tissue, needle);
  const double spread_N = std::max(tissue.cutting_force_N - fracture_N, 0.0);
  // The spring reaches back no farther than there is tissue.
  const double room_m = std::max(place.depth_m - place.begin_m, 0.0);
  const double wanted_m = std::max(force_N / stiffness + place.travel_m, 0.0);
  const double longest_m = std::min(wanted_m, room_m);
  if (wanted_m > longest_m) {
    energy.freed_J += 0.5 * stiffness * (wanted_m * wanted_m - longest_m * longest_m);
  }
  double end_m = place.depth_m - longest_m;
  if (end_m < front_m) {
    const double reached_m =
        std::clamp(place.depth_m - spread_N / stiffness, end_m, std::max(front_m, end_m));
    energy.friction_J += spread_N * (reached_m - end_m);
    end_m = reached_m;
  }
  if (end_m >= front_m) {
    const double reached_m = place.depth_m - tissue.cutting_force_N / stiffness;
    if (reached_m > end_m) {
      const double cut_m = reached_m - end_m;
      energy.friction_J += spread_N * cut_m;
      energy.fracture_J += fracture_N * cut_m;
      energy.crack_m2 += needle.width_m * cut_m;
      end_m = reached_m;
      front_m = reached_m;
    }
  }
  force_N = stiffness * std::max(place.depth_m - end_m, 0.0);
  if (std::abs(place.v_m_per_s) < kNeedleRest_m_per_s) {
    relax(tissue, needle, place, tick_s, front_m, energy);
  }
}

// The tissue creeps towards the tip. In fresh tissue a creep that is driven by more than the
// fracture takes lengthens the crack.
void NeedleTip::relax(const Tissue& tissue, const Needle& needle, const TipPlace& place,
                      double tick_s, double& front_m, NeedleEnergy& energy) {
  const double stiffness = needle.tip_stiffness_N_per_m;
  const double end_m = place.depth_m - force_N / stiffness;
  const bool is_at_front = end_m >= front_m;
  const double floor_N = is_at_front ? fracture_force_N(tissue, needle) : 0.0;
  if (force_N <= floor_N) {
    return;
  }
  const double share = tick_s / (tissue.relaxation_s + tick_s);
  double creep_m = share * (force_N - floor_N) / stiffness;
  if (!is_at_front) {
    creep_m = std::min(creep_m, front_m - end_m);
  }
  const double before_J = stored_J(needle);
  force_N = std::max(force_N - stiffness * creep_m, 0.0);
  double paid_J = 0.0;
  if (is_at_front) {
    front_m = end_m + creep_m;
    paid_J = fracture_force_N(tissue, needle) * creep_m;
    energy.fracture_J += paid_J;
    energy.crack_m2 += needle.width_m * creep_m;
  }
  energy.freed_J += before_J - stored_J(needle) - paid_J;
}

}  // namespace tactus::rendering
