// The part of NeedleTouch that meets layers and pierces them.
#include <algorithm>
#include <cmath>

#include "rendering/needle/needle_touch.h"

namespace tactus::rendering {
namespace {

// The recoil of a layer that has no surface to give way, m.
constexpr double kLeastRecoil_m = 1e-12;

}  // namespace

// Without a puncture the tip meets a surface where it crosses it, or, if it has come in otherwise,
// where it is: so no surface begins with a force.
bool NeedleTouch::meet_next(const SceneObjects& scene, const Vec3& tip_W, Recoil& recoil,
                            Order& order) {
  std::size_t outermost = count_;
  double deepest_m = -1.0;
  Vec3 entry_O = Vec3::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    const NeedleLayer& layer = layers_[i];
    const bool is_tried = ((recoil.tried >> i) & 1U) != 0;
    if (is_tried || layer.is_met() || layer.is_left_out ||
        !(layer.is_inside || crossings_[i].enters)) {
      continue;
    }
    const NeedlePose now = pose_in(scene, i, tip_W);
    Vec3 at_O = now.tip_O;
    if (crossings_[i].enters) {
      at_O = layer.last.tip_O + crossings_[i].entry * (now.tip_O - layer.last.tip_O);
    } else if (recoil.length_m > 0.0) {
      const Vec3 from_O = now.tip_O - recoil.length_m * now.axis_O;
      const SurfaceCrossing behind = crossing_of(scene[objects_[i]], from_O, now.tip_O);
      at_O = behind.enters ? Vec3{from_O + behind.entry * (now.tip_O - from_O)} : at_O;
    }
    const double depth_m = (now.tip_O - at_O).dot(now.axis_O);
    if (depth_m > deepest_m) {
      outermost = i;
      deepest_m = depth_m;
      entry_O = at_O;
    }
  }
  if (outermost == count_) {
    return false;
  }
  const NeedlePose now = pose_in(scene, outermost, tip_W);
  NeedleLayer& layer = layers_[outermost];
  layer.meet(scene_.needle, now, entry_O);
  recoil.tried |= 1U << outermost;
  order = this->order();
  return true;
}

// The energy of a surface that gives way pays for the crack as far as the tip, for surfaces
// beneath it that the tip has met, and for the springs of tip and shaft. The rest goes to the
// account, never to the hand: no spring is loaded to more than the force before.
bool NeedleTouch::puncture(const SceneObjects& scene, const Vec3& tip_W, Order& order) {
  Recoil recoil;
  while (order.pressed < order.count || meet_next(scene, tip_W, recoil, order)) {
    if (order.pressed == order.count) {
      continue;
    }
    NeedleLayer& layer = layers_[order.layers[order.pressed]];
    const Tissue& tissue = tissue_of(order.layers[order.pressed]);
    const double gives_way_m = puncture_depth_m(tissue);
    if (recoil.length_m > 0.0) {
      const double needed_J = membrane_energy_J(tissue, std::min(layer.depth_m, gives_way_m));
      if (needed_J > recoil.available_J ||
          membrane_N(order.layers[order.pressed]) > recoil.most_N) {
        // The recoil ends on this surface.
        layer.channel.entry_O += layer.depth_m * layer.channel.direction_O;
        layer.depth_m = 0.0;
        break;
      }
      recoil.available_J -= needed_J;
    }
    if (layer.depth_m < gives_way_m) {
      break;
    }
    if (!(recoil.length_m > 0.0)) {
      recoil.available_J = tip_.stored_J(scene_.needle);
      recoil.most_N = tip_.force_N + tissue.puncture_force_N;
      recoil.length_m = std::max(layer.depth_m, kLeastRecoil_m);
      tip_.force_N = 0.0;
    }
    recoil.available_J += membrane_energy_J(tissue, gives_way_m);
    pierce(order, recoil);
  }
  energy_.freed_J += recoil.available_J;
  return recoil.length_m > 0.0;
}

// Takes the energy of a crack from the recoil, as far as it goes.
void NeedleTouch::crack(const Tissue& tissue, double length_m, Recoil& recoil) {
  const double wanted_J = fracture_force_N(tissue, scene_.needle) * std::max(length_m, 0.0);
  const double paid_J = std::min(wanted_J, recoil.available_J);
  if (paid_J > 0.0) {
    recoil.available_J -= paid_J;
    energy_.fracture_J += paid_J;
    energy_.crack_m2 += paid_J / tissue.toughness_J_per_m2;
  }
}

void NeedleTouch::pierce(Order& order, Recoil& recoil) {
  const std::size_t place = order.pressed;
  const std::size_t number = order.layers[place];
  NeedleLayer& layer = layers_[number];
  const Tissue& tissue = tissue_of(number);
  // The layer around it is cut as far as this one's surface.
  if (place > 0) {
    NeedleLayer& outer = layers_[order.layers[place - 1]];
    const double boundary_m = outer.depth_m - layer.depth_m;
    crack(tissue_of(order.layers[place - 1]), boundary_m - outer.channel.front_m, recoil);
    outer.channel.front_m = std::max(outer.channel.front_m, boundary_m);
  }
  layer.phase = LayerPhase::pierced;
  layer.channel.exists = true;
  find_pressed(order);
  const Stretch stretch = stretch_of(order, place);
  double end_m = layer.depth_m - stretch.near_m;
  if (place + 1 == order.count) {
    // The tip is in this layer, and cuts it.
    const double stiffness = scene_.needle.tip_stiffness_N_per_m;
    const double room_m = place == 0 ? stretch.far_m : layer.depth_m + kWorldBound_m;
    tip_.force_N = std::min({tissue.cutting_force_N, recoil.most_N, stiffness * room_m,
                             std::sqrt(2.0 * stiffness * recoil.available_J)});
    recoil.available_J -= std::min(tip_.stored_J(scene_.needle), recoil.available_J);
    recoil.most_N -= tip_.force_N;
    end_m -= tip_.force_N / stiffness;
  }
  layer.channel.front_m = end_m;
  crack(tissue, end_m - layer.begin_m(tissue), recoil);
  energy_.freed_J += layer.sideways_J(tissue);
  layer.length_m = 0.0;
  layer.sideways_O = Vec3::Zero();
  load_shaft(tissue, stretch.far_m - stretch.near_m, layer, recoil);
}

// The shaft has slid in the recoil.
void NeedleTouch::load_shaft(const Tissue& tissue, double length_m, NeedleLayer& layer,
                             Recoil& recoil) {
  const double force_N = std::min(tissue.in.dynamic_N_per_m * length_m, recoil.most_N);
  ShaftBristle loaded{.force_N = force_N, .slips_in = true, .slips_out = false};
  const double needed_J = loaded.stored_J(tissue, length_m);
  if (length_m > 0.0 && needed_J <= recoil.available_J) {
    recoil.available_J -= needed_J;
    recoil.most_N -= force_N;
    layer.shaft = loaded;
    layer.length_m = length_m;
  }
}

}  // namespace tactus::rendering
