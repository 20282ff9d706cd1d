#include "rendering/needle/needle_touch.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {
namespace {

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
