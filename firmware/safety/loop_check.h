// Guards the controller's own time: turns the loop's reports into faults and limits. One thread;
// real time.
#pragma once

#include <cstdint>

#include "firmware/configuration/controller_config.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The bits of the loop's report. They are an input of the tick and are recorded with it.
enum LoopStatus : std::uint32_t {
  kLoopOnTime = 0,
  // This tick began later than the loop allows.
  kLoopLate = 1U << 0,
  // The watchdog output could not be driven.
  kLoopWatchdogLost = 1U << 1,
  // A thread beside the loop has crashed; the program will end.
  kLoopHelperCrashed = 1U << 2,
  // The host that supervises a bare board over its serial line has fallen silent.
  kLoopLineLost = 1U << 3,
};

// The loop's report for one tick.
struct LoopReport {
  // LoopStatus bits.
  std::uint32_t status = kLoopOnTime;
  // The number of whole periods that were skipped just before this tick.
  std::uint32_t missed_ticks = 0;
};

// The check of one loop.
class LoopCheck {
 public:
  // Takes the thresholds and sets all counts to 0.
  void configure(const ControllerConfig& config);

  // Returns the FaultBits of this tick, faults and limits. A tick after missed ones is late, too.
  std::uint64_t check(const LoopReport& report);

  // Returns the number of late ticks since configure().
  [[nodiscard]] std::uint32_t late_count() const { return late_count_; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  std::uint32_t late_ticks_to_fault_ = 1;
  std::uint32_t missed_ticks_to_fault_ = 1;
  std::uint32_t late_in_a_row_ = 0;
  std::uint32_t late_count_ = 0;
};

}  // namespace tactus::firmware
