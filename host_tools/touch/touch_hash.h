// The state hash of a tick without a device, which shows that two touches were the same to the bit.
// `tactus touch --hashes` and the Python module use it.
#pragma once

#include <cstddef>

#include "firmware/control/tick_record.h"
#include "firmware/telemetry/record.h"
#include "rendering/touch.h"

namespace tactus::host {

// Chains the ticks of one tool.
class TouchHash {
 public:
  // Returns the record of a tick at the time t_s: that of a controller with no device, whose state
  // hash continues that of the tick before.
  const firmware::TelemetryRecord& add(std::size_t tick, double t_s,
                                       const rendering::ToolState& tool,
                                       const rendering::Touch& touch) {
    const std::uint64_t before = record_.state_hash;
    record_ = {.tick = tick, .time_s = t_s};
    record_.tool_p_W = firmware::to_triple(tool.p_W);
    record_.tool_v_W = firmware::to_triple(tool.v_W);
    firmware::record_touch(touch, record_);
    record_.state_hash = firmware::state_hash(record_, before);
    return record_;
  }

 private:
  firmware::TelemetryRecord record_;
};

}  // namespace tactus::host
