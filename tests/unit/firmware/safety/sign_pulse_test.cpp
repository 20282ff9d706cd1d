#include "firmware/safety/sign_pulse.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace tactus::firmware {
namespace {

struct Rate {
  double rate_hz;
  double delay_s;
};
constexpr std::array kRates = {Rate{200.0, 0.0}, Rate{1000.0, 0.0}, Rate{1000.0, 0.0035},
                               Rate{1500.0, 0.002}, Rate{10'000.0, 0.001}};

// Runs a pulse of 2 N on a joint that moves by g times the double integral of the delayed effort,
// and by `drift` besides. Both are functions of the sample's number.
template <class Drift>
PulseAnswer run(const Rate& rate, double g, const Drift& drift) {
  const PulseShape shape = pulse_shape(rate.rate_hz, rate.delay_s);
  const PulseTables tables = pulse_tables(shape);
  SignPulse pulse;
  pulse.begin(0.5, 2.0);
  std::array<double, kMaxSignSamples> r{};
  double integral = 0.0;
  for (std::size_t n = 1; n < shape.samples; ++n) {
    const double effort = n > shape.delay ? 2.0 * shape.sign_in(n - 1 - shape.delay) : 0.0;
    r[n] = r[n - 1] + integral + 0.5 * effort;
    integral += effort;
  }
  for (std::size_t tick = 1;; ++tick) {
    const double effort = pulse.push(shape);
    const std::size_t n = tick / shape.ticks_a_unit;
    if (pulse.advance(0.5 + g * r[n] + drift(n), effort, shape, tables)) {
      EXPECT_EQ(tick, shape.ticks());
      EXPECT_FALSE(pulse.is_running);
      return answer_of(pulse.sums);
    }
  }
}

double no_drift(std::size_t /*n*/) {
  return 0.0;
}

TEST(SignPulse, MovesNoFreeMassInTheEnd) {
  for (const Rate& rate : kRates) {
    const PulseShape shape = pulse_shape(rate.rate_hz, rate.delay_s);
    double speed = 0.0;
    double place = 0.0;
    for (std::size_t unit = 0; unit < shape.samples; ++unit) {
      place += speed + 0.5 * shape.sign_in(unit);
      speed += shape.sign_in(unit);
    }
    EXPECT_EQ(speed, 0.0) << rate.rate_hz;
    EXPECT_EQ(place, 0.0) << rate.rate_hz;
    EXPECT_LE(shape.samples, kMaxSignSamples);
  }
}

TEST(SignPulse, PowersAndInstrumentAreOrthonormal) {
  for (const Rate& rate : kRates) {
    const PulseShape shape = pulse_shape(rate.rate_hz, rate.delay_s);
    const PulseTables tables = pulse_tables(shape);
    const auto entry = [&](std::size_t n, std::size_t column) {
      return column < kPulsePowers ? tables.powers[n][column] : tables.instrument[n];
    };
    for (std::size_t a = 0; a <= kPulsePowers; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        double sum = 0.0;
        for (std::size_t n = 0; n < shape.samples; ++n) {
          sum += entry(n, a) * entry(n, b);
        }
        EXPECT_NEAR(sum, a == b ? 1.0 : 0.0, 1e-9) << rate.rate_hz << ' ' << a << ' ' << b;
      }
    }
  }
}

TEST(SignPulse, FindsTheGainOfAFreeMass) {
  for (const Rate& rate : kRates) {
    for (const double g : {-3e-6, 1e-6, 3e-6}) {
      const PulseAnswer answer = run(rate, g, no_drift);
      EXPECT_TRUE(answer.is_clear) << rate.rate_hz;
      EXPECT_NEAR(answer.gain, g, 1e-9) << rate.rate_hz;
    }
  }
}

// The pulse moves the mass by some 0.1 mm, the hand by 50 mm.
TEST(SignPulse, AHandThatMovesAsACubicChangesNothing) {
  const PulseAnswer answer = run(kRates[1], 2e-6, [](std::size_t n) {
    const double t = static_cast<double>(n) / 72.0;
    return 0.02 * t - 0.07 * t * t + 0.1 * t * t * t;
  });
  EXPECT_TRUE(answer.is_clear);
  EXPECT_NEAR(answer.gain, 2e-6, 1e-9);
}

TEST(SignPulse, AMotionWithoutThePulseIsUnclear) {
  EXPECT_FALSE(run(kRates[1], 0.0, no_drift).is_clear) << "no motion at all";
  EXPECT_FALSE(run(kRates[1], 0.0, [](std::size_t n) {
                 return 1e-4 * std::sin(static_cast<double>(n) * 0.15);
               }).is_clear);
}

TEST(SignPulse, PushesOnlyWhileItRuns) {
  const PulseShape shape = pulse_shape(1000.0, 0.0);
  SignPulse pulse;
  EXPECT_EQ(pulse.push(shape), 0.0);
  pulse.begin(0.0, -1.5);
  EXPECT_EQ(pulse.push(shape), -1.5);
  pulse.is_running = false;
  EXPECT_EQ(pulse.push(shape), 0.0);
}

}  // namespace
}  // namespace tactus::firmware
