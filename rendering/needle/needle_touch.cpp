#include "rendering/needle/needle_touch.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {
namespace {

// Returns the crossings of an object's surface by a motion; frame O.
SurfaceCrossing crossing_of(const Object& object, const Vec3& from_O, const Vec3& to_O) {
  return object.surface == SurfaceKind::primitive ? crossing_of(object.primitive, from_O, to_O)
                                                  : crossing_of(object.mesh, from_O, to_O);
}

// Returns true if a point is within the box of the object; frame O.
bool is_in_box(const Object& object, const Vec3& p_O) {
  const Bounds box = bounds_of(object);
  return (p_O.array() >= box.lower_W.array()).all() && (p_O.array() <= box.upper_W.array()).all();
}

// Returns true if the point is within the object: seen along the needle from outside the world.
bool is_within(const Object& object, const NeedlePose& needle_O) {
  if (object.surface == SurfaceKind::primitive) {
    return sample(object.primitive, needle_O.tip_O).distance_m < 0.0;
  }
  if (!is_in_box(object, needle_O.tip_O)) {
    return false;
  }
  const Bounds box = bounds_of(object);
  const double far = 1.0 + (box.upper_W - box.lower_W).norm();
  return crossing_of(object.mesh, needle_O.tip_O - far * needle_O.axis_O, needle_O.tip_O)
      .ends_inside;
}

// The recoil of a layer that has no surface to give way, m.
constexpr double kLeastRecoil_m = 1e-12;

}  // namespace

bool may_be_pierced(const Object& object) {
  return object.surface != SurfaceKind::implicit && !object.deforms && !is_body(object);
}

bool valid(const NeedleScene& needle, std::span<const Object> objects) {
  if (!valid(needle.needle) || needle.tissues.size() > kMaxTissues ||
      !std::ranges::all_of(needle.tissues,
                           [&](const Tissue& tissue) { return valid(tissue, needle.needle); })) {
    return false;
  }
  std::array<bool, kMaxTissues> taken{};
  for (const Object& object : objects) {
    if (object.tissue == kNoTissue) {
      continue;
    }
    if (object.tissue >= needle.tissues.size() || taken[object.tissue] || !may_be_pierced(object)) {
      return false;
    }
    taken[object.tissue] = true;
  }
  return true;
}

void NeedleTouch::start(const SceneObjects& scene, const NeedleScene& needle) {
  scene_ = needle;
  count_ = 0;
  energy_ = {};
  tip_ = {};
  layers_ = {};
  is_placed_ = false;
  if (!(needle.needle.length_m > 0.0)) {
    return;
  }
  for (std::uint32_t number = 0; number < scene.size(); ++number) {
    if (is_tissue(scene[number])) {
      tissues_[count_] = scene[number].tissue;
      objects_[count_++] = number;
    }
  }
}

const Tissue& NeedleTouch::tissue_of(std::size_t layer) const {
  return scene_.tissues[tissues_[layer]];
}

NeedlePose NeedleTouch::pose_in(const SceneObjects& scene, std::size_t layer,
                                const Vec3& tip_W) const {
  const Mover* const mover = scene.mover_of(objects_[layer]);
  return {.tip_O = point_in(mover, tip_W), .axis_O = direction_in(mover, scene_.needle.axis_W)};
}

void NeedleTouch::place(const SceneObjects& scene, const Vec3& tip_W) {
  tip_ = {};
  for (std::size_t i = 0; i < count_; ++i) {
    const NeedlePose pose = pose_in(scene, i, tip_W);
    layers_[i].place(pose, is_within(scene[objects_[i]], pose));
  }
  is_placed_ = true;
}

// A mesh that the motion does not cross has the tip where it was: outside of its box certainly out.
void NeedleTouch::follow(const SceneObjects& scene, const Vec3& tip_W) {
  for (std::size_t i = 0; i < count_; ++i) {
    NeedleLayer& layer = layers_[i];
    const Object& object = scene[objects_[i]];
    const NeedlePose now = pose_in(scene, i, tip_W);
    SurfaceCrossing& crossing = crossings_[i];
    crossing = crossing_of(object, layer.last.tip_O, now.tip_O);
    if (object.surface == SurfaceKind::mesh && !crossing.enters && !crossing.leaves) {
      crossing.ends_inside = layer.is_inside && is_in_box(object, now.tip_O);
    }
    layer.follow(now, crossing);
    if (layer.is_met() && !(layer.depth_m > 0.0)) {
      layer.let_go(tissue_of(i), energy_);
    }
  }
}

NeedleTouch::Order NeedleTouch::order() const {
  Order order;
  for (std::size_t i = 0; i < count_; ++i) {
    if (!layers_[i].is_met()) {
      continue;
    }
    std::size_t place = order.count++;
    for (; place > 0 && layers_[order.layers[place - 1]].depth_m < layers_[i].depth_m; --place) {
      order.layers[place] = order.layers[place - 1];
    }
    order.layers[place] = static_cast<std::uint8_t>(i);
  }
  find_pressed(order);
  return order;
}

void NeedleTouch::find_pressed(Order& order) const {
  order.pressed = 0;
  while (order.pressed < order.count &&
         layers_[order.layers[order.pressed]].phase == LayerPhase::pierced) {
    ++order.pressed;
  }
}

NeedleTouch::Stretch NeedleTouch::stretch_of(const Order& order, std::size_t place) const {
  const NeedleLayer& layer = layers_[order.layers[place]];
  Stretch stretch{.near_m = 0.0,
                  .far_m = layer.depth_m - layer.begin_m(tissue_of(order.layers[place]))};
  if (place + 1 < order.count) {
    const std::size_t inner = order.layers[place + 1];
    stretch.near_m = layers_[inner].depth_m - layers_[inner].begin_m(tissue_of(inner));
  }
  if (layer.is_left) {
    stretch.near_m = std::max(stretch.near_m, layer.depth_m - layer.exit_m);
  }
  stretch.near_m = std::clamp(stretch.near_m, 0.0, scene_.needle.length_m);
  stretch.far_m = std::clamp(stretch.far_m, stretch.near_m, scene_.needle.length_m);
  return stretch;
}

double NeedleTouch::membrane_N(std::size_t layer) const {
  const Tissue& tissue = tissue_of(layer);
  return membrane_force_N(tissue, std::min(layers_[layer].depth_m, puncture_depth_m(tissue)));
}

NeedleForce NeedleTouch::advance(const SceneObjects& scene, const ToolState& tool) {
  if (!is_placed_) {
    place(scene, tool.p_W);
  }
  follow(scene, tool.p_W);
  Order met = order();
  const bool has_punctured = puncture(scene, tool.p_W, met);
  NeedleForce force;
  for (std::size_t place = 0; place < met.count; ++place) {
    hold_shaft(scene, met, place, tool, force);
  }
  const double axial_N = move_tip(scene, met, tool, has_punctured);
  const Vec3 axial_W = -axial_N * scene_.needle.axis_W;
  force.force_W += axial_W;
  if (met.count > 0) {
    const std::size_t innermost = met.layers[std::min(met.pressed, met.count - 1)];
    force.object = objects_[innermost];
    force.depth_m = met.pressed < met.count ? layers_[innermost].depth_m : 0.0;
    force.driven_power += axial_W.dot(scene.velocity_W(force.object, tool.p_W));
    force.layers = static_cast<std::uint16_t>(met.count);
    const ShaftBristle& shaft = layers_[met.layers[met.pressed > 0 ? met.pressed - 1 : 0]].shaft;
    force.friction = met.pressed == 0                    ? FrictionState::free
                     : shaft.slips_in || shaft.slips_out ? FrictionState::slip
                                                         : FrictionState::stick;
  }
  for (std::size_t i = 0; i < count_; ++i) {
    layers_[i].last = pose_in(scene, i, tool.p_W);
    force.has_left_out = force.has_left_out || layers_[i].is_left_out;
  }
  return force;
}

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

// What a surface that gives way had stored pays for the crack as far as the tip, for surfaces
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

double NeedleTouch::move_tip(const SceneObjects& scene, const Order& order, const ToolState& tool,
                             bool has_punctured) {
  const Needle& needle = scene_.needle;
  if (order.pressed < order.count) {
    const std::size_t number = order.layers[order.pressed];
    const double membrane = membrane_N(number);
    // The tip leans on the tissue before the surface as it did when it cut; it cuts no more.
    double level_N = 0.0;
    if (order.pressed > 0) {
      const std::size_t outer = order.layers[order.pressed - 1];
      level_N = std::max(tissue_of(outer).cutting_force_N - membrane, 0.0);
    }
    tip_.press(needle, layers_[number].travel_m(pose_in(scene, number, tool.p_W)), level_N,
               energy_);
    return tip_.force_N + membrane;
  }
  std::size_t place = order.count;
  while (place > 0 && layers_[order.layers[place - 1]].is_left) {
    --place;
  }
  if (place == 0) {
    tip_.let_go(needle, energy_);
    return 0.0;
  }
  if (!has_punctured) {
    const std::size_t number = order.layers[place - 1];
    NeedleLayer& layer = layers_[number];
    const Tissue& tissue = tissue_of(number);
    const double begin_m = place == 1 ? layer.begin_m(tissue) : layer.depth_m - kWorldBound_m;
    tip_.cut(
        tissue, needle,
        {.depth_m = layer.depth_m,
         .begin_m = begin_m,
         .travel_m = layer.travel_m(pose_in(scene, number, tool.p_W)),
         .v_m_per_s = (tool.v_W - scene.velocity_W(objects_[number], tool.p_W)).dot(needle.axis_W)},
        scene.tick_s(), layer.channel.front_m, energy_);
  }
  return tip_.force_N;
}

void NeedleTouch::hold_shaft(const SceneObjects& scene, const Order& order, std::size_t place,
                             const ToolState& tool, NeedleForce& force) {
  const std::size_t number = order.layers[place];
  NeedleLayer& layer = layers_[number];
  if (place > order.pressed) {
    return;  // beneath a surface that is pressed in, it goes along
  }
  const Tissue& tissue = tissue_of(number);
  const NeedlePose now = pose_in(scene, number, tool.p_W);
  const Vec3 surface_v_W = scene.velocity_W(objects_[number], tool.p_W);
  Vec3 own_W = Vec3::Zero();
  if (place == order.pressed) {
    const Vec3 sideways_O = layer.hold_sideways(tissue, now, 0.0, layer.depth_m, energy_);
    own_W = direction_from(scene.mover_of(objects_[number]), sideways_O);
  } else {
    const Stretch stretch = stretch_of(order, place);
    const double axial_N =
        layer.shaft.advance(tissue,
                            {.travel_m = layer.travel_m(now),
                             .v_m_per_s = (tool.v_W - surface_v_W).dot(scene_.needle.axis_W),
                             .length_before_m = layer.length_m,
                             .length_m = stretch.far_m - stretch.near_m},
                            energy_);
    const Vec3 friction_W = -axial_N * scene_.needle.axis_W;
    const Vec3 sideways_O =
        layer.hold_sideways(tissue, now, stretch.near_m, stretch.far_m, energy_);
    force.friction_W += friction_W;
    own_W = friction_W + direction_from(scene.mover_of(objects_[number]), sideways_O);
  }
  force.force_W += own_W;
  force.driven_power += own_W.dot(surface_v_W);
}

double NeedleTouch::stored_J() const {
  const Order met = order();
  double sum = tip_.stored_J(scene_.needle);
  for (std::size_t place = 0; place < met.count; ++place) {
    const std::size_t number = met.layers[place];
    const NeedleLayer& layer = layers_[number];
    sum += layer.shaft.stored_J(tissue_of(number), layer.length_m) +
           layer.sideways_J(tissue_of(number));
    if (place == met.pressed) {
      const Tissue& tissue = tissue_of(number);
      sum += membrane_energy_J(tissue, std::min(layer.depth_m, puncture_depth_m(tissue)));
    }
  }
  return sum;
}

bool NeedleTouch::touches(std::uint32_t object) const {
  for (std::size_t i = 0; i < count_; ++i) {
    if (objects_[i] == object) {
      return is_placed_ && layers_[i].is_met();
    }
  }
  return false;
}

}  // namespace tactus::rendering
