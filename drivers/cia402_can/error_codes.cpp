#include "drivers/cia402_can/error_codes.h"

#include <array>
#include <string_view>

namespace tactus::drivers::cia402 {

namespace {

// Words for the codes whose bits in `mask` equal those of `code`. Narrower masks come first.
struct ErrorWords {
  std::uint16_t mask = 0;
  std::uint16_t code = 0;
  std::string_view what;
  std::string_view remedy;
};

constexpr std::uint16_t kTemperatures = 0x4000;  // the class of 0x4xxx

constexpr std::array<ErrorWords, 26> kErrorWords = {{
    {0xFFFF, 0x2310, "drive reports over-current at its output",
     "lower max_torque_Nm or the drive's current gains, check the motor's phases, then reset"},
    {0xFFFF, 0x3210, "drive reports too high a voltage of its DC link",
     "check the supply and the brake resistor, then reset"},
    {0xFFFF, 0x3220, "drive reports too low a voltage of its DC link",
     "switch motor power on or check the supply, then reset"},
    {0xFFFF, 0x4310, "drive reports over-temperature",
     "let it cool down and check its cooling, then reset"},
    {0xFFFF, 0x7305, "drive reports a fault of its encoder",
     "check the encoder's cable and supply, then reset"},
    {0xFFFF, 0x8110, "drive reports that its CAN controller lost frames",
     "lower the load of the bus, then reset"},
    {0xFFFF, 0x8120, "drive reports that its CAN controller is error passive",
     "check wiring, termination and bit rate, then reset"},
    {0xFFFF, 0x8130, "drive reports that the host's heartbeat stopped",
     "check the cable and the host's load, then reset"},
    {0xFFFF, 0x8140, "drive reports that it was off the bus",
     "check wiring, termination and bit rate, then reset"},
    {0xFFFF, 0x8210, "drive reports a PDO that is too short",
     "look for a second master on the bus, then reset"},
    {0xFFFF, 0x8220, "drive reports a PDO that is too long",
     "look for a second master on the bus, then reset"},
    {0xFFFF, 0x8250, "drive reports that commands stopped coming",
     "check the cable and the host's load, then reset"},
    {0xF000, 0x1000, "drive reports a generic error", "see the drive's own diagnosis, then reset"},
    {0xF000, 0x2000, "drive reports a fault of its current",
     "check the motor's phases and the current limits, then reset"},
    {0xF000, 0x3000, "drive reports a fault of a voltage", "check the supply, then reset"},
    {0xF000, kTemperatures, "drive reports a fault of a temperature",
     "let it cool down and check its cooling, then reset"},
    {0xFF00, 0x5100, "drive reports a fault of the supply of its electronics",
     "check its supply, then reset and home"},
    {0xF000, 0x5000, "drive reports a hardware fault",
     "see the drive's own diagnosis; switch it off and on"},
    {0xFFFF, 0x6010, "drive's program was restarted by its own watchdog",
     "see the drive's own diagnosis, then reset and home"},
    {0xF000, 0x6000, "drive reports a fault of its software or parameters",
     "see the drive's own diagnosis; restore its parameters"},
    {0xF000, 0x7000, "drive reports a fault of an attached part: encoder, brake or motor",
     "check the motor's and the encoder's cables, then reset"},
    {0xFF00, 0x8100, "drive reports a fault of its communication",
     "check the cable and the host's load, then reset"},
    {0xFF00, 0x8200, "drive reports a protocol error",
     "look for a second master on the bus, then reset"},
    {0xF000, 0x8000, "drive reports that it lost control of torque, speed or position",
     "check the drive's monitoring limits, then reset"},
    {0xF000, 0x9000, "drive reports an external error",
     "see what is wired to the drive's error input, then reset"},
    {0xF000, 0xF000, "drive reports an error of its maker's own numbering",
     "look the code up in the drive's manual, then reset"},
}};

}  // namespace

Trouble error_code_trouble(std::uint16_t code) {
  for (const ErrorWords& words : kErrorWords) {
    if ((code & words.mask) == words.code) {
      return {words.what, words.remedy, code, (code & 0xF000U) == kTemperatures};
    }
  }
  return {"drive reports an error with a code that CiA does not define",
          "look the code up in the drive's manual, then reset", code};
}

bool may_move_zero(std::uint16_t code) {
  constexpr std::uint16_t kVoltages = 0x3000;
  constexpr std::uint16_t kSuppliesOfElectronics = 0x5100;
  constexpr std::uint16_t kSoftwareReset = 0x6010;
  constexpr std::uint16_t kEncoders = 0x7300;
  return (code & 0xF000U) == kVoltages || (code & 0xFF00U) == kSuppliesOfElectronics ||
         (code & 0xFF00U) == kEncoders || code == kSoftwareReset;
}

bool is_host_silent(std::uint16_t code) {
  constexpr std::uint16_t kHeartbeat = 0x8130;
  constexpr std::uint16_t kPdoTimeouts = 0x8250;
  return code == kHeartbeat || (code & 0xFFF0U) == kPdoTimeouts;
}

}  // namespace tactus::drivers::cia402
