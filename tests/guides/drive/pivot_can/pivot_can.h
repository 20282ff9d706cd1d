// A Pivot drive: it obeys a torque in each frame and answers with its encoder's counts.
//
// The drive has no watchdog. After a fault every frame carries zero torque, until clear_faults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "drivers/can_drive.h"
#include "drivers/common/counted_shaft.h"
#include "drivers/common/fault_latch.h"
#include "drivers/pivot_can/pivot_config.h"

namespace tactus::drivers {

// A CanDrive. Its status bits:
//   kDeviceNotReady       until the first answer
//   kDeviceLost           latched: no answer for lost_after_s
//   kDeviceEncoderFault   latched: a position that the shaft cannot have reached
//   kDeviceReferenceLost  latched beside both
class PivotCan {
 public:
  // The configuration has passed `check`.
  explicit PivotCan(const PivotConfig& config);

  std::size_t filters(std::span<hal::CanFilter> filters) const;
  void start(hal::TimeNs now_ns);
  void take(const hal::CanReceived& received);
  void request(hal::TimeNs now_ns, CanOutbox& outbox);
  void command(hal::TimeNs now_ns, const AxisCommand& command, CanOutbox& outbox) const;
  [[nodiscard]] const AxisSample& sample() const { return sample_; }
  [[nodiscard]] Trouble trouble() const { return faults_.trouble(); }
  void clear_faults(hal::TimeNs now_ns);
  void shutdown(CanOutbox& outbox);

 private:
  void lose_position(DeviceStatus bit, const Trouble& trouble);

  PivotConfig config_;
  CountedShaft shaft_;
  FaultLatch faults_;
  AxisSample sample_;
  hal::TimeNs heard_ns_ = 0;  // time of the newest answer, or of the start
  bool is_started_ = false;
};

static_assert(CanDrive<PivotCan>);

}  // namespace tactus::drivers
