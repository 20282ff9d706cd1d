#include "drivers/gpio_axis/edge_encoder.h"

#include <algorithm>
#include <numbers>

namespace tactus::drivers {

namespace {

hal::TimeNs least_interval(const EncoderConfig& config) {
  const double count_rad = 2.0 * std::numbers::pi / config.counts_per_rev;
  const auto quarter_ns = static_cast<hal::TimeNs>(0.25e9 * count_rad / config.max_speed_rad_per_s);
  return std::max(quarter_ns, EdgeEncoder::kInterrupts_ns);
}

}  // namespace

EdgeEncoder::EdgeEncoder(const EncoderConfig& config, bool has_index)
    : has_index_(has_index),
      gate_(config.index_state),
      least_interval_ns_(least_interval(config)),
      velocity_(hal::TimeNs{config.velocity_window_us} * 1000),
      index_(config.counts_per_rev, config.index_tolerance_counts) {}

void EdgeEncoder::restart(bool a, bool b, bool index, hal::TimeNs now_ns) {
  state_ = quadrature_state(a, b);
  count_ = 0;
  illegal_ = 0;
  restarted_ns_ = now_ns;
  last_edge_ns_ = 0;
  last_channel_ = EncoderChannel::index;
  disagrees_since_ns_ = 0;
  fault_ = EncoderFault::none;
  velocity_.restart();
  index_.restart(count_);
  index_high_ = index;
  latched_ = true;  // an earlier pulse is not latched: its direction is unknown
}

void EdgeEncoder::take(EncoderChannel channel, bool rising, hal::TimeNs time_ns) {
  if (time_ns < restarted_ns_) {
    return;
  }
  if (channel == EncoderChannel::index) {
    take_index(rising);
    return;
  }
  disagrees_since_ns_ = 0;
  const unsigned bit = channel == EncoderChannel::a ? 2U : 1U;
  const bool repeats = ((state_ & bit) != 0) == rising;
  const hal::TimeNs interval_ns = time_ns - last_edge_ns_;
  const bool is_first = last_channel_ == EncoderChannel::index;
  const hal::TimeNs least_ns = channel != last_channel_ ? least_interval_ns_ : 0;
  if (repeats || (!is_first && interval_ns < least_ns)) {
    reject();
  }
  if (!repeats) {
    const int step = quadrature_step(state_, state_ ^ bit);
    velocity_.saw(2 * count_ + step, time_ns);
    count_ += step;
    state_ ^= bit;
  }
  last_edge_ns_ = time_ns;
  last_channel_ = channel;
  if (has_index_) {
    latch_if_gated();
    fail(index_.pass(count_));
  }
}

void EdgeEncoder::take_index(bool rising) {
  index_high_ = rising;
  latched_ = latched_ && !rising;  // a new pulse
  latch_if_gated();
}

// Latches the count of the index in one of the four states of A and B, so that it is the same from
// either direction.
void EdgeEncoder::latch_if_gated() {
  if (has_index_ && index_high_ && !latched_ && state_ == gate_) {
    latched_ = true;
    fail(index_.pulse(count_));
  }
}

void EdgeEncoder::reject() {
  ++illegal_;
  fail(EncoderFault::illegal_transition);
}

void EdgeEncoder::compare(bool a, bool b, hal::TimeNs now_ns) {
  if (quadrature_state(a, b) == state_) {
    disagrees_since_ns_ = 0;
  } else if (disagrees_since_ns_ == 0) {
    disagrees_since_ns_ = now_ns;
  } else if (now_ns - disagrees_since_ns_ >= kDisagreement_ns) {
    fail(EncoderFault::levels_disagree);
  }
}

EncoderReading EdgeEncoder::reading(hal::TimeNs now_ns) const {
  return {.count = count_,
          .counts_per_s = fault_ == EncoderFault::none ? velocity_.at(now_ns) : 0.0,
          .time_ns = now_ns,
          .index_count = index_.last(),
          .index_seen = index_.seen(),
          .fault = fault_};
}

}  // namespace tactus::drivers
