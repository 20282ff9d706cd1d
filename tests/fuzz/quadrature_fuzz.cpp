// Whatever edges, gaps, levels and counts come, and whenever: a position that is reported as valid
// moved no further than the edges that were given, nor than the shaft can; once in doubt it stays
// so until a restart; the velocity is a number; and no torque beyond the limit goes to the bridge.

#include <cmath>
#include <numbers>

#include "drivers/gpio_axis/counter_encoder.h"
#include "drivers/gpio_axis/edge_encoder.h"
#include "drivers/gpio_axis/h_bridge.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {
namespace {

using drivers::EncoderFault;
using drivers::EncoderReading;

constexpr double kMaxCountsPerS = 10'000.0;
constexpr drivers::EncoderConfig kEncoder{
    .counts_per_rev = 400,
    .max_speed_rad_per_s = kMaxCountsPerS * 2.0 * std::numbers::pi / 400.0,
    .counter_index = true};

// Properties from one reading to the next, which are at most `most` counts apart.
class ReadingProperties {
 public:
  void restart(const EncoderReading& reading) { last_ = reading; }
  void check(const EncoderReading& reading, double most) {
    require(std::isfinite(reading.counts_per_s), "the velocity is a number");
    require(last_.fault == EncoderFault::none || reading.fault == last_.fault,
            "a doubt stays until the restart");
    if (reading.fault == EncoderFault::none) {
      const auto way = static_cast<double>(reading.count - last_.count);
      require(std::abs(way) <= most, "no jump is reported as valid");
    }
    last_ = reading;
  }

 private:
  EncoderReading last_;
};

// The levels that the edges given so far lead to, kept beside the decoder.
struct Levels {
  bool a = false;
  bool b = false;
  bool index = false;
};

void take_edges(FuzzInput& input, drivers::EdgeEncoder& encoder, Levels& levels,
                hal::TimeNs& now_ns, ReadingProperties& properties) {
  const std::uint32_t edges = input.below(64);
  for (std::uint32_t i = 0; i < edges && !input.empty(); ++i) {
    const auto what = input.take<std::uint8_t>();
    now_ns += hal::TimeNs{input.take<std::uint16_t>()} * 10 - (what >= 0xF8 ? 100'000 : 0);
    const auto channel = static_cast<drivers::EncoderChannel>(what % 3U);
    bool& level = channel == drivers::EncoderChannel::a   ? levels.a
                  : channel == drivers::EncoderChannel::b ? levels.b
                                                          : levels.index;
    // Mostly what a line does: the other level than before.
    level = (what & 0x70U) == 0x70U ? (what & 8U) != 0 : !level;
    encoder.take(channel, level, now_ns);
    properties.check(encoder.reading(now_ns), 1.0);
  }
}

void fuzz_edges(FuzzInput& input) {
  drivers::EdgeEncoder encoder(kEncoder, input.take<std::uint8_t>() % 2U == 0);
  hal::TimeNs now_ns = 1'000'000'000;
  Levels levels;
  ReadingProperties properties;
  encoder.restart(false, false, false, now_ns);
  while (!input.empty()) {
    now_ns += hal::TimeNs{input.take<std::uint16_t>()} * 1000;
    const std::uint32_t what = input.below(16);
    if (what < 10) {
      take_edges(input, encoder, levels, now_ns, properties);
    } else if (what < 14) {
      encoder.compare(levels.a != (what == 12), levels.b != (what == 13), now_ns);
    } else if (what == 14) {
      encoder.fail(EncoderFault::edges_lost);
    } else {
      encoder.restart(levels.a, levels.b, levels.index, now_ns);
      properties.restart(encoder.reading(now_ns));
    }
    properties.check(encoder.reading(now_ns), 0.0);
  }
}

void fuzz_counter(FuzzInput& input) {
  drivers::CounterEncoder encoder(kEncoder);
  const std::uint64_t ceiling = std::uint64_t{input.take<std::uint32_t>()} + 1;
  hal::TimeNs now_ns = 1'000'000'000;
  ReadingProperties properties;
  std::uint64_t count = 0;
  encoder.restart({.count = count, .time_ns = now_ns}, ceiling);
  while (!input.empty()) {
    const hal::TimeNs passed_ns = hal::TimeNs{input.take<std::uint16_t>()} * 1000;
    now_ns += passed_ns;
    const std::uint32_t what = input.below(16);
    count = what < 10 ? count + input.below(40) - 20 : input.take<std::uint64_t>();
    count = count > ceiling ? count % (ceiling + 1) : count;
    if (what == 14) {
      encoder.take_index({.count = input.take<std::uint64_t>(), .time_ns = now_ns});
    } else if (what == 15) {
      encoder.restart({.count = count, .time_ns = now_ns}, ceiling);
      properties.restart(encoder.reading());
      continue;
    }
    encoder.take({.count = count, .time_ns = now_ns, .noisy = what == 13});
    const double passed_s = 1e-9 * static_cast<double>(passed_ns);
    properties.check(encoder.reading(), kMaxCountsPerS * passed_s * (1.0 + 1e-9) + 2.0);
  }
}

// The torque that an output stands for, from the definition of modes and laws.
double torque_of(const drivers::BridgeConfig& config, const drivers::BridgeOutput& output) {
  const double high =
      static_cast<double>(output.duty_ns) / static_cast<double>(config.pwm_period_ns);
  double part = output.reverse ? -high : high;
  if (config.mode == drivers::BridgeMode::locked_antiphase) {
    part = 2.0 * high - 1.0;
  }
  return config.full_duty_torque_Nm *
         (config.law == drivers::TorqueLaw::square_root ? part * std::abs(part) : part);
}

void fuzz_bridge(FuzzInput& input) {
  const auto kind = input.take<std::uint8_t>();
  const drivers::BridgeConfig config{
      .mode = (kind & 1U) != 0 ? drivers::BridgeMode::locked_antiphase
                               : drivers::BridgeMode::sign_magnitude,
      .law = (kind & 2U) != 0 ? drivers::TorqueLaw::square_root : drivers::TorqueLaw::linear,
      .full_duty_torque_Nm = 0.05,
      .max_torque_Nm = 0.03,
      .direction_dead_us = (kind & 4U) != 0 ? 1500U : 0U};
  drivers::HBridge bridge(config);
  hal::TimeNs now_ns = 1'000'000'000;
  bool reverse = false;
  hal::TimeNs driven_ns = 0;
  while (!input.empty()) {
    now_ns += hal::TimeNs{input.take<std::uint16_t>()} * 100;
    const drivers::BridgeOutput output = bridge.drive(input.take<double>(), now_ns);
    require(output.duty_ns >= 0 && output.duty_ns <= config.pwm_period_ns, "the duty is a duty");
    require(std::abs(torque_of(config, output)) <= config.max_torque_Nm * (1.0 + 1e-12),
            "no torque beyond the limit");
    require(output.reverse == reverse ||
                now_ns - driven_ns >= hal::TimeNs{config.direction_dead_us} * 1000,
            "the direction changes only after the dead time");
    reverse = output.reverse;
    driven_ns = output.duty_ns > 0 ? now_ns : driven_ns;
  }
}

void run(FuzzInput input) {
  switch (input.take<std::uint8_t>() % 3U) {
    case 0:
      return fuzz_edges(input);
    case 1:
      return fuzz_counter(input);
    default:
      return fuzz_bridge(input);
  }
}

}  // namespace
}  // namespace tactus::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tactus::fuzz::run(tactus::fuzz::FuzzInput(data, size));
  return 0;
}
