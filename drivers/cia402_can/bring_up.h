// The objects that the driver reads from a drive and writes to it before the drive may run, in
// order.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "drivers/axis.h"
#include "drivers/cia402_can/cia402_config.h"
#include "drivers/cia402_can/sdo.h"

namespace tactus::drivers::cia402 {

// The source of an object's value. A `fixed` value is written as it stands in the table, a
// `plus_node` value with the drive's number added. The others come from the configuration, or are
// read and checked.
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

// One object to read or write.
struct SdoStep {
  canopen::ObjectAddress object;
  std::uint8_t size = 0;  // bytes to write; 0: read
  Meaning meaning = Meaning::fixed;
  std::uint32_t value = 0;
  bool may_be_missing = false;  // the drive may lack the object
  std::string_view what;        // words for a Trouble if the drive refuses or does not answer
};

// The object that holds the code of the drive's last fault.
inline constexpr canopen::ObjectAddress kErrorCodeObject{0x603F, 0};

// Returns the steps before the drive is operational.
std::span<const SdoStep> set_up_steps();
// Returns the step after that: torque mode.
const SdoStep& torque_mode_step();

// The values that the drive reported, and what follows from them.
struct DriveFacts {
  std::uint32_t vendor = 0;
  double rated_torque_Nm = 0.0;
  std::int16_t torque_limit = 0;  // 0.1 % of the rated torque; what is written to 6072:00
};

// Returns the value to write in this step.
std::uint32_t value_to_write(const SdoStep& step, const Cia402Config& config,
                             const DriveFacts& facts);
// Stores a value that was read. Returns a Trouble if the drive cannot be used.
Trouble judge(const SdoStep& step, std::uint32_t value, const Cia402Config& config,
              DriveFacts& facts);
// Returns true if the drive may run although it refused the step with this abort code.
bool may_go_on_without(const SdoStep& step, std::uint32_t abort_code);

}  // namespace tactus::drivers::cia402
