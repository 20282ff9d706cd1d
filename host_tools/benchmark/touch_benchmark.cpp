#include "host_tools/benchmark/touch_benchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "host_tools/benchmark/percentile.h"
#include "rendering/state_archive.h"
#include "rendering/world/world.h"

namespace tactus::host {
namespace {

using Clock = std::chrono::steady_clock;

// Returns the time of one touch, ns, with one reading of the clock in it.
double nanoseconds_of(rendering::World& world, const Vec3& p, rendering::Touch& touch) {
  const Clock::time_point start = Clock::now();
  touch = world.touch({.p_W = p});
  const Clock::time_point end = Clock::now();
  return std::chrono::duration<double, std::nano>(end - start).count();
}

// The most bytes of a world's state.
constexpr std::size_t kMostStateBytes = std::size_t{1} << 22;

// Gives `to`, which has the same scene, the state of `from`.
void copy_state(rendering::World& from, rendering::World& to, std::span<std::byte> room) {
  auto writer = rendering::StateArchive::writer(room);
  from.transfer(writer);
  auto reader = rendering::StateArchive::reader(room.first(writer.size()));
  to.transfer(reader);
  if (!writer.good() || !reader.good()) {
    throw std::logic_error("a world's state cannot be copied");
  }
}

// Returns the angle between two vectors, rad; 0 if one of them is zero.
double angle_between(const Vec3& a, const Vec3& b) {
  const double lengths = a.norm() * b.norm();
  return lengths > 0.0 ? std::acos(std::clamp(a.dot(b) / lengths, -1.0, 1.0)) : 0.0;
}

// Sleeps until the next whole period after the last wake-up.
class Pace {
 public:
  void wait() {
    constexpr std::chrono::milliseconds kPeriod{1};
    next_ = std::max(next_ + kPeriod, Clock::now());
    std::this_thread::sleep_until(next_);
  }

 private:
  Clock::time_point next_ = Clock::now();
};

// Reads memory that no tick uses, and so takes the ticks' own out of the first two levels of cache.
class OtherMemory {
 public:
  void read() {
    constexpr std::size_t kLine = 64;
    for (std::size_t i = 0; i < bytes_.size(); i += kLine) {
      sum_ = sum_ + bytes_[i];
    }
  }

 private:
  std::vector<unsigned char> bytes_ = std::vector<unsigned char>(std::size_t{1} << 23, 1);
  // Volatile, so that the reading is done.
  volatile unsigned sum_ = 0;
};

}  // namespace

TouchTiming time_touch(std::span<const rendering::Object> objects, double tool_radius_m,
                       std::span<const Vec3> path, std::size_t runs) {
  const auto world = std::make_unique<rendering::World>();
  world->set_scene(objects, {.tool_radius_m = tool_radius_m});
  for (const Vec3& p : path.first(std::min<std::size_t>(path.size(), 1000))) {
    world->touch({.p_W = p});
  }
  TouchTiming timing{.ticks = path.size()};
  std::vector<double> least(path.size(), std::numeric_limits<double>::infinity());
  std::vector<double> once(path.size());
  for (std::size_t run = 0; run < runs; ++run) {
    world->reset();
    timing.contact_ticks = 0;
    timing.flagged_ticks = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      rendering::Touch touch;
      once[i] = nanoseconds_of(*world, path[i], touch);
      least[i] = std::min(least[i], once[i]);
      timing.contact_ticks += touch.contact != rendering::ContactKind::none ? 1 : 0;
      timing.flagged_ticks += touch.flags != rendering::kTouchClean ? 1 : 0;
    }
  }
  std::ranges::sort(least);
  timing.median_ns = percentile(least, 0.5);
  timing.p99_ns = percentile(least, 0.99);
  timing.p999_ns = percentile(least, 0.999);
  timing.max_ns = least.back();
  std::ranges::sort(once);
  timing.once_p999_ns = percentile(once, 0.999);
  timing.once_max_ns = once.back();
  timing.peak_candidates = world->peak_candidates();
  return timing;
}

SingleTimes time_single_ticks(std::span<const rendering::Object> objects, double tool_radius_m,
                              std::span<const Vec3> path, Before before) {
  const auto world = std::make_unique<rendering::World>();
  world->set_scene(objects, {.tool_radius_m = tool_radius_m});
  Pace pace;
  OtherMemory other;
  std::vector<double> times(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    before == Before::sleep ? pace.wait() : other.read();
    rendering::Touch touch;
    times[i] = nanoseconds_of(*world, path[i], touch);
  }
  std::ranges::sort(times);
  return {.median_ns = percentile(times, 0.5), .p999_ns = percentile(times, 0.999)};
}

Lateness lateness_of(std::span<const rendering::Object> objects, double tool_radius_m,
                     std::span<const Vec3> path, std::optional<double> tick_instructions) {
  const auto usual = std::make_unique<rendering::World>();
  const auto unlimited = std::make_unique<rendering::World>();
  usual->set_scene(objects, {.tool_radius_m = tool_radius_m});
  unlimited->set_scene(objects, {.tool_radius_m = tool_radius_m});
  if (tick_instructions) {
    usual->set_tick_budget(*tick_instructions);
  }
  unlimited->set_tick_budget(std::numeric_limits<double>::infinity());
  std::vector<std::byte> room(kMostStateBytes);
  Lateness lateness;
  std::size_t series = 0;
  for (const Vec3& p : path) {
    const rendering::Touch here = usual->touch({.p_W = p});
    const rendering::Touch there = unlimited->touch({.p_W = p});
    const double behind_m = (here.proxy_W - there.proxy_W).norm();
    if (behind_m <= kLate_m) {
      series = 0;
      continue;
    }
    copy_state(*usual, *unlimited, room);
    ++lateness.late_ticks;
    lateness.in_a_row = std::max(lateness.in_a_row, ++series);
    lateness.worst_m = std::max(lateness.worst_m, behind_m);
    const double turn_rad = angle_between(here.force_W, there.force_W);
    lateness.worst_turn_rad = std::max(lateness.worst_turn_rad, turn_rad);
    lateness.turned_ticks += turn_rad > kTurned_rad ? 1 : 0;
  }
  return lateness;
}

}  // namespace tactus::host
