// A recorded tick: the controller's record, and the times and motor values of the loop around it.
// Plain data, copied as bytes.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "drivers/device.h"
#include "firmware/telemetry/record.h"

namespace tactus::firmware {

// The times of a tick, ns of CLOCK_MONOTONIC. In a simulation scheduled_ns is simulated time and
// the others are 0.
struct LoopTimes {
  // The time at which the tick was due.
  std::int64_t scheduled_ns = 0;
  // The time at which the loop woke for it.
  std::int64_t woke_ns = 0;
  // The time at which the device's write had returned.
  std::int64_t done_ns = 0;
  // The time at which the first joint's encoder was sampled.
  std::int64_t sample_ns = 0;

  // Return how late the loop woke, and how long the tick took, ns.
  [[nodiscard]] std::int64_t wake_latency_ns() const { return between(scheduled_ns, woke_ns); }
  [[nodiscard]] std::int64_t busy_ns() const { return between(woke_ns, done_ns); }

 private:
  // Unsigned arithmetic, because a damaged recording may hold any numbers.
  static std::int64_t between(std::int64_t from_ns, std::int64_t to_ns) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(to_ns) -
                                     static_cast<std::uint64_t>(from_ns));
  }
};

// The item that goes through the ring to recordings and readers.
struct RecordedTick {
  TelemetryRecord record;
  LoopTimes loop;
  // The angles of the encoders' shafts, rad.
  std::array<double, drivers::kMaxJoints> shaft_rad{};
  // The torques commanded at the motors' shafts, N m.
  std::array<double, drivers::kMaxJoints> torque_Nm{};
  // The number of joints that the device has.
  std::uint32_t joint_count = 0;
  // The number of ticks that were dropped before this one because the ring was full.
  std::uint64_t dropped = 0;
};
static_assert(std::is_trivially_copyable_v<RecordedTick>);

}  // namespace tactus::firmware
