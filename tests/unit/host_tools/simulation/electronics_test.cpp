#include "host_tools/simulation/electronics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host_tools/simulation/random.h"

namespace tactus::host {
namespace {

TEST(Encoder, IsNeverMoreThanHalfACountWrong) {
  Encoder encoder(5e-6, 100.0, 1e-3);
  SplitMix64 random(4);
  for (int i = 0; i < 10000; ++i) {
    const double position = random.uniform(-0.1, 0.1);
    encoder.sample(position);
    ASSERT_LE(std::abs(encoder.position() - position), 2.5e-6 * (1.0 + 1e-9));
  }
}

TEST(Encoder, VelocitySettlesOnASteadyMotion) {
  Encoder encoder(5e-6, 100.0, 1e-3);
  for (int k = 0; k < 1000; ++k) {
    encoder.sample(0.1 * 1e-3 * k);
  }
  EXPECT_NEAR(encoder.velocity(), 0.1, 1e-6);
}

TEST(Encoder, RestartMovesTheOriginWithoutAVelocitySpike) {
  Encoder encoder(5e-6, 100.0, 1e-3);
  encoder.sample(0.0);
  encoder.restart();
  encoder.sample(0.05);
  EXPECT_EQ(encoder.velocity(), 0.0);
  EXPECT_NEAR(encoder.position(), 0.05, 2.5e-6);
}

TEST(Motor, StepResponseIsTheFirstOrderClosedForm) {
  const double step_s = 1e-4;
  Motor motor(12.0, 0.5e-3, step_s);
  motor.command(3.0);
  for (int k = 1; k <= 50; ++k) {
    EXPECT_NEAR(motor.advance(), 3.0 * (1.0 - std::exp(-k * step_s / 0.5e-3)), 1e-12);
  }
}

TEST(Motor, ClampsToItsLimitAndIgnoresWhatIsNotANumber) {
  Motor motor(12.0, 0.0, 1e-4);
  motor.command(100.0);
  EXPECT_EQ(motor.advance(), 12.0);
  motor.command(-100.0);
  EXPECT_EQ(motor.advance(), -12.0);
  motor.command(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(motor.advance(), 0.0);
}

}  // namespace
}  // namespace tactus::host
