// Checks whether a sample may be used: the first guard of a tick. One thread; real time.
#pragma once

#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The check of one device.
class SampleCheck {
 public:
  // Takes the limits and sets all counts to 0.
  void configure(const ControllerConfig& config);

  // Returns the FaultBits of this sample, faults and limits, for the joints of the mechanism.
  // Positions are compared with the joint limits only while the device is referenced, because they
  // mean nothing before.
  std::uint64_t check(const drivers::JointSample& sample);

  // Returns the number of samples since configure() that were too old.
  [[nodiscard]] std::uint32_t stale_count() const { return stale_count_; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  // Returns the bits of a stale sample.
  std::uint64_t check_age(const drivers::JointSample& sample);
  // Returns the bits of the joints' numbers and limits.
  [[nodiscard]] std::uint64_t check_joints(const drivers::JointSample& sample) const;

  std::size_t joint_count_ = kJointCount;
  std::array<JointLimits, kJointCount> limits_{};
  std::array<CoupledLimit, kMaxCoupledLimits> coupled_limits_{};
  std::uint32_t max_age_us_ = 0;
  std::uint32_t stale_ticks_to_fault_ = 1;
  std::uint32_t stale_in_a_row_ = 0;
  std::uint32_t stale_count_ = 0;
};

// Returns true if the device knows its joints' positions and can be commanded.
bool is_referenced(std::uint32_t device_status);

// Returns the FaultBits of the device troubles in `device_status` that stop.
std::uint64_t device_faults(std::uint32_t device_status);

}  // namespace tactus::firmware
