// The values that the next tick takes over from the time before it. Plain data.
#pragma once

#include <cstdint>

#include "drivers/device.h"
#include "firmware/control/parameters.h"
#include "firmware/safety/encoder_guard.h"
#include "firmware/safety/loop_check.h"

namespace tactus::firmware {

// The next tick before it begins.
struct NextTick {
  std::uint64_t number = 0;
  // The loop's report for the tick.
  LoopReport loop;
  // The DeviceStatus bits of the last write.
  std::uint32_t write_status = drivers::kDeviceOk;
  // The change of a parameter that the tick records.
  ParameterChange change;
  // The efforts of the last command, N or N m. The motors hold them until the next one.
  JointEfforts held_effort{};
};

}  // namespace tactus::firmware
