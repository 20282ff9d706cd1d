// The first guard of a tick: is this sample fit to compute with?
#pragma once

#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "rendering/state/state_archive.h"

namespace tactus::firmware {

class SampleCheck {
 public:
  void configure(const ControllerConfig& config);

  // FaultBits of this sample, faults and limits. Looks at the joints that the mechanism has.
  // Positions are held against the joint limits only
  // when the device is referenced: before that they mean nothing.
  std::uint64_t check(const drivers::JointSample& sample);

  // Samples too old, since configure().
  [[nodiscard]] std::uint32_t stale_count() const { return stale_count_; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  std::uint64_t check_age(const drivers::JointSample& sample);
  [[nodiscard]] std::uint64_t check_joints(const drivers::JointSample& sample) const;

  std::size_t joint_count_ = kJointCount;
  std::array<JointLimits, kJointCount> limits_{};
  std::array<CoupledLimit, kMaxCoupledLimits> coupled_limits_{};
  std::uint32_t max_age_us_ = 0;
  std::uint32_t stale_ticks_to_fault_ = 1;
  std::uint32_t stale_in_a_row_ = 0;
  std::uint32_t stale_count_ = 0;
};

// True when the device knows where its joints are and can be commanded.
bool is_referenced(std::uint32_t device_status);

// The fault of each device trouble that stops.
std::uint64_t device_faults(std::uint32_t device_status);

}  // namespace tactus::firmware
