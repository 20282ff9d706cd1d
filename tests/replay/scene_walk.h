// A hand that wanders about the objects of a scene, on a device that sometimes fails, worked by an
// operator who mostly wants to be active: what a recording is made of. The same seed gives the same
// inputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "firmware/control/controller.h"

namespace tactus::testing {

struct TickInput {
  drivers::JointSample sample;
  firmware::Request request = firmware::Request::none;
  firmware::LoopReport loop;
  firmware::ParameterChange change;  // may be refused
};

// Three prismatic axes that reach every object.
firmware::ControllerConfig walking_config();

void give(firmware::Controller& controller, const TickInput& input);

class SceneWalk {
 public:
  SceneWalk(std::span<const rendering::Object> objects, std::uint64_t seed)
      : objects_(objects), random_(seed) {}

  // Makes the walk change contact methods and friction models as well.
  void also_set_methods() { sets_methods_ = true; }

  // Returns the input of the next tick for a controller that is in `mode` now.
  TickInput next(firmware::Mode mode);

 private:
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  bool chance(double share) { return std::uniform_real_distribution<double>()(random_) < share; }
  Vec3 noise() { return {unit(), unit(), unit()}; }
  void choose_target();
  firmware::ParameterChange change();
  firmware::Request wish(firmware::Mode mode);

  std::span<const rendering::Object> objects_;
  std::mt19937_64 random_;
  Vec3 tool_{0.0, 0.15, 0.15};
  Vec3 target_{0.0, 0.15, 0.15};
  std::size_t object_ = 0;  // that it is about
  double speed_ = 1e-3;
  int ticks_left_ = 0;
  bool sets_methods_ = false;
};

}  // namespace tactus::testing
