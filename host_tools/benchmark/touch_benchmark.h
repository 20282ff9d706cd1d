// Times the touch of objects, tick by tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>

#include "rendering/objects/object.h"

namespace tactus::host {

// The times of the ticks of a path. All but the last two are the least over all runs.
struct TouchTiming {
  // The number of ticks of the path, and percentiles of their times.
  std::size_t ticks = 0;
  double median_ns = 0.0;
  double p99_ns = 0.0;
  double p999_ns = 0.0;
  double max_ns = 0.0;
  // Percentile and maximum of the last run alone, with everything that interrupted it.
  double once_p999_ns = 0.0;
  double once_max_ns = 0.0;
  // Ticks in which the tool touched something.
  std::size_t contact_ticks = 0;
  // Ticks in which the touch raised a flag.
  std::size_t flagged_ticks = 0;
  // The largest number of triangles cached near the tool.
  std::size_t peak_candidates = 0;
};

// Touches the objects with a tool that follows `path` (m, world frame): first up to 1000 ticks for
// warming up, then in `runs` runs, at least 1, that do the same in every tick. A tick's time is the
// smallest over the runs, since interruptions hit other ticks in each run. Reading the clock costs
// about 20 ns a tick, which is included.
TouchTiming time_touch(std::span<const rendering::Object> objects, double tool_radius_m,
                       std::span<const Vec3> path, std::size_t runs);

// Percentiles of the times of single ticks, each measured once.
struct SingleTimes {
  double median_ns = 0.0;
  double p999_ns = 0.0;
};

// The preparation of a tick whose time is measured.
enum class Before : std::uint8_t {
  sleep,       // until the next millisecond, as a loop at 1 kHz
  cold_cache,  // other memory has been read, so that code and state have to be fetched
};

// Touches the objects with a tool that follows `path` (m, world frame), each tick after the
// preparation. Takes about a millisecond a tick.
SingleTimes time_single_ticks(std::span<const rendering::Object> objects, double tool_radius_m,
                              std::span<const Vec3> path, Before before);

// The lateness of ticks with the usual budget, against ticks without a limit that begin in the same
// state.
struct Lateness {
  // The ticks that leave the proxy more than kLate_m from where one without a limit would.
  std::size_t late_ticks = 0;
  // The largest distance between them, m, and the largest angle between their forces, rad.
  double worst_m = 0.0;
  double worst_turn_rad = 0.0;
  // The longest series of late ticks: so many it takes at most until the proxy is where one without
  // a limit would put it.
  std::size_t in_a_row = 0;
  // The late ticks whose force has an angle of more than kTurned_rad to the one without a limit.
  std::size_t turned_ticks = 0;
};
inline constexpr double kLate_m = 1e-6;
inline constexpr double kTurned_rad = std::numbers::pi / 6.0;

// Touches the objects with a tool that follows `path` (m, world frame) in two worlds, of which the
// one without a limit takes the state of the other after every late tick. `tick_instructions` takes
// the place of the usual budget of a tick; it must be > 0 (World::set_tick_budget). An angle counts
// only where both forces are other than zero.
Lateness lateness_of(std::span<const rendering::Object> objects, double tool_radius_m,
                     std::span<const Vec3> path,
                     std::optional<double> tick_instructions = std::nullopt);

}  // namespace tactus::host
