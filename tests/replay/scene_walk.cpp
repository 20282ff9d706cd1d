#include "tests/replay/scene_walk.h"

#include <algorithm>
#include <cmath>

#include "firmware/control/parameter_choices.h"

namespace tactus::testing {

namespace {

constexpr double kFar_m = 0.01;

}  // namespace

using firmware::Mode;
using firmware::ParameterPlace;
using firmware::Request;

firmware::ControllerConfig walking_config() {
  firmware::ControllerConfig config = firmware::cartesian_config();
  for (firmware::JointLimits& joint : config.joints) {
    joint.lower = -1.0;
    joint.upper = 1.0;
  }
  config.velocity_cutoff_hz = 100.0;
  config.friction[0] = {.model = {.kind = rendering::FrictionKind::lugre,
                                  .coulomb = 0.2,
                                  .static_level = 0.3,
                                  .viscous_s_per_m = 0.5,
                                  .stiffness_N_per_m = 2000.0},
                        .compensated_share = 0.5,
                        .turn_length = 1e-5};
  return config;
}

void give(firmware::Controller& controller, const TickInput& input) {
  if (input.change.place.parameter != firmware::Parameter::none) {
    static_cast<void>(controller.set_parameter(input.change));
  }
  controller.note_loop(input.loop);
  controller.tick(input.sample, input.request);
}

TickInput SceneWalk::next(Mode mode) {
  if (ticks_left_-- <= 0) {
    choose_target();
  }
  const Vec3 before = tool_;
  const Vec3 to_target = target_ - tool_;
  const double distance = to_target.norm();
  if (distance > 0.0) {
    tool_ += std::min(1.0, speed_ / distance) * to_target;
  }
  const Vec3 seen = tool_ + 0.05 * speed_ * noise();
  TickInput input;
  for (std::size_t joint = 0; joint < firmware::kJointCount; ++joint) {
    const auto axis = static_cast<Eigen::Index>(joint);
    input.sample.position[joint] = seen[axis];
    input.sample.velocity[joint] = (tool_ - before)[axis] / 1e-3;
  }
  if (chance(0.002)) {
    input.sample.status = 1U << (random_() % 7);
  }
  if (chance(0.005)) {
    input.sample.age_us = 10'000;
  }
  if (chance(0.005)) {
    input.loop = {.status = firmware::kLoopLate,
                  .missed_ticks = static_cast<std::uint32_t>(random_() % 2)};
  }
  if (chance(0.01)) {
    input.change = change();
  }
  input.request = wish(mode);
  return input;
}

// Chooses a place near a surface, on either side of it, mostly of the same object as before. The
// speed is a micrometre to a millimetre a tick, and a millimetre from far away.
void SceneWalk::choose_target() {
  if (chance(0.1)) {
    object_ = static_cast<std::size_t>(random_() % objects_.size());
  }
  const rendering::Object& object = objects_[object_];
  if (object.surface == rendering::SurfaceKind::mesh) {
    const auto& vertices = object.mesh.vertices;
    const Vec3 vertex =
        rendering::to_vec3(vertices[static_cast<std::size_t>(random_() % vertices.size())]);
    target_ = vertex + 0.005 * noise();
  } else {
    const rendering::Bounds box = rendering::bounds_of(object);
    const Vec3 middle = (0.5 * (box.lower_W + box.upper_W)).cwiseMax(-0.2).cwiseMin(0.2);
    const Vec3 half = (0.5 * (box.upper_W - box.lower_W)).cwiseMin(0.1);
    target_ = middle + 1.1 * half.cwiseProduct(noise());
  }
  const int octave = static_cast<int>(random_() % 11);
  speed_ = std::ldexp(1e-6, (target_ - tool_).norm() > kFar_m ? 10 : octave);
  ticks_left_ = 1 + static_cast<int>(60.0 * (1.0 + unit()));
}

// Returns a change of any parameter, mostly within its range.
firmware::ParameterChange SceneWalk::change() {
  // Those with names for values are the last ones.
  const auto& all = firmware::kParameterTexts;
  const auto numbers = static_cast<std::size_t>(
      std::ranges::count_if(all, [](const auto& one) { return !has_choices(one.parameter); }));
  const auto& text =
      all[static_cast<std::size_t>(random_() % (sets_methods_ ? all.size() : numbers))];
  const double share = std::abs(unit());
  const ParameterPlace place{.parameter = text.parameter,
                             .object = static_cast<std::uint32_t>(random_() % objects_.size())};
  if (has_choices(text.parameter)) {
    return {.place = place, .value = std::floor(share * choice_count(text.parameter))};
  }
  const double most = text.unit == "1" ? 1.0 : text.unit == "N/m" ? 2000.0 : 10.0;
  return {.place = place, .value = most * share};
}

Request SceneWalk::wish(Mode mode) {
  if (chance(0.002)) {
    return static_cast<Request>(random_() % firmware::kRequestNames.size());
  }
  switch (mode) {
    case Mode::init:
      return Request::home;
    case Mode::ready:
      return Request::enable;
    case Mode::fault:
      return chance(0.1) ? Request::reset : Request::none;
    default:
      return Request::none;
  }
}

}  // namespace tactus::testing
