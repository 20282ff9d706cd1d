#include "firmware/safety/sample_check.h"

#include <cmath>

#include "firmware/safety/faults.h"

namespace tactus::firmware {

bool is_referenced(std::uint32_t device_status) {
  return (device_status &
          (drivers::kDeviceNotReady | drivers::kDeviceHoming | drivers::kDeviceReferenceLost)) == 0;
}

std::uint64_t device_faults(std::uint32_t device_status) {
  std::uint64_t faults = kNoFault;
  faults |= (device_status & drivers::kDeviceEncoderFault) != 0 ? kFaultEncoder : kNoFault;
  faults |= (device_status & drivers::kDeviceDriveFault) != 0 ? kFaultDrive : kNoFault;
  faults |= (device_status & drivers::kDeviceEmergencyStop) != 0 ? kFaultEmergencyStop : kNoFault;
  faults |= (device_status & drivers::kDeviceLost) != 0 ? kFaultDeviceLost : kNoFault;
  faults |= (device_status & drivers::kDeviceTooHot) != 0 ? kFaultOverTemperature : kNoFault;
  faults |= (device_status & drivers::kDeviceReferenceLost) != 0 ? kFaultReferenceLost : kNoFault;
  return faults;
}

void SampleCheck::configure(const ControllerConfig& config) {
  *this = SampleCheck{};
  joint_count_ = joint_count(config.mechanism);
  limits_ = config.joints;
  coupled_limits_ = config.coupled_limits;
  max_age_us_ = config.safety.max_sample_age_us;
  stale_ticks_to_fault_ = config.safety.stale_ticks_to_fault;
}

std::uint64_t SampleCheck::check(const drivers::JointSample& sample) {
  return device_faults(sample.status) | check_age(sample) | check_joints(sample);
}

std::uint64_t SampleCheck::check_age(const drivers::JointSample& sample) {
  if ((sample.status & drivers::kDeviceStale) == 0 && sample.age_us <= max_age_us_) {
    stale_in_a_row_ = 0;
    return kNoFault;
  }
  ++stale_count_;
  if (stale_in_a_row_ < stale_ticks_to_fault_) {
    ++stale_in_a_row_;
  }
  return kLimitStaleSample |
         (stale_in_a_row_ >= stale_ticks_to_fault_ ? kFaultStaleSamples : kNoFault);
}

std::uint64_t SampleCheck::check_joints(const drivers::JointSample& sample) const {
  std::uint64_t faults = kNoFault;
  for (std::size_t joint = 0; joint < joint_count_; ++joint) {
    const double position = sample.position[joint];
    if (!std::isfinite(position) || !std::isfinite(sample.velocity[joint])) {
      faults |= kFaultJointNotFinite;
    } else if (position < limits_[joint].lower || position > limits_[joint].upper) {
      faults |= kFaultJointLimit;
    }
  }
  for (const CoupledLimit& limit : coupled_limits_) {
    const double difference = sample.position[limit.joint] - sample.position[limit.minus];
    if (difference < limit.lower || difference > limit.upper) {
      faults |= kFaultJointLimit;
    }
  }
  // Before homing, positions mean nothing; numbers that are not finite are a fault all the same.
  return is_referenced(sample.status) ? faults : faults & kFaultJointNotFinite;
}

}  // namespace tactus::firmware
