// The places of the objects that move, for live displays. Plain data, copied as bytes. Recordings
// do not have it: a replay computes the places again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/telemetry/record.h"
#include "rendering/limits.h"

namespace tactus::firmware {

// A quaternion: w, x, y, z.
using Quadruple = std::array<double, 4>;

// The pose of an object's own frame O in the world.
struct ObjectPlace {
  // The object's number in the scene.
  std::uint32_t object = 0;
  // The origin of O, m, and the rotation that takes directions in O to the world.
  Triple origin_W{};
  Quadruple rotation_W{1.0, 0.0, 0.0, 0.0};

  bool operator==(const ObjectPlace&) const = default;
};

// The places in one tick: the first `count`.
struct ObjectPlaces {
  // The number of the tick.
  std::uint64_t tick = 0;
  // LoopTimes::scheduled_ns of the tick.
  std::int64_t time_ns = 0;
  std::uint32_t count = 0;
  std::array<ObjectPlace, rendering::kMaxMovers> places{};
};
static_assert(std::is_trivially_copyable_v<ObjectPlaces>);

}  // namespace tactus::firmware
