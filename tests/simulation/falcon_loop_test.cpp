// The controller's delta kinematics against the plant's, which were written apart: closed loop, in
// motion, in contact.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/simulation/slab_press.h"

namespace tactus::testing {
namespace {

host::SimulationConfig falcon(const host::WishPath& path) {
  return {.device = host::falcon_preset(), .controller = firmware::falcon_config(), .path = path};
}

Vec3 vec3(const firmware::Triple& v) {
  return {v[0], v[1], v[2]};
}

host::WishPath tour() {
  return host::WishPath({{.t_s = 0.0, .p_W = {0.0, 0.0, 0.035}},
                         {.t_s = 1.0, .p_W = {0.0, 0.0, 0.035}},
                         {.t_s = 2.0, .p_W = {0.035, 0.0, 0.02}},
                         {.t_s = 3.0, .p_W = {0.0, 0.035, 0.005}},
                         {.t_s = 4.0, .p_W = {-0.035, -0.03, 0.005}},
                         {.t_s = 5.0, .p_W = {0.0, -0.03, 0.03}}});
}

TEST(FalconLoop, TheControllerFindsTheHandleToWithinTheEncoders) {
  const Solid wall = slab(0.6, 0.4, 0.5);
  host::Simulation simulation(falcon(tour()), {&wall.object(), 1}, kToolRadius_m);
  run_for(simulation, 0.4);
  ASSERT_EQ(simulation.record().mode, firmware::Mode::active);
  double worst_m = 0.0;
  bool touched = false;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 truth_W = simulation.handle_W();
    simulation.tick();
    ASSERT_EQ(simulation.record().faults, 0U) << "at " << simulation.record().time_s << " s";
    worst_m = std::max(worst_m, (vec3(simulation.record().tool_p_W) - truth_W).norm());
    touched = touched || simulation.record().contact != rendering::ContactKind::none;
  }
  EXPECT_TRUE(touched);
  // Half a count is 0.32 mrad on each arm; the lever is at most about 0.1 m a rad within this tour.
  EXPECT_LT(worst_m, 60e-6);
  EXPECT_GT(worst_m, 1e-6) << "the encoders must quantise";
}

TEST(FalconLoop, TheMotorsPutTheCommandedForceOnTheHand) {
  const Solid wall = slab(0.0, 0.0);
  host::SimulationConfig config = falcon(press(0.008));
  config.hand.tremor_m = 0.0;
  host::Simulation simulation(config, {&wall.object(), 1}, kToolRadius_m);
  run_for(simulation, 3.0);
  const Vec3 commanded_W = vec3(simulation.record().force_commanded_W);
  ASSERT_GT(commanded_W.z(), 1.0);
  EXPECT_LT((simulation.device().motor_force_B() - commanded_W).norm(), 0.02 * commanded_W.norm());
}

}  // namespace
}  // namespace tactus::testing
