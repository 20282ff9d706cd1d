#include "drivers/composition/composed_device.h"

#include <algorithm>
#include <span>
#include <utility>

namespace tactus::drivers {

namespace {

constexpr std::uint32_t kLatchedStatus = kDeviceEncoderFault | kDeviceDriveFault |
                                         kDeviceEmergencyStop | kDeviceLost | kDeviceTooHot |
                                         kDeviceReferenceLost;
// After these faults an encoder may count from another zero. A device that could not be reached may
// have restarted or been moved in the meantime.
constexpr std::uint32_t kLosesReference = kDeviceEncoderFault | kDeviceLost | kDeviceReferenceLost;

std::uint32_t age_us(hal::TimeNs now_ns, hal::TimeNs then_ns) {
  constexpr hal::TimeNs kMost_us = 0xFFFF'FFFF;
  return static_cast<std::uint32_t>(
      std::clamp<hal::TimeNs>((now_ns - then_ns) / 1000, 0, kMost_us));
}

}  // namespace

bool ComposedDevice::add_board(const BoardRef& board) {
  if (board_count_ == boards_.size() || !board || board.axis_count() > kMaxJoints) {
    return false;
  }
  boards_[board_count_].ref = board;
  ++board_count_;
  return true;
}

bool ComposedDevice::add_joint(const JointWiring& wiring) {
  if (joint_count_ == joints_.size() || !exists(wiring.encoder) || !exists(wiring.motor) ||
      !is_valid(wiring.transmission) || !check(wiring.reference) ||
      !lies_between(wiring.max_torque_Nm, 0.0, 1e6)) {
    return false;
  }
  joints_[joint_count_] = {wiring, Homing(wiring.reference, wiring.transmission)};
  ++joint_count_;
  return true;
}

bool ComposedDevice::exists(const AxisAddress& address) const {
  return address.board < board_count_ && address.axis < boards_[address.board].ref.axis_count();
}

const AxisSample& ComposedDevice::sample_at(const AxisAddress& address) const {
  return boards_[address.board].samples[address.axis];
}

const AxisSample& ComposedDevice::encoder_sample(std::size_t joint) const {
  return sample_at(joints_[joint].wiring.encoder);
}

double ComposedDevice::commanded_torque_Nm(std::size_t joint) const {
  const AxisAddress& motor = joints_[joint].wiring.motor;
  return boards_[motor.board].commands[motor.axis].torque_Nm;
}

void ComposedDevice::start() {
  latched_ = kDeviceOk;
  trouble_ = {};
  troubled_joint_ = kNoJoint;
  home_ = false;
  for (BoardState& board : std::span(boards_).first(board_count_)) {
    board.ref.start();
  }
  for (Joint& joint : std::span(joints_).first(joint_count_)) {
    joint.homing.lose();
    joint.why_lost = {};
  }
}

void ComposedDevice::stop() {
  for (BoardState& board : std::span(boards_).first(board_count_)) {
    board.ref.stop();
  }
}

void ComposedDevice::read(JointSample& sample) {
  const hal::TimeNs deadline_ns = clock_->now_ns() + read_limit_ns_;
  for (BoardState& board : std::span(boards_).first(board_count_)) {
    board.ref.read(std::span(board.samples).first(board.ref.axis_count()), deadline_ns);
  }
  const hal::TimeNs now_ns = clock_->now_ns();
  sample = {};
  for (std::size_t i = 0; i < joint_count_; ++i) {
    sample.status |= read_joint(i, now_ns, sample);
  }
  latched_ |= sample.status & kLatchedStatus;
  sample.status |= latched_;
}

// Fills in the joint's values and returns its DeviceStatus bits.
std::uint32_t ComposedDevice::read_joint(std::size_t i, hal::TimeNs now_ns, JointSample& sample) {
  Joint& joint = joints_[i];
  const AxisSample& encoder = encoder_sample(i);
  const AxisSample& motor = sample_at(joint.wiring.motor);
  // Only the encoder's kDeviceReferenceLost counts, and only for an encoder that is not absolute;
  // `follow_reference` reports it.
  std::uint32_t status =
      (encoder.status | motor.status) & ~static_cast<std::uint32_t>(kDeviceReferenceLost);
  status |= follow_reference(i);
  if ((status & ~static_cast<std::uint32_t>(kDeviceStale)) == kDeviceOk) {
    joint.homing.advance(encoder, home_, now_ns);
  }
  if (joint.homing.trouble()) {
    status |= kDeviceDriveFault;
  }
  if (!joint.homing.is_referenced()) {
    status |= home_ ? kDeviceHoming : kDeviceNotReady;
  } else {
    joint.why_lost = {};
  }
  if ((status & kLatchedStatus) != 0) {
    note_trouble(i);
  }
  const Transmission& transmission = joint.homing.transmission();
  sample.position[i] = joint_position(transmission, encoder.position_rad);
  sample.velocity[i] = joint_velocity(transmission, encoder.velocity_rad_per_s);
  if (motor.has_torque) {
    sample.effort[i] = joint_effort(transmission, motor.torque_Nm);
    sample.effort_known |= 1U << i;
    if (motor.torque_time_ns != std::exchange(joint.torque_time_ns, motor.torque_time_ns)) {
      sample.effort_is_new |= 1U << i;
    }
  }
  // Before the joint is up and referenced its position is meaningless, so its age does not matter.
  if ((status & (kDeviceNotReady | kDeviceHoming)) == 0) {
    sample.age_us = std::max(sample.age_us, age_us(now_ns, encoder.time_ns));
  }
  return status;
}

// Removes the joint's reference once its encoder's zero may have moved, in any mode and also after
// other faults. Returns kDeviceReferenceLost in the tick that removes it, else no bit.
std::uint32_t ComposedDevice::follow_reference(std::size_t i) {
  Joint& joint = joints_[i];
  if ((encoder_sample(i).status & kLosesReference) == 0) {
    return kDeviceOk;
  }
  const bool was_referenced = joint.homing.is_referenced();
  joint.homing.lose();
  if (!was_referenced || joint.homing.is_referenced()) {
    return kDeviceOk;
  }
  const Trouble trouble = trouble_at(joint.wiring.encoder);
  joint.why_lost = trouble ? trouble : Trouble{"its encoder was out of reach", "reset, then home"};
  return kDeviceReferenceLost;
}

Trouble ComposedDevice::trouble_at(const AxisAddress& address) const {
  return boards_[address.board].ref.trouble(address.axis);
}

JointTrouble ComposedDevice::lost_reference() const {
  for (const Joint& joint : std::span(joints_).first(joint_count_)) {
    if (joint.why_lost) {
      return {joint.wiring.name, joint.why_lost};
    }
  }
  return {};
}

// Keeps the fault of the first joint that has one and updates its words: a link that goes down
// first shows as silent drives.
void ComposedDevice::note_trouble(std::size_t i) {
  if (troubled_joint_ == kNoJoint) {
    troubled_joint_ = i;
  }
  if (troubled_joint_ != i) {
    return;
  }
  const Joint& joint = joints_[i];
  Trouble trouble = trouble_at(joint.wiring.motor);
  if (!trouble) {
    trouble = trouble_at(joint.wiring.encoder);
  }
  if (!trouble) {
    trouble = joint.homing.trouble();
  }
  if (trouble) {
    trouble_ = {joint.wiring.name, trouble};
  }
}

std::uint32_t ComposedDevice::write(const JointCommand& command) {
  home_ = command.home;
  const bool is_well = latched_ == kDeviceOk;
  for (std::size_t i = 0; i < joint_count_; ++i) {
    const Joint& joint = joints_[i];
    const bool searches = command.home && joint.homing.is_searching();
    const double effort = searches ? joint.homing.effort() : command.effort[i];
    const double torque_Nm = motor_torque_Nm(joint.homing.transmission(), effort);
    AxisCommand& axis = boards_[joint.wiring.motor.board].commands[joint.wiring.motor.axis];
    axis.power_off = command.power_off || !is_well;
    axis.enable = !axis.power_off && (command.enable || (searches && effort != 0.0));
    axis.torque_Nm =
        axis.enable ? std::clamp(torque_Nm, -joint.wiring.max_torque_Nm, joint.wiring.max_torque_Nm)
                    : 0.0;
  }
  for (BoardState& board : std::span(boards_).first(board_count_)) {
    board.ref.write(std::span(board.commands).first(board.ref.axis_count()));
  }
  return latched_;
}

void ComposedDevice::clear_faults() {
  latched_ = kDeviceOk;
  trouble_ = {};
  troubled_joint_ = kNoJoint;
  for (BoardState& board : std::span(boards_).first(board_count_)) {
    board.ref.clear_faults();
  }
  for (Joint& joint : std::span(joints_).first(joint_count_)) {
    if (joint.homing.trouble()) {
      joint.homing.lose();
    }
  }
}

}  // namespace tactus::drivers
