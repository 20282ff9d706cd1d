#include "firmware/bare_metal/held_handle.h"

#include <algorithm>

#include "firmware/bare_metal/stroke.h"

namespace tactus::firmware {
namespace {

// The hand of host_tools/simulation that holds a pen, and the handle with it.
constexpr double kHeldMass_kg = 0.15;
constexpr double kHandStiffness_N_per_m = 300.0;
constexpr double kHandDamping_Ns_per_m = 5.0;
// The viscous friction of the device, felt at the handle.
constexpr double kDeviceDamping_Ns_per_m = 0.5;
// A joint with which the handle does not move still has some inertia: that of the mass at this
// distance, m, or this share of the mass.
constexpr double kLeastLever = 0.02;

constexpr int kStepsPerTick = 4;
constexpr std::uint64_t kTicksToStroke = 1000;

}  // namespace

void HeldHandle::start(const DeviceConfig& device) {
  *this = HeldHandle{};
  const ControllerConfig& config = device.controller;
  joint_count_ = firmware::joint_count(config.mechanism);
  mechanism_ = Mechanism(config.mechanism);
  tick_s_ = 1.0 / config.rate_hz;
  origin_D_ = config.workspace_origin_D;
  gravity_D_ = config.gravity_D;
  for (std::size_t joint = 0; joint < joint_count_; ++joint) {
    position_[static_cast<Eigen::Index>(joint)] = device.joints[joint].reference.position;
  }
  start_D_ = mechanism_.forward(position_, origin_D_).p_D;
  p_D_ = start_D_;
}

Vec3 HeldHandle::wish_D(std::uint64_t tick) const {
  Vec3 stroke_D = origin_D_ + stroke_W(tick);
  if (tick >= kTicksToStroke) {
    return stroke_D;
  }
  const double share = static_cast<double>(tick) / static_cast<double>(kTicksToStroke);
  return start_D_ + (stroke_D - start_D_) * (share * share * (3.0 - 2.0 * share));
}

void HeldHandle::step(const Wish& wish, double step_s) {
  const Pose pose = mechanism_.forward(position_, p_D_);
  p_D_ = pose.p_D;
  const Vec3 v_D = tool_velocity(pose, velocity_);
  const Vec3 force_D = kHandStiffness_N_per_m * (wish.p_D - p_D_) +
                       kHandDamping_Ns_per_m * (wish.v_D - v_D) - kDeviceDamping_Ns_per_m * v_D;
  const Vec3 effort = effort_ + joint_effort(pose, force_D) -
                      mechanism_.gravity_effort(position_, pose, gravity_D_);
  for (std::size_t joint = 0; joint < joint_count_; ++joint) {
    const auto i = static_cast<Eigen::Index>(joint);
    const double lever = std::max(pose.jacobian_D.col(i).norm(), kLeastLever);
    velocity_[i] += effort[i] / (kHeldMass_kg * lever * lever) * step_s;
    position_[i] += velocity_[i] * step_s;
  }
}

void HeldHandle::read(drivers::JointSample& sample) {
  const Vec3 from_D = wish_D(tick_);
  const Vec3 to_D = wish_D(tick_ + 1);
  const Vec3 v_D = (to_D - from_D) / tick_s_;
  const double step_s = tick_s_ / kStepsPerTick;
  for (int i = 0; i < kStepsPerTick; ++i) {
    step({.p_D = from_D + v_D * (i * step_s), .v_D = v_D}, step_s);
  }
  ++tick_;
  sample = drivers::JointSample{};
  for (std::size_t joint = 0; joint < joint_count_; ++joint) {
    sample.position[joint] = position_[static_cast<Eigen::Index>(joint)];
    sample.velocity[joint] = velocity_[static_cast<Eigen::Index>(joint)];
  }
}

std::uint32_t HeldHandle::write(const drivers::JointCommand& command) {
  for (std::size_t joint = 0; joint < joint_count_; ++joint) {
    effort_[static_cast<Eigen::Index>(joint)] = command.enable ? command.effort[joint] : 0.0;
  }
  return drivers::kDeviceOk;
}

}  // namespace tactus::firmware
