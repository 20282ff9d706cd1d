#include "host_tools/monitor/run_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tactus::host {

namespace {

// How many ticks the rate is taken over.
constexpr std::size_t kInstants = 1000;

double magnitude(const firmware::Triple& v) {
  return std::hypot(v[0], v[1], v[2]);
}

// Returns the next of 1, 2, 5, 10, 20, and so on; the small number absorbs rounding in the
// logarithm.
double next_scale(double scale) {
  const double decade = std::pow(10.0, std::floor(std::log10(scale) + 1e-9));
  const double lead = scale / decade;
  return decade * (lead < 1.5 ? 2.0 : lead < 3.0 ? 5.0 : 10.0);
}

// Returns true if a tick began more than half a period after its time. `before` is an earlier one
// of the same run.
bool began_late(const firmware::RecordedTick& tick, const firmware::RecordedTick& before) {
  const auto periods = static_cast<double>(tick.record.tick - before.record.tick);
  const auto passed_ns =
      static_cast<double>(tick.loop.scheduled_ns) - static_cast<double>(before.loop.scheduled_ns);
  return 2.0 * periods * static_cast<double>(tick.loop.wake_latency_ns()) > passed_ns;
}

}  // namespace

void RunView::take(const RunInfo& info) {
  for (const auto& [key, value] : info) {
    if (key == "device" || (key == "scene" && name_.empty())) {
      name_ = value;
    }
  }
}

void RunView::take(const firmware::RecordedTick& tick) {
  const bool begins = !newest_ || tick.record.tick <= newest_->record.tick;
  // The first tick, or the first one of another run.
  if (begins) {
    instants_.clear();
    seen_late_ = 0;
  } else {
    missing_ += tick.record.tick - newest_->record.tick - 1;
    seen_late_ += tick.loop.woke_ns != 0 && began_late(tick, *newest_) ? 1U : 0U;
  }
  lost_ = false;
  newest_ = tick;
  instants_.push_back({tick.record.tick, tick.loop.scheduled_ns});
  if (instants_.size() > kInstants) {
    instants_.pop_front();
  }
  if (tick.loop.woke_ns != 0) {
    wake_up_.add(tick.loop.wake_latency_ns());
    tick_time_.add(tick.loop.busy_ns());
  }
  const double force_N = magnitude(tick.record.force_commanded_W);
  while (std::isfinite(force_N) && force_N > force_scale_N_) {
    force_scale_N_ = next_scale(force_scale_N_);
  }
}

std::uint64_t RunView::late_ticks() const {
  const std::uint64_t counted = newest_ ? newest_->record.counters.late_ticks : 0;
  return std::max(counted, seen_late_);
}

double RunView::rate_hz() const {
  if (instants_.size() < 2) {
    return 0.0;
  }
  const auto ticks = static_cast<double>(instants_.back().tick - instants_.front().tick);
  const auto ns =
      static_cast<double>(instants_.back().scheduled_ns - instants_.front().scheduled_ns);
  return ns > 0.0 ? 1e9 * ticks / ns : 0.0;
}

}  // namespace tactus::host
