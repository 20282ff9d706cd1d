// Fills the record of a tick: opens it with the inputs, adds what the stages have computed, closes
// it with the results and their hash. Pure functions of their arguments; real time.
#pragma once

#include "drivers/device.h"
#include "firmware/control/effort_path.h"
#include "firmware/control/force_path.h"
#include "firmware/control/guards.h"
#include "firmware/control/mode.h"
#include "firmware/control/mode_machine.h"
#include "firmware/control/next_tick.h"
#include "firmware/telemetry/record.h"
#include "rendering/touch.h"

namespace tactus::firmware {

// Starts the record of a tick with its inputs. Counters and hash continue from the record before.
void open_record(const NextTick& next, const drivers::JointSample& sample, Request request,
                 double rate_hz, TelemetryRecord& record);

// Adds the touch.
void record_touch(const rendering::Touch& touch, TelemetryRecord& record);

// Adds the parts of the efforts that compensate weights and friction.
void record_efforts(const ActiveEfforts& efforts, TelemetryRecord& record);

// The state of the units after a tick.
struct TickResults {
  const ModeMachine& modes;
  const Guards& guards;
  const ForcePath& force;
  const rendering::ToolState& tool;
  const drivers::JointCommand& command;
};

// Adds the results and hashes the record.
void close_record(const TickResults& results, TelemetryRecord& record);

}  // namespace tactus::firmware
