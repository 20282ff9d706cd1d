#include "drivers/gpio_axis/counter_encoder.h"

#include <cmath>
#include <numbers>

namespace tactus::drivers {

namespace {

// The edges of a channel may be uneven, so two counts may be closer together than the rest.
constexpr double kCountsOfGrace = 2.0;

}  // namespace

CounterEncoder::CounterEncoder(const EncoderConfig& config)
    : has_index_(config.counter_index),
      max_counts_per_s_(config.max_speed_rad_per_s * config.counts_per_rev /
                        (2.0 * std::numbers::pi)),
      velocity_(hal::TimeNs{config.velocity_window_us} * 1000),
      index_(config.counts_per_rev, config.index_tolerance_counts) {}

void CounterEncoder::restart(const hal::CounterReading& reading, std::uint64_t ceiling) {
  last_ = reading;
  ceiling_ = ceiling;
  count_ = 0;
  fault_ = EncoderFault::none;
  velocity_.restart();
  velocity_.saw(0, reading.time_ns);
  index_.restart(count_);
}

void CounterEncoder::take(const hal::CounterReading& reading) {
  const std::int64_t step = hal::count_difference(last_.count, reading.count, ceiling_);
  const auto time_s = 1e-9 * static_cast<double>(reading.time_ns - last_.time_ns);
  const double most = max_counts_per_s_ * time_s + kCountsOfGrace;
  if (std::abs(static_cast<double>(step)) > most || 2.0 * most > static_cast<double>(ceiling_)) {
    fail(EncoderFault::jump);
  }
  if (reading.noisy) {
    fail(EncoderFault::noise);
  }
  count_ += step;
  last_ = reading;
  if (step != 0) {
    velocity_.saw(2 * count_, reading.time_ns);
  }
  if (has_index_) {
    fail(index_.pass(count_));
  }
}

void CounterEncoder::take_index(const hal::CounterIndexEvent& event) {
  if (event.count > ceiling_) {
    fail(EncoderFault::jump);
    return;
  }
  fail(index_.pulse(count_ + hal::count_difference(last_.count, event.count, ceiling_)));
}

EncoderReading CounterEncoder::reading() const {
  return {.count = count_,
          .counts_per_s = fault_ == EncoderFault::none ? velocity_.at(last_.time_ns) : 0.0,
          .time_ns = last_.time_ns,
          .index_count = index_.last(),
          .index_seen = index_.seen(),
          .fault = fault_};
}

}  // namespace tactus::drivers
