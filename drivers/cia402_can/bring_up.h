// The objects that a drive is asked for and told before it may run, in their order.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "drivers/axis.h"
#include "drivers/cia402_can/cia402_config.h"
#include "drivers/cia402_can/sdo.h"

namespace tactus::drivers::cia402 {

// What an object's value has to do with: `fixed` is written as the table has it, `plus_node` with
// the drive's number added; the others come from the configuration or are read and judged.
enum class Meaning : std::uint8_t {
  fixed,
  plus_node,
  watchdog,
  heartbeat_period,
  torque_limit,
  period,
  period_exponent,
  receive_type,
  motion_type,
  device_type,
  vendor,
  supported_modes,
  rated_torque,
};

struct SdoStep {
  canopen::ObjectAddress object;
  std::uint8_t size = 0;  // bytes to write; 0: read
  Meaning meaning = Meaning::fixed;
  std::uint32_t value = 0;
  bool may_be_missing = false;  // a drive that has no such object is well without it
  std::string_view what;        // for a Trouble, if the drive refuses or keeps silent
};

// The code of the drive's last fault.
inline constexpr canopen::ObjectAddress kErrorCodeObject{0x603F, 0};

// Before the drive is operational.
std::span<const SdoStep> set_up_steps();
// After that.
const SdoStep& torque_mode_step();

// What the drive has told, and what follows from it.
struct DriveFacts {
  std::uint32_t vendor = 0;
  double rated_torque_Nm = 0.0;
  std::int16_t torque_limit = 0;  // 0.1 % of the rated torque; what is written to 6072:00
};

// What to write in this step.
std::uint32_t value_to_write(const SdoStep& step, const Cia402Config& config,
                             const DriveFacts& facts);
// Takes in what was read; trouble if the drive cannot be used.
Trouble judge(const SdoStep& step, std::uint32_t value, const Cia402Config& config,
              DriveFacts& facts);
// Whether a drive that refused the step so may go on without it.
bool may_go_on_without(const SdoStep& step, std::uint32_t abort_code);

}  // namespace tactus::drivers::cia402
