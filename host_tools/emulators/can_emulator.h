// A drive on the far side of a CAN bus: what all emulated drives share. The same object runs on a
// SimulatedCanBus in a test and on a SocketCAN interface in `tactus emulate`.
//
// Fakes: the drive's firmware as its fact sheet tells it, on a shaft that the caller's plant turns.
// Does not fake: the current loop (torque follows the command at once), the firmware's own CPU
// load.
#pragma once

#include <cstdint>
#include <deque>
#include <random>
#include <string_view>

#include "hal/can_bus.h"
#include "hal/clock.h"
#include "host_tools/emulators/shaft.h"

namespace tactus::host {

// The fault port: what may be made to go wrong at any time.
enum class EmulatorFault : std::uint8_t {
  none,
  silent,        // hears and obeys, but sends nothing
  delayed,       // sends everything kFaultDelay_ns late
  corrupted,     // flips a random bit of the payload of every frame that it sends
  erroring,      // raises an error of its own, as the real device reports it
  unplugged,     // neither hears nor sends; its motor has no power
  power_cycled,  // as unplugged for kPowerCycle_ns, then it boots and is well
};

inline constexpr hal::TimeNs kFaultDelay_ns = 10'000'000;
inline constexpr hal::TimeNs kPowerCycle_ns = 300'000'000;
// A drive that has not run for so long was without power and boots.
inline constexpr hal::TimeNs kPowerLoss_ns = 20'000'000;

// "silent" and so on, as the command line takes them. Throws InputError for another.
EmulatorFault emulator_fault(std::string_view name);

// The position of a drive's encoder when it gets its power.
enum class EmulatedEncoder : std::uint8_t {
  incremental,  // 0, wherever the shaft stands
  absolute,     // the angle within a turn
  multi_turn,   // the angle with its turns: an encoder that keeps counting without power
};

// "incremental" and so on, as the command line takes them. Throws InputError for another.
EmulatedEncoder emulated_encoder(std::string_view name);

// The shaft's turns that the encoder does not know of when it gets its power at `turns`.
double turns_forgotten(EmulatedEncoder encoder, double turns);

class CanEmulator {
 public:
  // The bus must outlive the emulator. Every frame on it is offered to `take`.
  CanEmulator(hal::CanBus& bus, std::uint32_t seed) : bus_(bus), random_(seed) {}
  CanEmulator(const CanEmulator&) = delete;
  CanEmulator& operator=(const CanEmulator&) = delete;
  virtual ~CanEmulator() = default;

  // Takes what has arrived, does what is due, sends what is ready, and leaves the motor's torque in
  // shaft(). Call it at least once a millisecond, better ten times.
  void run(hal::TimeNs now_ns);

  EmulatedShaft& shaft() { return shaft_; }
  [[nodiscard]] const EmulatedShaft& shaft() const { return shaft_; }

  void set_fault(EmulatorFault fault) {
    fault_ = fault;
    is_cycling_ = false;
  }
  [[nodiscard]] EmulatorFault fault() const { return fault_; }

 protected:
  void send(hal::TimeNs now_ns, const hal::CanFrame& frame);

 private:
  virtual void take(hal::TimeNs now_ns, const hal::CanFrame& frame) = 0;
  // Timers, cyclic messages and the torque; `erroring` is true in the runs under that fault.
  virtual void advance(hal::TimeNs now_ns, bool erroring) = 0;

  void send_what_is_due(hal::TimeNs now_ns);
  bool has_power(hal::TimeNs now_ns);

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
