// The common part of all emulated CAN drives: faults, delays, power. The same object runs on a
// SimulatedCanBus in a test and on a SocketCAN interface in `tactus emulate`.
//
// It fakes the drive's firmware as the published facts describe it, on a shaft that the caller's
// plant turns. It does not fake the current loop (torque follows the command at once) or the time
// that the firmware takes.
#pragma once

#include <cstdint>
#include <deque>
#include <random>
#include <string_view>

#include "hal/can_bus.h"
#include "hal/clock.h"
#include "host_tools/emulators/shaft.h"

namespace tactus::host {

// The faults that a test or a user may set at any time.
enum class EmulatorFault : std::uint8_t {
  none,
  // The drive hears and obeys, but sends nothing.
  silent,
  // It sends everything kFaultDelay_ns late.
  delayed,
  // A random bit of the payload of every frame that it sends is inverted.
  corrupted,
  // It raises an error of its own, as the real device would report it.
  erroring,
  // It neither hears nor sends, and its motor has no power.
  unplugged,
  // The drive is `unplugged` for kPowerCycle_ns; then it boots and is well.
  power_cycled,
};

// The delay of the fault `delayed`, and how long the power of `power_cycled` is off.
inline constexpr hal::TimeNs kFaultDelay_ns = 10'000'000;
inline constexpr hal::TimeNs kPowerCycle_ns = 300'000'000;
// A drive that has not been run for this time was without power, and boots.
inline constexpr hal::TimeNs kPowerLoss_ns = 20'000'000;

// Returns the fault of a name on the command line, such as "silent". Throws InputError for another
// name.
EmulatorFault emulator_fault(std::string_view name);

// The value that a drive's encoder reads when the drive gets its power.
enum class EmulatedEncoder : std::uint8_t {
  // 0, wherever the shaft stands.
  incremental,
  // The angle within a turn.
  absolute,
  // The angle with its turns: the encoder keeps counting without power.
  multi_turn,
};

// Returns the encoder of a name on the command line, such as "absolute". Throws InputError for
// another name.
EmulatedEncoder emulated_encoder(std::string_view name);

// Returns how many turns of the shaft's position the encoder does not know of when it gets its
// power at `turns`.
double turns_forgotten(EmulatedEncoder encoder, double turns);

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
  void set_fault(EmulatorFault fault) {
    fault_ = fault;
    is_cycling_ = false;
  }
  [[nodiscard]] EmulatorFault fault() const { return fault_; }

 protected:
  // Sends a frame, subject to the fault that is set.
  void send(hal::TimeNs now_ns, const hal::CanFrame& frame);

 private:
  // Handles one frame of the bus, whoever it is for.
  virtual void take(hal::TimeNs now_ns, const hal::CanFrame& frame) = 0;
  // Handles timers and cyclic messages and sets the torque. `erroring` is true as long as that
  // fault lasts.
  virtual void advance(hal::TimeNs now_ns, bool erroring) = 0;

  void send_what_is_due(hal::TimeNs now_ns);
  // Returns false while the fault takes the power away.
  bool has_power(hal::TimeNs now_ns);

  // A frame that waits to be sent.
  struct Waiting {
    hal::TimeNs due_ns = 0;
    hal::CanFrame frame;
  };

  hal::CanBus& bus_;
  EmulatedShaft shaft_;
  EmulatorFault fault_ = EmulatorFault::none;
  bool is_cycling_ = false;
  hal::TimeNs off_until_ns_ = 0;
  std::deque<Waiting> waiting_;
  std::mt19937 random_;
};

}  // namespace tactus::host
