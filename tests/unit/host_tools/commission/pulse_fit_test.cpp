#include "firmware/commissioning/pulse_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tactus::firmware {
namespace {

// A mass with viscous and sliding friction and a load, integrated in steps of a hundredth of a
// tick.
struct Body {
  double mass = 0.1;
  double viscous = 0.5;
  double friction = 0.05;
  double load = 0.0;
  std::size_t delay = 1;
  double count = 1e-6;
};

PulseRecord record_of(const Body& body, double effort, double step_s) {
  constexpr int kSubsteps = 100;
  PulseRecord record;
  double q = 0.0;
  double v = 0.0;
  for (std::size_t k = 0; k < 200; ++k) {
    const std::size_t quarter = k / 20;
    const bool first = quarter % 4 == 0 || quarter % 4 == 3;
    const double side = quarter < 4 ? 1.0 : quarter < 8 ? -1.0 : 0.0;
    record.effort[k] = (first ? side : -side) * effort;
    record.position[k] = std::round(q / body.count) * body.count;
    record.count = k + 1;
    const double u = k >= body.delay ? record.effort[k - body.delay] : 0.0;
    for (int i = 0; i < kSubsteps; ++i) {
      const double h = step_s / kSubsteps;
      const double pushed = u + body.load - body.viscous * v;
      if (v == 0.0 && std::abs(pushed) <= body.friction) {
        continue;  // it sticks
      }
      const double before = v;
      v += h * (pushed - std::copysign(body.friction, v != 0.0 ? v : pushed)) / body.mass;
      if (before * v < 0.0) {
        v = 0.0;
      }
      q += h * v;
    }
  }
  return record;
}

TEST(PulseFitTest, FindsMassFrictionAndDelayOfAKnownBody) {
  for (const double mass : {0.02, 0.1, 0.5}) {
    for (const std::size_t delay : {0U, 1U, 4U}) {
      const Body body{.mass = mass, .delay = delay};
      const PulseFit fit = fit_pulse(record_of(body, 20.0 * mass, 0.001), 0.001);
      EXPECT_NEAR(fit.inertia, mass, 0.05 * mass) << mass << ' ' << delay;
      EXPECT_NEAR(fit.friction, body.friction, 0.05 * 20.0 * mass);
      EXPECT_EQ(fit.delay_ticks, delay) << mass;
      EXPECT_GT(fit.explained, 0.99);
    }
  }
}

TEST(PulseFitTest, SeesAReversedMotorAsNegativeInertia) {
  PulseRecord record = record_of({}, 2.0, 0.001);
  for (double& position : record.position) {
    position = -position;
  }
  EXPECT_NEAR(fit_pulse(record, 0.001).inertia, -0.1, 0.01);
}

TEST(PulseFitTest, SeesAWrongScaleInTheInertia) {
  PulseRecord record = record_of({}, 2.0, 0.001);
  for (double& position : record.position) {
    position *= 4.0;
  }
  EXPECT_NEAR(fit_pulse(record, 0.001).inertia, 0.025, 0.003);
}

TEST(PulseFitTest, BearsCoarseCounts) {
  const Body body{.count = 50e-6};
  const PulseFit fit = fit_pulse(record_of(body, 2.0, 0.001), 0.001);
  EXPECT_NEAR(fit.inertia, 0.1, 0.01);
  EXPECT_NEAR(fit.quantum, 50e-6, 1e-12);
}

TEST(PulseFitTest, OfALoadedJointFindsTheLoad) {
  const Body body{.friction = 0.0, .load = 0.3};
  const PulseFit fit = fit_pulse(record_of(body, 2.0, 0.001), 0.001);
  EXPECT_NEAR(fit.load, 0.3, 0.05);
  EXPECT_NEAR(fit.inertia, 0.1, 0.01);
}

TEST(PulseFitTest, GivesZerosWithoutMotion) {
  PulseRecord record = record_of({.friction = 100.0}, 2.0, 0.001);
  EXPECT_EQ(fit_pulse(record, 0.001).inertia, 0.0);
  EXPECT_EQ(fit_pulse(record, 0.001).travel, 0.0);
}

TEST(PulseFitTest, ComparesTheReportedTorqueAtItsOwnDelay) {
  PulseRecord record = record_of({}, 2.0, 0.001);
  record.has_reported = true;
  for (std::size_t k = 3; k < record.count; ++k) {
    record.reported[k] = 0.5 * record.effort[k - 3];
  }
  EXPECT_NEAR(fit_pulse(record, 0.001).reported_share, 0.5, 0.01);
}

}  // namespace
}  // namespace tactus::firmware
