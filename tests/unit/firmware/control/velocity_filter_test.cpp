#include "firmware/control/velocity_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tactus::firmware {
namespace {

TEST(VelocityFilter, WithoutACutoffPassesEverything) {
  VelocityFilter filter;
  filter.configure(0.0, 1000.0);
  EXPECT_EQ(filter.filter({1.0, -2.0, 3.0}), Vec3(1.0, -2.0, 3.0));
  EXPECT_EQ(filter.filter({0.0, 0.5, 0.0}), Vec3(0.0, 0.5, 0.0));
}

TEST(VelocityFilter, AStepRisesLikeAFirstOrderLag) {
  VelocityFilter filter;
  filter.configure(10.0, 100'000.0);  // fast enough that backward Euler is the continuous lag
  Vec3 velocity = Vec3::Zero();
  for (int tick = 0; tick < 1592; ++tick) {  // one time constant, 1 / (2 pi 10 Hz)
    velocity = filter.filter(Vec3::UnitX());
  }
  EXPECT_NEAR(velocity.x(), 1.0 - std::exp(-1.0), 1e-3);
}

TEST(VelocityFilter, ResetForgets) {
  VelocityFilter filter;
  filter.configure(10.0, 1000.0);
  filter.filter({5.0, 5.0, 5.0});
  filter.reset();
  EXPECT_EQ(filter.filter(Vec3::Zero()), Vec3::Zero());
}

}  // namespace
}  // namespace tactus::firmware
