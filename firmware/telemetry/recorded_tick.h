// A recorded tick: the controller's record, and the times and motor values of the loop around it.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "drivers/device.h"
#include "firmware/telemetry/record.h"

namespace tactus::firmware {

// Times of a tick, ns of CLOCK_MONOTONIC. In a simulation scheduled_ns is simulated time and the
// others are 0.
struct LoopTimes {
  std::int64_t scheduled_ns = 0;  // when the tick was due
  std::int64_t woke_ns = 0;       // when the loop woke for it
  std::int64_t done_ns = 0;       // when the device's write had returned
  std::int64_t sample_ns = 0;     // when the first joint's encoder was sampled

  [[nodiscard]] std::int64_t wake_latency_ns() const { return between(scheduled_ns, woke_ns); }
  [[nodiscard]] std::int64_t busy_ns() const { return between(woke_ns, done_ns); }

 private:
  // Unsigned arithmetic, because a damaged recording may hold any numbers.
  static std::int64_t between(std::int64_t from_ns, std::int64_t to_ns) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(to_ns) -
                                     static_cast<std::uint64_t>(from_ns));
  }
};

struct RecordedTick {
  TelemetryRecord record;
  LoopTimes loop;
  std::array<double, drivers::kMaxJoints> shaft_rad{};  // angles of the encoders' shafts
  std::array<double, drivers::kMaxJoints> torque_Nm{};  // commanded at the motors' shafts
  std::uint32_t joint_count = 0;                        // joints that the device has
  std::uint64_t dropped = 0;  // ticks dropped before this one because the ring was full
};
static_assert(std::is_trivially_copyable_v<RecordedTick>);

}  // namespace tactus::firmware
