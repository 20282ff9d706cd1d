#include "drivers/vesc_can/vesc_faults.h"

#include <array>
#include <cstddef>

namespace tactus::drivers::vesc {

namespace {

struct VescFault {
  std::string_view what;
  std::string_view remedy;
};

constexpr std::string_view kSupply = "check the supply and its wiring, then reset";
constexpr std::string_view kCurrents =
    "check the motor's phases and the current limits, then reset";
constexpr std::string_view kCool = "let it cool down and lower the current, then reset";
constexpr std::string_view kSensor = "check the encoder's cable, magnet and supply, then reset";
constexpr std::string_view kService = "switch it off and on; if it comes again, repair the VESC";
constexpr std::string_view kSettings = "write the settings anew with VESC Tool";
constexpr std::string_view kSpeed = "check the motor's settings in VESC Tool, then reset";

constexpr std::array kVescFaults = std::to_array<VescFault>({
    {"", ""},
    {"VESC reports too high a supply voltage", kSupply},
    {"VESC reports too low a supply voltage", kSupply},
    {"VESC reports a fault of its gate driver (DRV)", kCurrents},
    {"VESC reports an absolute over-current", kCurrents},
    {"VESC reports that its transistors are too hot", kCool},
    {"VESC reports that the motor is too hot", kCool},
    {"VESC reports too high a voltage of its gate driver", kService},
    {"VESC reports too low a voltage of its gate driver", kService},
    {"VESC reports too low a voltage of its processor", kSupply},
    {"VESC booted after its own watchdog had expired", kService},
    {"VESC reports a fault of the encoder's SPI bus", kSensor},
    {"VESC reports too small an amplitude of the sine-cosine encoder", kSensor},
    {"VESC reports too large an amplitude of the sine-cosine encoder", kSensor},
    {"VESC reports corrupt flash memory", kService},
    {"VESC reports too large an offset of current sensor 1", kService},
    {"VESC reports too large an offset of current sensor 2", kService},
    {"VESC reports too large an offset of current sensor 3", kService},
    {"VESC reports unbalanced phase currents", kCurrents},
    {"VESC reports a fault at its brake input (BRK)", kService},
    {"VESC reports that the resolver lost tracking", kSensor},
    {"VESC reports a degraded resolver signal", kSensor},
    {"VESC reports a lost resolver signal", kSensor},
    {"VESC reports corrupt application settings", kSettings},
    {"VESC reports corrupt motor settings", kSettings},
    {"VESC reports that the encoder finds no magnet", kSensor},
    {"VESC reports that the encoder's magnet is too strong", kSensor},
    {"VESC reports a fault of its phase filter", kService},
    {"VESC reports a fault of the encoder", kSensor},
    {"VESC reports a fault of its low-voltage output", kService},
    {"VESC reports that the encoder slips", kSensor},
    {"VESC reports too high a speed", kSpeed},
    {"VESC reports too low a speed", kSpeed},
    {"VESC reports an absolute over-speed", kSpeed},
});

}  // namespace

Trouble fault_trouble(std::uint8_t code) {
  if (static_cast<std::size_t>(code) < kVescFaults.size()) {
    const VescFault& fault = kVescFaults[code];
    return {fault.what, fault.remedy, code, fault.remedy == kCool};
  }
  return {"VESC reports a fault that this driver does not know",
          "look the number up in VESC Tool, then reset", code};
}

bool loses_reference(std::uint8_t code) {
  constexpr std::uint8_t kUnderVoltage = 2;
  constexpr std::uint8_t kProcessorUnderVoltage = 9;
  constexpr std::uint8_t kBootedByWatchdog = 10;
  const bool is_sensor =
      static_cast<std::size_t>(code) < kVescFaults.size() && kVescFaults[code].remedy == kSensor;
  return code == kUnderVoltage || code == kProcessorUnderVoltage || code == kBootedByWatchdog ||
         is_sensor;
}

}  // namespace tactus::drivers::vesc
