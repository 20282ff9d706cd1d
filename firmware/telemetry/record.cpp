#include "firmware/telemetry/record.h"

#include <bit>

namespace tactus::firmware {
namespace {

// The hash of a sequence of words. The multiplier is 2^64 divided by the golden ratio, which
// spreads near inputs.
class Hash {
 public:
  explicit Hash(std::uint64_t start) : state_(start) {}

  void add(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x9E37'79B9'7F4A'7C15U;
    state_ ^= state_ >> 32;
  }

  // Adds the bits of a number. All NaNs count alike, because their sign and payload depend on the
  // processor.
  void add_real(double value) {
    add(value == value ? std::bit_cast<std::uint64_t>(value) : 0x7FF8'0000'0000'0000U);
  }

  template <std::size_t N>
  void add_reals(const std::array<double, N>& values) {
    for (const double value : values) {
      add_real(value);
    }
  }

  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_;
};

}  // namespace

std::uint64_t state_hash(const TelemetryRecord& record, std::uint64_t previous) {
  Hash hash(previous);
  hash.add(record.tick);
  hash.add_real(record.time_s);
  hash.add(static_cast<std::uint64_t>(record.mode));
  hash.add(static_cast<std::uint64_t>(record.request));
  hash.add(static_cast<std::uint64_t>(record.contact));
  hash.add(static_cast<std::uint64_t>(record.friction));
  hash.add(record.faults);
  hash.add(record.limits);
  hash.add(record.device_status);
  hash.add(record.sample_age_us);
  hash.add(record.loop_status);
  hash.add(record.missed_ticks);
  hash.add(record.touch_flags);
  hash.add(record.object);
  hash.add(record.sub_goals);
  hash.add(record.planes);
  hash.add_reals(record.joint_position);
  hash.add_reals(record.joint_velocity);
  hash.add_reals(record.joint_effort);
  hash.add_reals(record.tool_p_W);
  hash.add_reals(record.tool_v_W);
  hash.add_reals(record.proxy_W);
  hash.add_reals(record.normal_W);
  hash.add_reals(record.force_rendered_W);
  hash.add_reals(record.force_commanded_W);
  hash.add_real(record.depth_m);
  hash.add_real(record.passivity_J);
  hash.add(record.counters.stale_samples);
  hash.add(record.counters.faults_entered);
  hash.add(record.counters.limited_ticks);
  hash.add(record.counters.touch_flagged);
  hash.add(record.counters.late_ticks);
  if (record.effort_known != 0) {
    hash.add_reals(record.joint_measured);
    hash.add(record.effort_known);
    hash.add(record.effort_is_new);
  }
  if (record.short_of_goal_m != 0.0) {
    hash.add_real(record.short_of_goal_m);
  }
  return hash.value();
}

}  // namespace tactus::firmware
