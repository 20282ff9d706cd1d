// An encoder, a bridge with a motor, switches and an emergency stop on the pins of a board, as
// drivers/gpio_axis sees them. The same object runs on a SimulatedGpioChip in a test and on
// gpio-sim in `tactus emulate paddle`.
//
// It fakes a quadrature encoder with an index pulse of one state, the bridge's law, an enable that
// needs the chain closed and, if wired, a heartbeat (a monostable of kHeartbeat_ns), the fault
// output, and switches. It does not fake bounce, the motor's current loop and inductance (torque
// follows the duty at once), the PWM waveform (its mean is read), and the brake's grip (see
// brake_is_closed()).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>

#include "drivers/gpio_axis/gpio_axis_config.h"
#include "hal/clock.h"
#include "host_tools/emulators/board_pins.h"
#include "host_tools/emulators/emulator_fault.h"
#include "host_tools/emulators/shaft.h"

namespace tactus::host {

// One axis. The faults mean here:
// - silent: the encoder's plug is out and its lines stay as they are. When it is plugged in again,
//   they jump to where the shaft is by then.
// - delayed: the encoder's lines follow kFaultDelay_ns late. The driver cannot tell a late encoder
//   from a late hand, so it does not detect this fault.
// - corrupted: both channels change at once now and then.
// - erroring: the bridge gives no torque, and reports a fault if the line is wired.
// - power_cycled: encoder and bridge have no power for kPowerCycle_ns. The encoder's lines stay,
// and
//   then jump to where the shaft is by then.
// - unplugged: the GPIO chip is gone for good, and there is no torque.
class GpioAxisEmulator {
 public:
  // How long one edge of the heartbeat keeps the bridge enabled.
  static constexpr hal::TimeNs kHeartbeat_ns = 10'000'000;

  // `axis` is the driver's configuration: the emulator is wired to the same pins, which must
  // outlive it. In one run the encoder moves by at most `steps_per_run` counts. It must be 1 where
  // the driver cannot look during a run, or both channels would change at once.
  GpioAxisEmulator(const drivers::GpioAxisConfig& axis, BoardPins& pins, std::uint32_t seed,
                   std::uint32_t steps_per_run = 1);

  // Moves the lines to where the shaft is, and leaves the motor's torque in shaft(). Call it at
  // least as often as the encoder has edges.
  void run(hal::TimeNs now_ns);

  EmulatedShaft& shaft() { return shaft_; }
  [[nodiscard]] const EmulatedShaft& shaft() const { return shaft_; }

  void set_fault(EmulatorFault fault);
  [[nodiscard]] EmulatorFault fault() const { return fault_.kind(); }

  // Open or close the contacts. At first the chain is closed and no limit switch is open.
  void open_emergency_stop(bool open);
  void open_limit_low(bool open);
  void open_limit_high(bool open);

  // Returns true if the brake is wired and has no power to release it.
  [[nodiscard]] bool brake_is_closed();
  // Returns the position that the encoder's lines show, counts.
  [[nodiscard]] std::int64_t count() const { return encoder_.count; }

 private:
  // A position of the shaft and its time.
  struct Past {
    hal::TimeNs time_ns = 0;
    double position_rad = 0.0;
  };
  // The encoder between two runs.
  struct Encoder {
    // The most counts that it moves by in one run.
    std::uint32_t steps_per_run = 1;
    // The count that its lines show.
    std::int64_t count = 0;
    // The positions of the last kFaultDelay_ns, for the fault `delayed`.
    std::deque<Past> past;
  };
  // The heartbeat's last edge and the level after it.
  struct Heartbeat {
    hal::TimeNs edge_ns = 0;
    bool level = false;
  };

  // Drives a line to its active or inactive level; does nothing if the axis has no such line.
  void drive(const std::optional<drivers::InputPin>& pin, bool active);
  // Returns true if the controller drives the line to its active level.
  [[nodiscard]] bool is_active(const std::optional<drivers::OutputPin>& pin);
  // Returns the counts that belong to the shaft's position, late under the fault `delayed`.
  [[nodiscard]] std::int64_t wanted_count() const;
  // Moves the encoder toward the shaft's count, as far as it moves in one run.
  void move_encoder();
  // Drives the encoder's lines to the state of a count.
  void show(std::int64_t count);
  // Notes the time of each edge of the heartbeat.
  void watch_heartbeat(hal::TimeNs now_ns);
  // Switches the axis off for a power cycle. The encoder has no count while it is off.
  void follow_power(hal::TimeNs now_ns);
  // Returns the torque on the shaft, N m, from the lines that the controller drives.
  [[nodiscard]] double motor_torque(hal::TimeNs now_ns);

  drivers::GpioAxisConfig axis_;
  BoardPins& pins_;
  std::mt19937 random_;
  EmulatedShaft shaft_;
  ActiveFault fault_;
  Encoder encoder_;
  Heartbeat heartbeat_;
  bool chain_open_ = false;
  // True while a power cycle keeps the power off.
  bool is_off_ = false;
};

}  // namespace tactus::host
