// The motor drive profile (CiA 402) in cyclic synchronous torque mode: its states, and the process
// data that this driver maps. Encodes and decodes frames, without input, output or state.
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
  unknown,  // a pattern that the profile does not define
};

// The controlword 6040:00.
inline constexpr std::uint16_t kDisableVoltage = 0x0000;
inline constexpr std::uint16_t kShutdown = 0x0006;
inline constexpr std::uint16_t kSwitchOn = 0x0007;
inline constexpr std::uint16_t kEnableOperation = 0x000F;
inline constexpr std::uint16_t kFaultReset = 0x0080;  // acts at its rising edge

// A bit of the statusword 6041:00 beside the state: the motor has its supply.
inline constexpr std::uint16_t kVoltageEnabled = 0x0010;

// Returns the state that the statusword shows.
PowerState power_state(std::uint16_t statusword);

// Returns true if the motor may have torque: also while a quick stop or the reaction to a fault
// brakes, and in an unknown state.
bool may_have_torque(PowerState state);

// Returns words for a Trouble: a drive stays in that state, or goes there unasked.
std::string_view power_state_words(PowerState state);

// Returns the next controlword toward ready_to_switch_on or, with `power`, toward
// operation_enabled. It does not lead out of a fault.
std::uint16_t controlword_toward(PowerState state, bool power);

// The content of RPDO1: controlword 6040:00, and target torque 6071:00 in 0.1 % of the rated
// torque.
struct TorqueCommand {
  std::uint16_t controlword = kDisableVoltage;
  std::int16_t torque = 0;
};
hal::CanFrame command_frame(std::uint8_t node, const TorqueCommand& command);

// Returns 'disable voltage' as an SDO. It acts at once, without a SYNC and also out of operational.
hal::CanFrame disable_voltage_frame(std::uint8_t node);

// The content of TPDO1: statusword 6041:00, position 6064:00 in counts, and torque 6077:00 in 0.1 %
// of the rated torque.
struct DriveState {
  std::uint16_t statusword = 0;
  std::int32_t position = 0;
  std::int16_t torque = 0;
};
std::optional<DriveState> drive_state_of(const hal::CanFrame& frame, std::uint8_t node);

// The content of TPDO2: velocity 606C:00 in the drive's own unit, and mode 6061:00.
struct DriveMotion {
  std::int32_t velocity = 0;
  std::int8_t mode = 0;
};
std::optional<DriveMotion> drive_motion_of(const hal::CanFrame& frame, std::uint8_t node);

}  // namespace tactus::drivers::cia402
