#include "drivers/moteus_canfd/moteus_errors.h"

#include <array>

namespace tactus::drivers::moteus {

namespace {

struct FaultWords {
  std::uint8_t code = 0;
  std::string_view what;
  std::string_view remedy;
};

constexpr std::string_view kCalibrateServo = "run moteus_tool --calibrate, then reset";
constexpr std::string_view kEncoderWires =
    "check the encoder, its magnet and cable, then reset; see aux1 and aux2 in tview";
constexpr std::string_view kServoSetUp =
    "compare the servo's set-up with drivers/moteus_canfd/README.md";
constexpr std::string_view kServoSupply = "check the supply and what takes its regeneration";
constexpr std::string_view kServoCoolDown = "let it cool, lower the torque limit, then reset";
constexpr std::string_view kServoReset = "reset; if it comes back, power-cycle the servo";

constexpr std::array kFaults = {
    FaultWords{32, "the servo's calibration failed", kCalibrateServo},
    FaultWords{33, "the servo's motor driver reports a fault",
               "check the phase wires for a short; see drv8323 in tview"},
    FaultWords{34, "the servo's supply voltage is too high", kServoSupply},
    FaultWords{35, "the servo's encoder failed", kEncoderWires},
    FaultWords{36, "the servo's motor is not configured", kCalibrateServo},
    FaultWords{37, "the servo's control took longer than its period", kServoReset},
    FaultWords{38, "the servo is too hot", kServoCoolDown},
    FaultWords{39, "the servo started outside its position limits",
               "move it back or widen servopos, then reset"},
    FaultWords{40, "the servo's supply voltage is too low", kServoSupply},
    FaultWords{41, "the servo's configuration changed while it ran", kServoReset},
    FaultWords{42, "the servo does not know the rotor's angle", kEncoderWires},
    FaultWords{43, "the servo does not know its position", kEncoderWires},
    FaultWords{44, "the servo's motor driver cannot be enabled", kServoReset},
    FaultWords{45, "the servo refuses a stop position", kServoReset},
    FaultWords{46, "the servo's control timing is off", kServoReset},
    FaultWords{47, "the servo's feed-forward needs an acceleration limit", kServoSetUp},
    FaultWords{48, "the servo's limits are invalid", kServoSetUp},
    FaultWords{49, "the servo's position strayed too far", kServoSetUp},
    FaultWords{50, "the servo's velocity strayed too far", kServoSetUp},
};

}  // namespace

Trouble fault_trouble(std::uint8_t code) {
  for (const FaultWords& words : kFaults) {
    if (words.code == code) {
      return {words.what, words.remedy, code, words.remedy == kServoCoolDown};
    }
  }
  return {"the servo reports a fault that this program does not know",
          "look the number up in the moteus manual, then reset", code};
}

}  // namespace tactus::drivers::moteus
