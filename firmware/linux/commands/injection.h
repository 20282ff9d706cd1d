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

enum class Injection : std::uint8_t {
  drop,        // the last sample again, with a growing age
  stuck,       // the last positions again, with the age of a fresh sample
  jump,        // the first joint's position plus kInjectedJump
  nan,         // the first joint's position is not a number
  encoder,     // the device reports an encoder fault
  drive,       // the device reports a motor drive fault
  estop_line,  // the device reports an open emergency stop line
  lost,        // the device reports that it cannot reach the motors
  not_ready,   // the device reports that it has lost its reference
  delay        // the tick is late by `ticks` periods
};

struct InjectionText {
  Injection injection;
  std::string_view name;
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

inline constexpr double kInjectedJump = 0.1;  // rad or m
inline constexpr std::uint32_t kMaxInjectedTicks = 100'000;
// The largest delay in periods. It is smaller because a delay stops the loop.
inline constexpr std::uint32_t kMaxInjectedDelay = 100;

struct InjectionOrder {
  Injection injection = Injection::drop;
  std::uint32_t ticks = 1;  // how many ticks it lasts; the periods of a `delay`
};

class Injector {
 public:
  // Injects from the next tick on. Injections of other kinds that are active continue.
  void start(const InjectionOrder& order);

  // Changes the device's sample as the active injections say. Call once per tick.
  void change(drivers::JointSample& sample, double rate_hz);

  // Returns by how many periods this tick is to be late, and clears that number.
  std::uint32_t take_delay();

 private:
  std::array<std::uint32_t, kInjectionTexts.size()> left_{};
  drivers::JointSample last_;
  double age_s_ = 0.0;
};

// A device whose samples pass an injector.
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
