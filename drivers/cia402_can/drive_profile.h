// The motor drive profile (CiA 402) in cyclic synchronous torque mode: its states, and the process
// data that this driver maps. Bytes to meanings and back; no input or output, no state.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/can_frame.h"

namespace tactus::drivers::cia402 {

inline constexpr std::uint16_t kDeviceProfile = 402;            // low half of 1000:00
inline constexpr std::uint32_t kSupportsTorqueMode = 1U << 9U;  // in 6502:00
inline constexpr std::int8_t kCyclicSynchronousTorque = 10;     // 6060:00, 6061:00

enum class PowerState : std::uint8_t {
  not_ready_to_switch_on,
  switch_on_disabled,
  ready_to_switch_on,
  switched_on,
  operation_enabled,  // the only one in which the motor has torque
  quick_stop_active,
  fault_reaction_active,
  fault,
  unknown,  // a pattern that the profile does not have
};

// 6040:00
inline constexpr std::uint16_t kDisableVoltage = 0x0000;
inline constexpr std::uint16_t kShutdown = 0x0006;
inline constexpr std::uint16_t kSwitchOn = 0x0007;
inline constexpr std::uint16_t kEnableOperation = 0x000F;
inline constexpr std::uint16_t kFaultReset = 0x0080;  // at its rising edge

// 6041:00 beside the state: the motor's supply is there.
inline constexpr std::uint16_t kVoltageEnabled = 0x0010;

PowerState power_state(std::uint16_t statusword);

// True where the motor may have torque: also while a quick stop or the reaction to a fault brakes,
// and in a state that the profile does not have.
bool may_have_torque(PowerState state);

// What is wrong with a drive that stays in that state or goes there unasked; for a Trouble.
std::string_view power_state_words(PowerState state);

// The next step on the way to ready_to_switch_on or, with `power`, to operation_enabled. A fault is
// not left on this way.
std::uint16_t controlword_toward(PowerState state, bool power);

// RPDO1: controlword 6040:00, target torque 6071:00 in 0.1 % of the rated torque.
struct TorqueCommand {
  std::uint16_t controlword = kDisableVoltage;
  std::int16_t torque = 0;
};
hal::CanFrame command_frame(std::uint8_t node, const TorqueCommand& command);

// 'Disable voltage' as an SDO, which acts by itself: also out of operational, and without a SYNC.
hal::CanFrame disable_voltage_frame(std::uint8_t node);

// TPDO1: statusword 6041:00, position 6064:00 in counts, torque 6077:00 in 0.1 % of the rated one.
struct DriveState {
  std::uint16_t statusword = 0;
  std::int32_t position = 0;
  std::int16_t torque = 0;
};
std::optional<DriveState> drive_state_of(const hal::CanFrame& frame, std::uint8_t node);

// TPDO2: velocity 606C:00 in the drive's own unit, mode 6061:00.
struct DriveMotion {
  std::int32_t velocity = 0;
  std::int8_t mode = 0;
};
std::optional<DriveMotion> drive_motion_of(const hal::CanFrame& frame, std::uint8_t node);

}  // namespace tactus::drivers::cia402
