// The faults of emulated devices, and what they do alike in each of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string_view>

#include "hal/clock.h"

namespace tactus::host {

// The faults that a test or a user may set at any time.
enum class EmulatorFault : std::uint8_t {
  none,
  // The device hears and obeys, but sends nothing.
  silent,
  // It sends everything kFaultDelay_ns late.
  delayed,
  // A random bit of the payload of every message that it sends is inverted.
  corrupted,
  // It raises an error of its own, as the real device would report it.
  erroring,
  // It neither hears nor sends, and its motor has no power.
  unplugged,
  // The device is `unplugged` for kPowerCycle_ns; then it boots and is well.
  power_cycled,
};

// The delay of the fault `delayed`, and how long the power of `power_cycled` is off.
inline constexpr hal::TimeNs kFaultDelay_ns = 10'000'000;
inline constexpr hal::TimeNs kPowerCycle_ns = 300'000'000;

// Returns the fault of a name on the command line, such as "silent". Throws InputError for another
// name.
EmulatorFault emulator_fault(std::string_view name);

// The fault that a device has now.
class ActiveFault {
 public:
  // Sets the fault from now on; `none` heals.
  void set(EmulatorFault fault);
  [[nodiscard]] EmulatorFault kind() const { return kind_; }
  [[nodiscard]] bool is(EmulatorFault fault) const { return kind_ == fault; }

  // Returns false while the device is unplugged or in a power cycle. The cycle begins with the
  // first call after set().
  bool has_power(hal::TimeNs now_ns);
  // Returns how much later than a well device it sends, ns.
  [[nodiscard]] hal::TimeNs delay_ns() const {
    return is(EmulatorFault::delayed) ? kFaultDelay_ns : 0;
  }

 private:
  EmulatorFault kind_ = EmulatorFault::none;
  // The end of a power cycle; empty if none has begun.
  std::optional<hal::TimeNs> off_until_ns_;
};

// Inverts one bit of a message, as a disturbance that no checksum finds would. The message has at
// least one byte.
void flip_a_bit(std::span<std::byte> bytes, std::mt19937& random);

}  // namespace tactus::host
