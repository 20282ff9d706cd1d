#include "drivers/odrive_can/odrive_errors.h"

#include <array>
#include <span>
#include <string_view>

namespace tactus::drivers::odrive {

namespace {

struct BitWords {
  std::uint64_t bit = 0;
  std::string_view what;
  std::string_view remedy;
};

constexpr std::string_view kReset = "reset; if it comes back, power-cycle the drive";
constexpr std::string_view kCoolDown = "let it cool, lower the torque limit, then reset";
constexpr std::string_view kCalibrate = "calibrate the motor with odrivetool, save, then reset";
constexpr std::string_view kEncoderCable = "check the encoder and its cable, then reset";
constexpr std::string_view kPhaseWires = "check the motor's phase wires, then reset";
constexpr std::string_view kSupply = "check the supply and the brake resistor, then reset";
constexpr std::string_view kSetUp = "compare the drive's set-up with drivers/odrive_can/README.md";
constexpr std::string_view kTune = "lower the drive's gains or bandwidth, then reset";

constexpr std::uint32_t kEmergencyStop_0_5 = 0x4000;
constexpr std::uint32_t kEmergencyStop_0_6 = 0x0200'0000;
constexpr std::uint32_t kPartsFailed = 0x40 | 0x80 | 0x100 | 0x200;
constexpr std::uint32_t kWatchdog_0_5 = 0x800;
constexpr std::uint32_t kWatchdog_0_6 = 0x0100'0000;

constexpr std::uint32_t kEncoderFailed = 0x100;
constexpr std::uint32_t kUnknownPosition = 0x8'0000;
// The motor reports a supply voltage out of range as a fault of the whole system.
constexpr std::uint64_t kMotorSystemLevel = 0x100'0000;
constexpr std::uint64_t kUnknownSupply = 0x8000'0000;
constexpr std::uint32_t kNoValidEstimate = 0x20;  // of the controller
constexpr std::uint32_t kSpun = 0x80;             // of the controller
constexpr std::uint32_t kInitializing = 0x1;
constexpr std::uint32_t kSystemLevel = 0x2;
constexpr std::uint32_t kMissingEstimate = 0x8;
constexpr std::uint32_t kUnderVoltage = 0x200;
constexpr std::uint32_t kSpun_0_6 = 0x0400'0000;

// The most specific bits come first.
constexpr std::array kAxisBits = {
    BitWords{kEmergencyStop_0_5, "an emergency stop was asked of the drive",
             "find out who stopped it, then reset"},
    BitWords{kWatchdog_0_5, "the drive's watchdog expired: commands came too late",
             "check the bus's cable and the host's load, then reset"},
    BitWords{0x40000, "the drive is too hot", kCoolDown},
    BitWords{0x1000, "the drive's lower end switch is pressed", "move the axis off it, then reset"},
    BitWords{0x2000, "the drive's upper end switch is pressed", "move the axis off it, then reset"},
    BitWords{0x80000, "the drive does not know its position", kCalibrate},
    BitWords{0x20000, "the drive was told to home without an end switch", kSetUp},
    BitWords{0x40, "the drive reports an error of its motor", kReset},
    BitWords{0x100, "the drive reports an error of its encoder", kEncoderCable},
    BitWords{0x200, "the drive reports an error of its controller", kReset},
    BitWords{0x80, "the drive reports an error of its sensorless estimator", kSetUp},
    BitWords{0x1, "the drive refused a state: it is not calibrated or has an error", kCalibrate},
};

constexpr std::array kMotorBits = {
    BitWords{0x8, "the drive's gate driver reports a fault",
             "check the phase wires for a short, power-cycle the drive"},
    BitWords{0x20000, "the motor is too hot", kCoolDown},
    BitWords{0x40000, "the drive's transistors are too hot", kCoolDown},
    BitWords{0x1000, "the motor's current passed its limit",
             "raise current_lim_margin or lower the gains, then reset"},
    BitWords{0x400, "the drive's current measurement is saturated",
             "raise requested_current_range, then reset"},
    BitWords{0x8'0000'0000, "the motor's phases are unbalanced", kPhaseWires},
    BitWords{0x1, "the phase resistance is out of range", kPhaseWires},
    BitWords{0x2, "the phase inductance is out of range", kPhaseWires},
    BitWords{0x80'0000, "the brake resistor is disarmed", kSupply},
    BitWords{0x40'0000, "the drive's supply current is out of range", kSupply},
    BitWords{0x8000'0000, "the drive does not know its supply voltage", kReset},
    BitWords{0x80, "the drive's voltage does not suffice for the current",
             "check the supply and the motor's constants, then reset"},
    BitWords{0x1'0000, "the drive computed a modulation that is not a number", kReset},
    BitWords{0x10, "the drive's current control missed its deadline", kReset},
    BitWords{0x8'0000, "the drive missed an update of its timer", kReset},
    BitWords{0x200'0000, "the drive's control timing is off", kReset},
    BitWords{0x10'0000, "the drive could not measure the motor's current", kReset},
    BitWords{0x400'0000, "the drive has no estimate of the rotor's phase", kEncoderCable},
    BitWords{0x800'0000, "the drive has no estimate of the phase's speed", kEncoderCable},
    BitWords{0x1000'0000, "the drive has no torque setpoint", kReset},
    BitWords{0x2000'0000, "the drive has no current command", kReset},
    BitWords{0x4000'0000, "the drive has no current measurement", kReset},
    BitWords{0x1'0000'0000, "the drive has no voltage command", kReset},
    BitWords{0x2'0000'0000, "the drive's current gains are not set", kCalibrate},
    BitWords{0x4'0000'0000, "the drive's current control was still starting", kReset},
    BitWords{0x20'0000, "the drive's current control failed", kReset},
    BitWords{0x100'0000, "the drive has a fault of the whole system",
             "power-cycle the drive; see dump_errors in odrivetool"},
};

constexpr std::array kEncoderBits = {
    BitWords{0x4, "the encoder does not answer", kEncoderCable},
    BitWords{0x10, "the Hall sensors give an impossible pattern", kEncoderCable},
    BitWords{0x40, "the absolute encoder answers too late", kEncoderCable},
    BitWords{0x80, "the absolute encoder's data are corrupt", kEncoderCable},
    BitWords{0x100, "the absolute encoder is not ready", kEncoderCable},
    BitWords{0x2, "the encoder's counts do not fit the motor's pole pairs", kSetUp},
    BitWords{0x20, "the encoder's index has not been found", kCalibrate},
    BitWords{0x200, "the Hall sensors are not calibrated", kCalibrate},
    BitWords{0x8, "the drive does not support the encoder's mode", kSetUp},
    BitWords{0x1, "the encoder's bandwidth is too high to be stable", kTune},
};

constexpr std::array kControllerBits = {
    BitWords{0x1, "the shaft turned faster than the drive's limit",
             "raise vel_limit as drivers/odrive_can/README.md says, then reset"},
    BitWords{0x80, "the motor spun without the encoder following",
             "check the encoder's mounting, calibrate, then reset"},
    BitWords{0x20, "the drive has no valid position estimate", kEncoderCable},
    BitWords{0x2, "the drive does not know its input mode", kSetUp},
    BitWords{0x4, "the drive's gains are not stable", kTune},
    BitWords{0x8, "the drive mirrors an axis that is not there", kSetUp},
    BitWords{0x10, "the drive's load encoder is not there", kSetUp},
    BitWords{0x40, "the drive's circular range is out of bounds", kSetUp},
};

constexpr std::array kActiveBits = {
    BitWords{kEmergencyStop_0_6, "an emergency stop was asked of the drive",
             "find out who stopped it, then reset"},
    BitWords{kWatchdog_0_6, "the drive's watchdog expired: commands came too late",
             "check the bus's cable and the host's load, then reset"},
    BitWords{0x20, "the drive's gate driver reports a fault",
             "check the phase wires for a short, power-cycle the drive"},
    BitWords{0x100, "the drive's supply voltage is too high", kSupply},
    BitWords{0x200, "the drive's supply voltage is too low", kSupply},
    BitWords{0x400, "the drive draws too much current from the supply", kSupply},
    BitWords{0x800, "the drive feeds too much current back into the supply", kSupply},
    BitWords{0x1000, "the motor's current passed its limit",
             "raise current_hard_max or lower the gains, then reset"},
    BitWords{0x2000, "the motor is too hot", kCoolDown},
    BitWords{0x4000, "the drive's transistors are too hot", kCoolDown},
    BitWords{0x1000'0000, "the motor's thermistor is disconnected",
             "check its cable or switch it off in the drive, then reset"},
    BitWords{0x8000, "the shaft turned faster than the drive's limit",
             "raise vel_limit as drivers/odrive_can/README.md says, then reset"},
    BitWords{0x1'0000, "the shaft is beyond the drive's position limit",
             "move it back or widen the limit, then reset"},
    BitWords{0x0400'0000, "the motor spun without the encoder following",
             "check the encoder's mounting, calibrate, then reset"},
    BitWords{0x8, "the drive has no valid estimate from its encoder", kEncoderCable},
    BitWords{0x0800'0000, "the brake resistor is disarmed", kSupply},
    BitWords{0x4000'0000, "the drive's calibration failed", kCalibrate},
    BitWords{0x40, "the drive misses an input", kSetUp},
    BitWords{0x10, "the drive's configuration is invalid", kSetUp},
    BitWords{0x4, "the drive's control timing is off", kReset},
    BitWords{0x1, "the drive is still starting", "wait a few seconds, then reset"},
    BitWords{0x2, "the drive has a fault of the whole system",
             "power-cycle the drive; if it comes back, write its firmware anew"},
};

struct ResultWords {
  std::uint8_t result = 0;
  std::string_view what;
  std::string_view remedy;
};

constexpr std::array kProcedureResults = {
    ResultWords{2, "the drive broke off going into closed loop", kReset},
    ResultWords{3, "the drive disarmed on the way into closed loop", kReset},
    ResultWords{4, "the drive's encoder does not answer", kEncoderCable},
    ResultWords{5, "the encoder's counts do not fit the motor's pole pairs", kSetUp},
    ResultWords{6, "the phase resistance is out of range", kPhaseWires},
    ResultWords{7, "the phase inductance is out of range", kPhaseWires},
    ResultWords{8, "the motor's phases are unbalanced", kPhaseWires},
    ResultWords{9, "the drive's motor type is invalid", kSetUp},
    ResultWords{10, "the Hall sensors give an impossible pattern", kEncoderCable},
    ResultWords{11, "the drive took too long to go into closed loop", kReset},
    ResultWords{12, "the drive was told to home without an end switch", kSetUp},
    ResultWords{13, "the drive cannot go into closed loop from its state", kReset},
    ResultWords{14, "the drive is not calibrated", kCalibrate},
    ResultWords{15, "the drive's calibration does not converge", kCalibrate},
};

Trouble telling_trouble(std::span<const BitWords> table, std::uint64_t error) {
  const auto low = static_cast<std::uint32_t>(error);
  const std::uint32_t code = low != 0 ? low : static_cast<std::uint32_t>(error >> 32U);
  for (const BitWords& words : table) {
    if ((error & words.bit) != 0) {
      return {words.what, words.remedy, code, words.remedy == kCoolDown};
    }
  }
  return {"the drive reports an error that this program does not know",
          "look the number up in the drive's manual, then reset", code};
}

}  // namespace

Trouble axis_trouble(std::uint32_t error) {
  return telling_trouble(kAxisBits, error);
}

Trouble motor_trouble(std::uint64_t error) {
  return telling_trouble(kMotorBits, error);
}

Trouble encoder_trouble(std::uint32_t error) {
  return telling_trouble(kEncoderBits, error);
}

Trouble controller_trouble(std::uint32_t error) {
  return telling_trouble(kControllerBits, error);
}

bool is_explained_elsewhere(std::uint32_t axis_error) {
  return (axis_error & kPartsFailed) != 0 && (axis_error & ~(kPartsFailed | 0x1U)) == 0;
}

Trouble active_trouble(std::uint32_t error) {
  return telling_trouble(kActiveBits, error);
}

Trouble procedure_trouble(std::uint8_t result) {
  constexpr std::uint8_t kBusy = 1;
  if (result <= kBusy) {
    return {};
  }
  for (const ResultWords& words : kProcedureResults) {
    if (words.result == result) {
      return {words.what, words.remedy, result};
    }
  }
  return {"the drive did not go into closed loop, for a reason that this program does not know",
          "look the number up under procedure_result in the drive's manual", result};
}

bool loses_reference_0_5(std::uint32_t axis_error) {
  return (axis_error & (kEncoderFailed | kUnknownPosition)) != 0;
}

bool motor_loses_reference(std::uint64_t motor_error) {
  return (motor_error & (kMotorSystemLevel | kUnknownSupply)) != 0;
}

bool controller_loses_reference(std::uint32_t controller_error) {
  return (controller_error & (kNoValidEstimate | kSpun)) != 0;
}

bool loses_reference_0_6(std::uint32_t error) {
  return (error & (kInitializing | kSystemLevel | kMissingEstimate | kUnderVoltage | kSpun_0_6)) !=
         0;
}

bool is_watchdog_0_5(std::uint32_t axis_error) {
  return (axis_error & kWatchdog_0_5) != 0;
}

bool is_watchdog_0_6(std::uint32_t error) {
  return (error & kWatchdog_0_6) != 0;
}

bool is_emergency_stop_0_5(std::uint32_t axis_error) {
  return (axis_error & kEmergencyStop_0_5) != 0;
}

bool is_emergency_stop_0_6(std::uint32_t error) {
  return (error & kEmergencyStop_0_6) != 0;
}

}  // namespace tactus::drivers::odrive
