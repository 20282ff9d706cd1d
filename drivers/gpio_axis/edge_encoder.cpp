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
    : settings_{.has_index = has_index,
                .index_state = config.index_state,
                .least_interval_ns = least_interval(config)},
      velocity_(hal::TimeNs{config.velocity_window_us} * 1000),
      index_(config.counts_per_rev, config.index_tolerance_counts) {}

void EdgeEncoder::restart(bool a, bool b, bool index, hal::TimeNs now_ns) {
  decoded_ = {.state = quadrature_state(a, b)};
  restarted_ns_ = now_ns;
  last_edge_ = {};
  disagrees_since_ns_ = 0;
  velocity_.restart();
  index_.restart(0);
  // An earlier pulse is not latched: its direction is unknown.
  pulse_ = {.is_high = index, .is_latched = true};
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
  const bool repeats = ((decoded_.state & bit) != 0) == rising;
  const hal::TimeNs interval_ns = time_ns - last_edge_.time_ns;
  const bool is_first = last_edge_.channel == EncoderChannel::index;
  const hal::TimeNs least_ns = channel != last_edge_.channel ? settings_.least_interval_ns : 0;
  if (repeats || (!is_first && interval_ns < least_ns)) {
    reject();
  }
  if (!repeats) {
    const int step = quadrature_step(decoded_.state, decoded_.state ^ bit);
    velocity_.saw(2 * decoded_.count + step, time_ns);
    decoded_.count += step;
    decoded_.state ^= bit;
  }
  last_edge_ = {.time_ns = time_ns, .channel = channel};
  if (settings_.has_index) {
    latch_if_gated();
    fail(index_.pass(decoded_.count));
  }
}

void EdgeEncoder::take_index(bool rising) {
  pulse_.is_high = rising;
  pulse_.is_latched = pulse_.is_latched && !rising;  // a new pulse
  latch_if_gated();
}

// Latches the count of the index in one of the four states of A and B, so that it is the same from
// either direction.
void EdgeEncoder::latch_if_gated() {
  if (settings_.has_index && pulse_.is_high && !pulse_.is_latched &&
      decoded_.state == settings_.index_state) {
    pulse_.is_latched = true;
    fail(index_.pulse(decoded_.count));
  }
}

void EdgeEncoder::reject() {
  ++decoded_.illegal;
  fail(EncoderFault::illegal_transition);
}

void EdgeEncoder::compare(bool a, bool b, hal::TimeNs now_ns) {
  if (quadrature_state(a, b) == decoded_.state) {
    disagrees_since_ns_ = 0;
  } else if (disagrees_since_ns_ == 0) {
    disagrees_since_ns_ = now_ns;
  } else if (now_ns - disagrees_since_ns_ >= kDisagreement_ns) {
    fail(EncoderFault::levels_disagree);
  }
}

EncoderReading EdgeEncoder::reading(hal::TimeNs now_ns) const {
  return {.count = decoded_.count,
          .counts_per_s = decoded_.fault == EncoderFault::none ? velocity_.at(now_ns) : 0.0,
          .time_ns = now_ns,
          .index_count = index_.last(),
          .index_seen = index_.seen(),
          .fault = decoded_.fault};
}

}  // namespace tactus::drivers
