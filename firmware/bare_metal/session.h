// The run of a controller on a device, and the lines that it tells: what a board and the reference
// program on a desktop have in common. One thread; real time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "drivers/device.h"
#include "firmware/bare_metal/line.h"
#include "firmware/control/controller.h"
#include "firmware/control/mode.h"
#include "firmware/control/run_tick.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {

// A line is told every so many ticks.
inline constexpr std::uint64_t kTicksPerLine = 1000;

// Returns true if the line of this record's tick is due.
bool is_line_due(const TelemetryRecord& record);
// Returns the line of a tick: its number, counted from 1, the state hash, the mode and the contact.
Line tick_line(const TelemetryRecord& record);
// Returns the line of a new fault: its code and name, the tick, and the joint if it is of one.
Line fault_line(const TelemetryRecord& record, std::uint64_t new_faults);
// Returns the line with the checksums of both images.
Line image_line(std::span<const std::byte> device, std::span<const std::byte> scene);

// A controller with its device.
template <drivers::Device D>
class Session {
 public:
  // Both must outlive it.
  Session(Controller& controller, D& device) : controller_(controller), device_(device) {}

  // Runs a tick that brings the device closer to force; `missed_ticks` periods before it were
  // missed. After a fault it asks for nothing: only a person may reset one. Calls tell(line) for
  // what there is to say of it.
  template <class Tell>
  void tick(std::uint32_t missed_ticks, Tell&& tell) {
    this->tick(LoopReport{.missed_ticks = missed_ticks}, request_toward_active(controller_.mode()),
               tell);
  }

  // Runs a tick with a request, and tells the same.
  template <class Tell>
  void tick(const LoopReport& loop, Request request, Tell&& tell) {
    controller_.note_loop(loop);
    run_tick(controller_, device_, request);
    const TelemetryRecord& record = controller_.record();
    if (const std::uint64_t fresh = record.faults & ~told_faults_; fresh != 0) {
      told_faults_ = record.faults;
      tell(fault_line(record, fresh));
    }
    if (is_line_due(record)) {
      tell(tick_line(record));
    }
  }

 private:
  Controller& controller_;
  D& device_;
  // The faults of which a line was told.
  std::uint64_t told_faults_ = kNoFault;
};

}  // namespace tactus::firmware
