#include "host_tools/benchmark/jitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <thread>

#include "firmware/linux/realtime/real_time.h"
#include "firmware/linux/realtime/time_histogram.h"
#include "hal/linux/clock.h"

namespace tactus::host {

namespace {

// The bins of tactusd's own histogram are copied as they are.
static_assert(kJitterBins == firmware::kTimeBins);

// Runs in the measured thread: sleeps to a fixed phase like the loop and notes how late it wakes.
void sleep_and_wake(const JitterPlan& plan, Jitter& jitter) {
  firmware::RealTimeError error;
  if (!firmware::become_real_time({.priority = plan.priority, .cpu = plan.cpu}, error)) {
    jitter.not_real_time = fmt::format("{}: {}", error.what, std::strerror(error.errno_value));
  }
  const hal::Phase phase{.period_ns = std::llround(1e9 / plan.rate_hz), .offset_ns = 0};
  const auto ticks = static_cast<std::uint64_t>(std::llround(plan.seconds * plan.rate_hz));
  firmware::TimeHistogram histogram;
  hal::LinuxClock clock;
  hal::Wake wake = clock.sleep_until(hal::next_instant_ns(phase, clock.now_ns()));
  for (std::uint64_t i = 0; i < ticks; ++i) {
    wake = clock.sleep_to_phase(phase, wake);
    histogram.add(wake.woke_ns - wake.scheduled_ns);
  }
  jitter.bins = histogram.bins();
  jitter.overflow = histogram.overflow();
  jitter.count = histogram.count();
  jitter.min_us = 1e-3 * static_cast<double>(histogram.min_ns());
  jitter.mean_us = 1e-3 * histogram.mean_ns();
  jitter.max_us = 1e-3 * static_cast<double>(histogram.max_ns());
}

}  // namespace

Jitter measure_loop(const JitterPlan& plan) {
  Jitter jitter;
  firmware::CpuLatencyRequest awake;
  // If it cannot be held, processors sleep deeper and wake later; that is then measured.
  awake.hold();
  std::thread([&] { sleep_and_wake(plan, jitter); }).join();
  return jitter;
}

double percentile_us(const Jitter& jitter, double share) {
  const double wanted = share * static_cast<double>(jitter.count);
  double reached = 0.0;
  for (std::size_t i = 0; i < kJitterBins; ++i) {
    reached += static_cast<double>(jitter.bins[i]);
    if (jitter.bins[i] > 0 && reached >= wanted) {
      return static_cast<double>(i + 1);
    }
  }
  return jitter.max_us;
}

std::string jitter_bars(const Jitter& jitter, std::size_t width) {
  constexpr std::array<std::size_t, 9> kEnds_us = {2, 5, 10, 20, 50, 100, 200, 500, kJitterBins};
  const auto bar = [&](std::uint64_t count) {
    // The bars are logarithmic, so that one in a million can be seen.
    const double share = std::log10(static_cast<double>(count) + 1.0) /
                         std::log10(static_cast<double>(jitter.count) + 1.0);
    return std::string(static_cast<std::size_t>(std::ceil(share * static_cast<double>(width))),
                       '#');
  };
  std::string text;
  std::size_t begin = 0;
  for (const std::size_t end : kEnds_us) {
    std::uint64_t count = 0;
    const std::size_t first = begin;
    for (; begin < end; ++begin) {
      count += jitter.bins[begin];
    }
    text +=
        fmt::format("  {:>4} to {:>4} us {:>9} {}", first, end, count, count > 0 ? bar(count) : "");
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  if (jitter.overflow > 0) {
    text += fmt::format("     longer     {:>9} {}\n", jitter.overflow, bar(jitter.overflow));
  }
  return text;
}

}  // namespace tactus::host
