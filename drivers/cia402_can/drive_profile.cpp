#include "drivers/cia402_can/drive_profile.h"

#include <array>

#include "drivers/cia402_can/canopen.h"
#include "drivers/cia402_can/sdo.h"
#include "drivers/common/little_endian.h"

namespace tactus::drivers::cia402 {

namespace {

struct StatePattern {
  std::uint16_t mask = 0;
  std::uint16_t value = 0;
  PowerState state = PowerState::unknown;
};

constexpr std::array<StatePattern, 8> kPatterns = {{
    {0x4F, 0x00, PowerState::not_ready_to_switch_on},
    {0x4F, 0x40, PowerState::switch_on_disabled},
    {0x6F, 0x21, PowerState::ready_to_switch_on},
    {0x6F, 0x23, PowerState::switched_on},
    {0x6F, 0x27, PowerState::operation_enabled},
    {0x6F, 0x07, PowerState::quick_stop_active},
    {0x4F, 0x0F, PowerState::fault_reaction_active},
    {0x4F, 0x08, PowerState::fault},
}};

}  // namespace

PowerState power_state(std::uint16_t statusword) {
  for (const StatePattern& pattern : kPatterns) {
    if ((statusword & pattern.mask) == pattern.value) {
      return pattern.state;
    }
  }
  return PowerState::unknown;
}

bool may_have_torque(PowerState state) {
  return state == PowerState::operation_enabled || state == PowerState::quick_stop_active ||
         state == PowerState::fault_reaction_active || state == PowerState::unknown;
}

std::string_view power_state_words(PowerState state) {
  switch (state) {
    case PowerState::not_ready_to_switch_on:
      return "drive has no power: it is not ready to switch on";
    case PowerState::switch_on_disabled:
      return "drive has no power: it is in 'switch on disabled'";
    case PowerState::ready_to_switch_on:
      return "drive has no power: it is in 'ready to switch on'";
    case PowerState::switched_on:
      return "drive has no torque: it is in 'switched on'";
    case PowerState::operation_enabled:
      return "drive does not leave 'operation enabled'";
    case PowerState::quick_stop_active:
      return "drive is in quick stop";
    case PowerState::fault_reaction_active:
    case PowerState::fault:
      return "drive does not leave its fault";
    case PowerState::unknown:
      break;
  }
  return "drive sends a statusword that CiA 402 does not have";
}

std::uint16_t controlword_toward(PowerState state, bool power) {
  switch (state) {
    case PowerState::switch_on_disabled:
      return kShutdown;
    case PowerState::ready_to_switch_on:
      return power ? kSwitchOn : kShutdown;
    case PowerState::switched_on:
    case PowerState::operation_enabled:
      return power ? kEnableOperation : kShutdown;
    case PowerState::not_ready_to_switch_on:
    case PowerState::quick_stop_active:
    case PowerState::fault_reaction_active:
    case PowerState::fault:
    case PowerState::unknown:
      break;
  }
  return kDisableVoltage;
}

hal::CanFrame command_frame(std::uint8_t node, const TorqueCommand& command) {
  hal::CanFrame frame{.id = canopen::kReceivePdo1 + node, .length = 4};
  store_little_endian(command.controlword, frame.data, 0);
  store_little_endian(command.torque, frame.data, 2);
  return frame;
}

hal::CanFrame disable_voltage_frame(std::uint8_t node) {
  constexpr canopen::ObjectAddress kControlword{0x6040, 0};
  return canopen::sdo_write(node, kControlword, kDisableVoltage, 2);
}

std::optional<DriveState> drive_state_of(const hal::CanFrame& frame, std::uint8_t node) {
  if (!canopen::is_from(frame, canopen::kTransmitPdo1, node) || frame.length != 8) {
    return std::nullopt;
  }
  return DriveState{.statusword = load_little_endian<std::uint16_t>(frame.data, 0),
                    .position = load_little_endian<std::int32_t>(frame.data, 2),
                    .torque = load_little_endian<std::int16_t>(frame.data, 6)};
}

std::optional<DriveMotion> drive_motion_of(const hal::CanFrame& frame, std::uint8_t node) {
  if (!canopen::is_from(frame, canopen::kTransmitPdo2, node) || frame.length != 5) {
    return std::nullopt;
  }
  return DriveMotion{.velocity = load_little_endian<std::int32_t>(frame.data, 0),
                     .mode = load_little_endian<std::int8_t>(frame.data, 4)};
}

}  // namespace tactus::drivers::cia402
