#include "firmware/safety/loop_check.h"

#include <algorithm>
#include <cmath>

#include "firmware/safety/faults.h"

namespace tactus::firmware {

void LoopCheck::configure(const ControllerConfig& config) {
  *this = LoopCheck{};
  late_ticks_to_fault_ = config.safety.late_ticks_to_fault;
  const double gap_ticks = std::ceil(config.safety.max_tick_gap_s * config.rate_hz);
  missed_ticks_to_fault_ = static_cast<std::uint32_t>(std::max(1.0, gap_ticks));
}

std::uint64_t LoopCheck::check(const LoopReport& report) {
  std::uint64_t bits = kNoFault;
  if ((report.status & kLoopWatchdogLost) != 0) {
    bits |= kFaultWatchdog;
  }
  if ((report.status & kLoopHelperCrashed) != 0) {
    bits |= kFaultHelperCrashed;
  }
  if ((report.status & kLoopLineLost) != 0) {
    bits |= kFaultLineLost;
  }
  if (report.missed_ticks >= missed_ticks_to_fault_) {
    bits |= kFaultTickOverrun;
  }
  if ((report.status & kLoopLate) == 0 && report.missed_ticks == 0) {
    late_in_a_row_ = 0;
    return bits;
  }
  ++late_count_;
  late_in_a_row_ = std::min(late_in_a_row_ + 1, late_ticks_to_fault_);
  return bits | kLimitLateTick |
         (late_in_a_row_ >= late_ticks_to_fault_ ? kFaultLateTicks : kNoFault);
}

}  // namespace tactus::firmware
