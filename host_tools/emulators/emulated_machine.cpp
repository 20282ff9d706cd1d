#include "host_tools/emulators/emulated_machine.h"

#include <fmt/format.h>

#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

double seconds_of(hal::TimeNs duration_ns) {
  return 1e-9 * static_cast<double>(duration_ns);
}

// Returns the step if the plant can bear it; throws InputError otherwise.
hal::TimeNs checked_step(hal::TimeNs step_ns) {
  if (step_ns <= 0 || step_ns > kLongestMachineStep_ns) {
    throw InputError(fmt::format("a step of {} ns: the plant needs steps of at most {} ns", step_ns,
                                 kLongestMachineStep_ns));
  }
  return step_ns;
}

// Returns false for parameters that are all zero, which mean that there is no hand.
bool holds(const HandParameters& hand) {
  return hand.stiffness_N_per_m > 0.0 || hand.damping_Ns_per_m > 0.0;
}

}  // namespace

EmulatedMachine::EmulatedMachine(const EmulatedMachineConfig& config, hal::TimeNs start_ns)
    : plant_parameters_(config.device.device.plant),
      origin_B_(config.origin_B),
      step_ns_(checked_step(config.step_ns)),
      start_ns_(start_ns),
      next_step_ns_(start_ns),
      let_go_s_(config.let_go_s),
      hand_(config.hand, config.path, config.seed, seconds_of(config.step_ns)),
      plant_(plant_parameters_) {
  plant_.place(holds(config.hand) ? Vec3(hand_.wish_W() + origin_B_) : config.device.centre_B);
  axes_.reserve(joints());
}

void EmulatedMachine::connect(EmulatedAxis axis) {
  if (axes_.size() == joints()) {
    throw InputError(fmt::format("the mechanism has {} joints, and each has its axis", joints()));
  }
  if (!drivers::is_valid(axis.transmission)) {
    throw InputError(fmt::format(
        "joint {}: a ratio must be positive, a direction 1 or -1, an offset finite", axes_.size()));
  }
  axes_.push_back(std::move(axis));
}

void EmulatedMachine::set_fault(std::size_t joint, EmulatorFault fault) {
  axes_.at(joint).set_fault(fault);
  truth_.fault[joint] = fault;
}

void EmulatedMachine::run(hal::TimeNs now_ns) {
  while (next_step_ns_ <= now_ns) {
    step();
  }
}

void EmulatedMachine::skip_to(hal::TimeNs now_ns) {
  if (next_step_ns_ < now_ns) {
    next_step_ns_ += (now_ns - next_step_ns_ + step_ns_ - 1) / step_ns_ * step_ns_;
  }
}

void EmulatedMachine::add_listener(std::function<void(hal::TimeNs)> run, int descriptor) {
  listeners_.push_back(std::move(run));
  descriptors_.push_back(descriptor);
}

void EmulatedMachine::step() {
  make_step(true);
}

void EmulatedMachine::coast() {
  make_step(false);
}

void EmulatedMachine::make_step(bool listens) {
  turn_shafts();
  for (const auto& device : devices_) {
    device(next_step_ns_);
  }
  for (std::size_t i = 0; listens && i < listeners_.size(); ++i) {
    listeners_[i](next_step_ns_);
  }
  move(take_torques());
  next_step_ns_ += step_ns_;
}

void EmulatedMachine::turn_shafts() {
  truth_.time_ns = next_step_ns_;
  truth_.handle_p_B = plant_.p_B();
  truth_.handle_v_B = plant_.v_B();
  for (std::size_t i = 0; i < joints(); ++i) {
    const MechanismPose& pose = plant_.pose();
    truth_.joint_position[i] = joint_position(plant_parameters_.mechanism, i, pose.coordinate[i]);
    truth_.joint_velocity[i] = pose.rows[i].dot(plant_.v_B());
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const drivers::Transmission& transmission = axes_[i].transmission;
    axes_[i].shaft->position_rad =
        drivers::encoder_position_rad(transmission, truth_.joint_position[i]);
    axes_[i].shaft->velocity_rad_per_s =
        transmission.encoder_direction * transmission.encoder_ratio * truth_.joint_velocity[i];
  }
}

JointEfforts EmulatedMachine::take_torques() {
  JointEfforts effort{};
  truth_.motor_force_B.setZero();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    truth_.shaft_torque_Nm[i] = axes_[i].shaft->torque_Nm;
    effort[i] = drivers::joint_effort(axes_[i].transmission, axes_[i].shaft->torque_Nm);
    truth_.motor_force_B += effort[i] * plant_.pose().rows[i];
  }
  return effort;
}

void EmulatedMachine::move(const JointEfforts& effort) {
  const double dt_s = seconds_of(step_ns_);
  // A hand that has let go is one with all parameters 0: the wish goes on without it.
  const bool is_held = seconds_of(next_step_ns_ - start_ns_) < let_go_s_;
  const HandParameters hand = is_held ? hand_.parameters() : HandParameters{};
  const Vec3 wish_B = hand_.wish_W() + origin_B_;
  const Vec3 next_wish_B = hand_.next_wish_W() + origin_B_;
  const Grip grip{.mass_kg = hand.mass_kg,
                  .stiffness_N_per_m = hand.stiffness_N_per_m,
                  .damping_Ns_per_m = hand.damping_Ns_per_m,
                  .wish_p_B = 0.5 * (wish_B + next_wish_B),
                  .wish_v_B = (next_wish_B - wish_B) / dt_s};
  const Vec3 before_B = plant_.p_B();
  plant_.step(effort, grip, dt_s);
  const Vec3 mean_v_B = (plant_.p_B() - before_B) / dt_s;
  truth_.hand_force_B = grip.stiffness_N_per_m * (grip.wish_p_B - 0.5 * (before_B + plant_.p_B())) +
                        grip.damping_Ns_per_m * (grip.wish_v_B - mean_v_B);
  hand_.advance();
}

}  // namespace tactus::host
