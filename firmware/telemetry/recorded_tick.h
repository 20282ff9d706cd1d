// A tick as it is recorded: what the controller did, and when and with what the loop around it ran.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "drivers/device.h"
#include "firmware/telemetry/record.h"

namespace tactus::firmware {

// ns of CLOCK_MONOTONIC; in a simulation, of the simulated time, all but `scheduled_ns` zero.
struct LoopTimes {
  std::int64_t scheduled_ns = 0;  // when the tick was due
  std::int64_t woke_ns = 0;
  std::int64_t done_ns = 0;    // after the write
  std::int64_t sample_ns = 0;  // of the first joint's encoder

  [[nodiscard]] std::int64_t wake_latency_ns() const { return between(scheduled_ns, woke_ns); }
  [[nodiscard]] std::int64_t busy_ns() const { return between(woke_ns, done_ns); }

 private:
  // Whatever a damaged recording says.
  static std::int64_t between(std::int64_t from_ns, std::int64_t to_ns) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(to_ns) -
                                     static_cast<std::uint64_t>(from_ns));
  }
};

struct RecordedTick {
  TelemetryRecord record;
  LoopTimes loop;
  std::array<double, drivers::kMaxJoints> shaft_rad{};  // of the encoders
  std::array<double, drivers::kMaxJoints> torque_Nm{};  // commanded at the motors' shafts
  std::uint32_t joint_count = 0;                        // joints that the device has
  std::uint64_t dropped = 0;  // ticks that found no room in the ring before this one
};
static_assert(std::is_trivially_copyable_v<RecordedTick>);

}  // namespace tactus::firmware
