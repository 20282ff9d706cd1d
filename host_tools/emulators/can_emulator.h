// The common part of all emulated CAN drives: faults, delays, power. The same object runs on a
// SimulatedCanBus in a test and on a SocketCAN interface in `tactus emulate`.
//
// It fakes the drive's firmware as the published facts describe it, on a shaft that the caller's
// plant turns. It does not fake the current loop (torque follows the command at once) or the time
// that the firmware takes.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>

#include "hal/can_bus.h"
#include "hal/clock.h"
#include "host_tools/emulators/emulator_fault.h"
#include "host_tools/emulators/shaft.h"

namespace tactus::host {

// A drive that has not been run for this time was without power, and boots.
inline constexpr hal::TimeNs kPowerLoss_ns = 20'000'000;

// One run of a drive that has power.
struct DriveRun {
  hal::TimeNs now_ns = 0;
  // The time since the run before; empty in the first run.
  std::optional<hal::TimeNs> gap_ns;
  // True as long as the fault `erroring` lasts, and true in the run in which it begins.
  bool erroring = false;
  bool error_begins = false;

  [[nodiscard]] bool is_first() const { return !gap_ns.has_value(); }
  // Returns true if the drive was without power before this run; `loss_ns` is the gap that shows
  // it.
  [[nodiscard]] bool follows_power_loss(hal::TimeNs loss_ns = kPowerLoss_ns) const {
    return gap_ns.has_value() && *gap_ns >= loss_ns;
  }
};

// A drive on a bus. Each kind of drive derives from it and implements take() and advance(). One
// thread.
class CanEmulator {
 public:
  // The bus must outlive the emulator. Every frame on it is given to take(). `seed` chooses the
  // bits that `corrupted` inverts.
  CanEmulator(hal::CanBus& bus, std::uint32_t seed) : bus_(bus), random_(seed) {}
  CanEmulator(const CanEmulator&) = delete;
  CanEmulator& operator=(const CanEmulator&) = delete;
  virtual ~CanEmulator() = default;

  // Handles the frames that have arrived, does what is due, sends what is ready, and leaves the
  // motor's torque in shaft(). Call it at least once a millisecond, better ten times.
  void run(hal::TimeNs now_ns);

  // The motor's shaft: the plant writes position and velocity before run(), and reads the torque
  // after it.
  EmulatedShaft& shaft() { return shaft_; }
  [[nodiscard]] const EmulatedShaft& shaft() const { return shaft_; }

  // Sets the fault from now on; `none` heals.
  void set_fault(EmulatorFault fault) { fault_.set(fault); }
  [[nodiscard]] EmulatorFault fault() const { return fault_.kind(); }

 protected:
  // Sends a frame, subject to the fault that is set.
  void send(hal::TimeNs now_ns, const hal::CanFrame& frame);

 private:
  // Handles one frame of the bus, whoever it is for.
  virtual void take(hal::TimeNs now_ns, const hal::CanFrame& frame) = 0;
  // Handles timers and cyclic messages and sets the torque.
  virtual void advance(const DriveRun& run) = 0;

  // Returns this run, and remembers it for the next one.
  DriveRun begin_run(hal::TimeNs now_ns);
  void send_what_is_due(hal::TimeNs now_ns);

  // A frame that waits to be sent.
  struct Waiting {
    hal::TimeNs due_ns = 0;
    hal::CanFrame frame;
  };

  hal::CanBus& bus_;
  EmulatedShaft shaft_;
  ActiveFault fault_;
  // The last run with power; empty before the first.
  std::optional<DriveRun> last_run_;
  std::deque<Waiting> waiting_;
  std::mt19937 random_;
};

}  // namespace tactus::host
