// Injects faults for tests and drills: it changes the sample between device and controller. The
// controller does not know, so its guards have to find the fault. The record holds the changed
// sample, so a replay repeats it.
//
// Only the loop's thread uses it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/device.h"
#include "firmware/telemetry/stopwatch.h"

namespace tactus::firmware {

// The faults that can be injected. README.md has the table for users.
enum class Injection : std::uint8_t {
  // The last sample again, with a growing age.
  drop,
  // The last positions again, with the age of a fresh sample.
  stuck,
  // The first joint's position plus kInjectedJump.
  jump,
  // The first joint's position is not a number.
  nan,
  // The device reports an encoder fault.
  encoder,
  // The device reports a motor drive fault.
  drive,
  // The device reports an open emergency stop line.
  estop_line,
  // The device reports that it cannot reach the motors.
  lost,
  // The device reports that it has lost its reference.
  not_ready,
  // The tick is late by `ticks` periods.
  delay
};

// The texts of a fault.
struct InjectionText {
  Injection injection;
  // The word of the `inject` command.
  std::string_view name;
  // The meaning for people.
  std::string_view meaning;
};

// The names and meanings, in the order of Injection.
inline constexpr auto kInjectionTexts = std::to_array<InjectionText>({
    {Injection::drop, "drop", "no fresh sample: the last one again, growing old"},
    {Injection::stuck, "stuck", "the last position again, and nobody says so"},
    {Injection::jump, "jump", "the first joint stands 0.1 rad or m farther"},
    {Injection::nan, "nan", "the first joint's position is not a number"},
    {Injection::encoder, "encoder", "the device reports an encoder fault"},
    {Injection::drive, "drive", "the device reports a motor drive fault"},
    {Injection::estop_line, "estop_line", "the emergency stop line is open"},
    {Injection::lost, "lost", "no way to reach the motors"},
    {Injection::not_ready, "not_ready", "the device has lost its reference"},
    {Injection::delay, "delay", "the tick is late by so many periods"},
});

// The size of a jump, rad or m.
inline constexpr double kInjectedJump = 0.1;
// The longest injection in ticks.
inline constexpr std::uint32_t kMaxInjectedTicks = 100'000;
// The largest delay in periods. It is smaller because a delay stops the loop.
inline constexpr std::uint32_t kMaxInjectedDelay = 100;

// A fault to inject.
struct InjectionOrder {
  Injection injection = Injection::drop;
  // The number of ticks that it lasts, or the periods of a `delay`.
  std::uint32_t ticks = 1;
};

// The faults that are active now.
class Injector {
 public:
  // Injects from the next tick on. Injections of other kinds that are active continue.
  void start(const InjectionOrder& order);

  // Changes the device's sample as the active injections say. `rate_hz` is the loop's rate. Call
  // once per tick.
  void change(drivers::JointSample& sample, double rate_hz);

  // Returns by how many periods this tick is to be late, and clears that number.
  std::uint32_t take_delay();

 private:
  // The number of ticks left of each kind.
  std::array<std::uint32_t, kInjectionTexts.size()> left_{};
  // The last sample before `drop` or `stuck`.
  drivers::JointSample last_;
  // The time since that sample, s.
  double age_s_ = 0.0;
};

// A device whose samples pass an injector. It has the functions of a drivers::Device. Device,
// injector and clock must outlive it; without a clock there are no delays.
template <drivers::Device D>
class InjectedDevice {
 public:
  InjectedDevice(D& device, Injector& injector, double rate_hz, NowNs now_ns)
      : device_(device), injector_(injector), rate_hz_(rate_hz), now_ns_(now_ns) {}

  [[nodiscard]] std::size_t joint_count() const { return device_.joint_count(); }
  void clear_faults() { device_.clear_faults(); }
  std::uint32_t write(const drivers::JointCommand& command) { return device_.write(command); }

  void read(drivers::JointSample& sample) {
    hold(injector_.take_delay());
    device_.read(sample);
    injector_.change(sample, rate_hz_);
  }

 private:
  // Busy-waits for so many periods, like a tick that takes too long.
  void hold(std::uint32_t periods) {
    if (periods == 0 || now_ns_ == nullptr) {
      return;
    }
    const auto wait_ns = static_cast<std::uint64_t>(1e9 / rate_hz_ * periods);
    const std::uint64_t start_ns = now_ns_();
    while (now_ns_() - start_ns < wait_ns) {
    }
  }

  D& device_;
  Injector& injector_;
  double rate_hz_;
  NowNs now_ns_;
};

}  // namespace tactus::firmware
