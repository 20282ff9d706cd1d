// An encoder, a bridge with a motor, switches and an emergency stop, on the pins of a board: the
// far side of drivers/gpio_axis. The same object runs on a SimulatedGpioChip in a test and on
// gpio-sim in the emulated machine.
//
// Fakes: a quadrature encoder with an index pulse of one state, the bridge's law, an enable that
// needs the chain closed and, if wired, a heartbeat (a monostable of kHeartbeat_ns), the fault
// output, switches.
// Does not fake: bounce, the motor's current loop and inductance (torque follows the duty at once),
// the PWM waveform (its mean is read), the brake's grip (ask brake_is_closed).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>

#include "drivers/gpio_axis/gpio_axis_config.h"
#include "hal/clock.h"
#include "host_tools/emulators/board_pins.h"
#include "host_tools/emulators/can_emulator.h"
#include "host_tools/emulators/shaft.h"

namespace tactus::host {

// The meaning of each EmulatorFault here:
//   silent     the encoder's plug is out: its lines stay as they are. When it is plugged in again
//              the lines jump to where the shaft is by then
//   delayed    the encoder's lines follow kFaultDelay_ns late. The driver cannot tell a late
//              encoder from a late hand: this fault is not detected
//   corrupted  now and then both channels change at once
//   erroring   the bridge reports a fault, if the line is wired, and gives no torque
//   power_cycled  encoder and bridge are without power for kPowerCycle_ns: the encoder's lines
//              stay, then they jump to where the shaft is by then
//   unplugged  the GPIO chip is gone, for good; no torque
class GpioAxisEmulator {
 public:
  static constexpr hal::TimeNs kHeartbeat_ns = 10'000'000;

  // `axis` as the driver has it: the emulator is wired to the same pins. It drives the encoder at
  // most `steps_per_run` counts further in one run: 1 where time stands still during a run, or both
  // channels would change at once. The pins must outlive it.
  GpioAxisEmulator(const drivers::GpioAxisConfig& axis, BoardPins& pins, std::uint32_t seed,
                   std::uint32_t steps_per_run = 1);

  // Moves the lines to where the shaft is, and leaves the motor's torque in shaft(). Call it at
  // least as often as the encoder has edges.
  void run(hal::TimeNs now_ns);

  EmulatedShaft& shaft() { return shaft_; }
  [[nodiscard]] const EmulatedShaft& shaft() const { return shaft_; }

  void set_fault(EmulatorFault fault);
  [[nodiscard]] EmulatorFault fault() const { return fault_; }

  // The contacts. The chain is closed and the switches are free at first.
  void open_emergency_stop(bool open);
  void open_limit_low(bool open);
  void open_limit_high(bool open);

  [[nodiscard]] bool brake_is_closed();
  // Returns the position that the encoder's lines show, in counts.
  [[nodiscard]] std::int64_t count() const { return count_; }

 private:
  void drive(const std::optional<drivers::InputPin>& pin, bool active);
  [[nodiscard]] bool is_active(const std::optional<drivers::OutputPin>& pin);
  [[nodiscard]] std::int64_t wanted_count() const;
  void move_encoder();
  void show(std::int64_t count);
  void watch_heartbeat(hal::TimeNs now_ns);
  void follow_power(hal::TimeNs now_ns);
  [[nodiscard]] double motor_torque(hal::TimeNs now_ns);

  drivers::GpioAxisConfig axis_;
  BoardPins& pins_;
  std::mt19937 random_;
  std::uint32_t steps_per_run_;
  EmulatedShaft shaft_;
  EmulatorFault fault_ = EmulatorFault::none;
  std::int64_t count_ = 0;
  struct Past {
    hal::TimeNs time_ns = 0;
    double position_rad = 0.0;
  };
  std::deque<Past> past_;
  hal::TimeNs beat_ns_ = 0;
  bool beat_level_ = false;
  bool chain_open_ = false;
  hal::TimeNs off_until_ns_ = 0;  // in power_cycled; 0: not begun
  bool is_off_ = false;
};

}  // namespace tactus::host
