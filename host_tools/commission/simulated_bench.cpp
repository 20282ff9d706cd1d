#include "host_tools/commission/simulated_bench.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus::host {
namespace {

// The simulated person goes this share of the way from the middle to each stop, there and back in
// kLeg_s, along three axes in both directions, and then rests in the middle for kRest_s.
constexpr double kReach = 0.98;
constexpr double kLeg_s = 0.8;
constexpr int kLegs = 6;
constexpr double kRest_s = 0.5;

}  // namespace

SimulatedBench::SimulatedBench(const DeviceParameters& parameters, double rate_hz,
                               const Vec3& middle_B, const WiringMistake& mistake)
    : parameters_(parameters),
      step_s_(1.0 / rate_hz),
      middle_B_(on_manifold(parameters.plant.mechanism, middle_B)),
      mistake_(mistake),
      device_(parameters, step_s_, middle_B_) {}

// The mistakes of wiring are between device and loop: factors on positions and torques, and motors
// that are swapped.
void SimulatedBench::read(drivers::JointSample& sample) {
  device_.read(sample);
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    sample.position[i] *= mistake_.position_scale[i];
    sample.velocity[i] *= mistake_.position_scale[i];
    if (mistake_.reports_torque) {
      sample.effort[i] = mistake_.torque_scale[i] * written_.effort[i];
      sample.effort_known |= 1U << i;
      sample.effort_is_new |= 1U << i;
    }
  }
}

void SimulatedBench::write(const drivers::JointCommand& command) {
  drivers::JointCommand wired = command;
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    wired.effort[mistake_.motor_of[i]] = mistake_.torque_scale[i] * command.effort[i];
  }
  written_ = command;
  (void)device_.write(wired);
}

void SimulatedBench::wait() {
  const double time_s = step_s_ * static_cast<double>(ticks_);
  const bool holds = task_ != HandTask::let_go || mistake_.holds_the_handle;
  device_.advance(holds ? kFirmHand : HandParameters{}, wish_at(time_s), wish_at(time_s + step_s_));
  moved_m_ = std::max(moved_m_, (device_.plant().p_B() - middle_B_).norm());
  ++ticks_;
}

void SimulatedBench::ask(HandTask task) {
  task_ = task;
  ticks_ = 0;
  moved_m_ = 0.0;
}

// Only moving the handle takes time; the simulated person holds and lets go at once.
double SimulatedBench::task_s() const {
  return task_ == HandTask::move_everywhere ? kLegs * kLeg_s + kRest_s : 0.0;
}

bool SimulatedBench::is_at_work(HandTask task) {
  return task == task_ && step_s_ * static_cast<double>(ticks_) < task_s();
}

// Returns the wished position of a hand that goes along one axis to a stop and back, one axis after
// the other, by a half cosine each way.
Vec3 SimulatedBench::wish_at(double time_s) const {
  const int leg = static_cast<int>(time_s / kLeg_s);
  if (task_ != HandTask::move_everywhere || leg >= kLegs) {
    return middle_B_;
  }
  const double phase = time_s / kLeg_s - leg;
  const double share = 0.5 * kReach * (1.0 - std::cos(2.0 * std::numbers::pi * phase));
  const int axis = leg / 2;
  const Vec3& stop_B =
      leg % 2 == 0 ? parameters_.plant.stop_lower_B : parameters_.plant.stop_upper_B;
  Vec3 wish_B = middle_B_;
  wish_B[axis] += share * (stop_B[axis] - middle_B_[axis]);
  return on_manifold(parameters_.plant.mechanism, wish_B);
}

}  // namespace tactus::host
