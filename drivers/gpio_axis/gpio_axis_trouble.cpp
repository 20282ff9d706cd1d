#include "drivers/gpio_axis/gpio_axis_trouble.h"

#include <array>
#include <string_view>

namespace tactus::drivers {

namespace {

struct TroubleText {
  GpioAxisTrouble trouble;
  std::uint32_t status;
  std::string_view what;
  std::string_view remedy;
};

// After these faults are cleared the encoder counts from zero again.
constexpr std::uint32_t kEncoderLost =
    std::uint32_t{kDeviceEncoderFault} | std::uint32_t{kDeviceReferenceLost};
constexpr std::uint32_t kConnectionLost =
    std::uint32_t{kDeviceLost} | std::uint32_t{kDeviceReferenceLost};

constexpr std::array kTroubleTexts{
    TroubleText{
        GpioAxisTrouble::edges_lost, kEncoderLost, "encoder edges were lost: they come too fast",
        "turn slower, raise the interrupts' priority or use a hardware counter, then reset"},
    TroubleText{GpioAxisTrouble::illegal_transition, kEncoderLost,
                "the encoder's channels changed in a way that cannot be",
                "check the encoder's wiring and shield and max_speed_rad_per_s, then reset"},
    TroubleText{GpioAxisTrouble::levels_disagree, kEncoderLost,
                "the encoder's channels stand otherwise than their edges said",
                "check that both channels' interrupts arrive, then reset"},
    TroubleText{GpioAxisTrouble::index_moved, kEncoderLost,
                "the encoder's index came at another count",
                "check the encoder for dirt, its wiring and counts_per_rev, then reset"},
    TroubleText{GpioAxisTrouble::index_missing, kEncoderLost,
                "more than a turn without the encoder's index",
                "check the index channel's wiring and counts_per_rev, then reset"},
    TroubleText{GpioAxisTrouble::jump, kEncoderLost, "the count moved further than the shaft can",
                "check the encoder's wiring, max_speed_rad_per_s and the host's load, then reset"},
    TroubleText{GpioAxisTrouble::noise, kEncoderLost, "the counter reports noise at its inputs",
                "check the encoder's wiring and shield, then reset"},
    TroubleText{GpioAxisTrouble::silent, kEncoderLost,
                "the motor pushes but the encoder does not move",
                "check the encoder's supply and plug and the motor's, then reset"},
    TroubleText{GpioAxisTrouble::bridge_fault, kDeviceDriveFault,
                "the motor's bridge reports a fault",
                "check the bridge's supply, load and temperature, then reset"},
    TroubleText{GpioAxisTrouble::limits_contradict, kDeviceDriveFault,
                "both limit switches are open",
                "check the wires of the limit switches, then reset"},
    TroubleText{GpioAxisTrouble::emergency_stop, kDeviceEmergencyStop,
                "the emergency stop is open or was", "close the chain, wait a moment, then reset"},
    TroubleText{GpioAxisTrouble::safety_edges_lost, kDeviceEmergencyStop,
                "edges were lost and the emergency stop may be among them",
                "look for a bouncing safety line, then reset"},
    TroubleText{GpioAxisTrouble::lines_gone, kConnectionLost, "the GPIO chip is gone",
                "plug the board in again, then reset"},
    TroubleText{GpioAxisTrouble::lines_fail, kConnectionLost, "the GPIO lines cannot be used",
                "see the error before this: chip, line numbers, other users, rights; then reset"},
    TroubleText{GpioAxisTrouble::pwm_gone, kConnectionLost, "the PWM chip is gone",
                "plug the board in again and restart the controller"},
    TroubleText{GpioAxisTrouble::pwm_fails, kDeviceDriveFault,
                "the PWM output refuses its settings",
                "check pwm_period_ns against the board's manual, then reset"},
    TroubleText{GpioAxisTrouble::counter_gone, kConnectionLost, "the encoder's counter is gone",
                "plug the board in again, then reset"},
    TroubleText{GpioAxisTrouble::counter_fails, kEncoderLost,
                "the encoder's counter cannot be read",
                "check the counter's driver and counter_ceiling, then reset"},
    TroubleText{GpioAxisTrouble::not_configured, kDeviceNotReady,
                "the axis has a value out of its range",
                "bake the device again: its check names the value"},
};

}  // namespace

std::uint32_t status_of(GpioAxisTrouble trouble) {
  for (const TroubleText& text : kTroubleTexts) {
    if (text.trouble == trouble) {
      return text.status;
    }
  }
  return kDeviceOk;
}

Trouble describe(GpioAxisTrouble trouble) {
  for (const TroubleText& text : kTroubleTexts) {
    if (text.trouble == trouble) {
      return {
          .what = text.what, .remedy = text.remedy, .code = static_cast<std::uint32_t>(trouble)};
    }
  }
  return {};
}

}  // namespace tactus::drivers
