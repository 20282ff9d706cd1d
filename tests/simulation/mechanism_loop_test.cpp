// Every mechanism's kinematics of the controller against the plant's, which were written apart:
// closed loop, in motion, in contact. The Falcon's is in falcon_loop_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/simulation/slab_press.h"

namespace tactus::testing {
namespace {

struct LoopCase {
  const char* device;
  Vec3 reach_m;         // of the tour, to either side
  double half_count_m;  // what half a count of every encoder may add up to at the handle
};

Vec3 vector_of(const firmware::Triple& v) {
  return {v[0], v[1], v[2]};
}

host::SimulationConfig loop_of(const std::string& device, const host::WishPath& path) {
  return {.device = *host::device_preset(device),
          .controller = *firmware::preset_config(device),
          .path = path};
}

class MechanismLoop : public ::testing::TestWithParam<LoopCase> {};

// The path leads through the corners of a box, whose far side as the user sees it is 5 mm behind
// the slab's front.
host::WishPath tour_of(const Vec3& reach_m) {
  const auto at = [&](double t_s, double x, double y, double z) {
    const double depth_m = reach_m.z() * (1.0 + z) - 0.005;
    return host::Waypoint{
        .t_s = t_s, .p_W = {x * reach_m.x(), y * reach_m.y(), kFront_m + kToolRadius_m + depth_m}};
  };
  return host::WishPath({at(0.0, 0.0, 0.0, 1.0), at(0.8, 0.0, 0.0, 1.0), at(2.0, 1.0, 1.0, 0.5),
                         at(3.0, 1.0, -1.0, -1.0), at(4.0, -1.0, -1.0, -1.0),
                         at(5.0, -1.0, 1.0, 1.0), at(6.0, 0.0, 1.0, -1.0)});
}

TEST_P(MechanismLoop, TheControllerFindsTheHandleToWithinTheEncoders) {
  const Solid wall = slab(0.6, 0.4, 0.5);
  host::Simulation simulation(loop_of(GetParam().device, tour_of(GetParam().reach_m)),
                              {&wall.object(), 1}, kToolRadius_m);
  run_for(simulation, 0.4);
  ASSERT_EQ(simulation.record().mode, firmware::Mode::active);
  double worst_m = 0.0;
  int touched = 0;
  for (int i = 0; i < 5800; ++i) {
    const Vec3 truth_W = simulation.handle_W();
    simulation.tick();
    ASSERT_EQ(simulation.record().faults, 0U) << "at " << simulation.record().time_s << " s";
    worst_m = std::max(worst_m, (vector_of(simulation.record().tool_p_W) - truth_W).norm());
    touched += simulation.record().contact != rendering::ContactKind::none ? 1 : 0;
  }
  std::printf("%s: within %.1f um, %d ticks in contact\n", GetParam().device, 1e6 * worst_m,
              touched);
  EXPECT_GT(touched, 500);
  EXPECT_LT(worst_m, GetParam().half_count_m);
  EXPECT_GT(worst_m, 0.1 * GetParam().half_count_m) << "the encoders must quantise";
}

// Returns the force of the motors on the handle, N, without the part that holds the arm's weight.
Vec3 motor_force(const host::Simulation& simulation) {
  const auto effort = simulation.device().motor_effort();
  Vec3 force_B = Vec3::Zero();
  for (std::size_t i = 0; i < host::kPlantJoints; ++i) {
    force_B += (effort[i] - simulation.record().joint_gravity[i]) *
               simulation.device().plant().pose().rows[i];
  }
  return force_B;
}

TEST_P(MechanismLoop, TheMotorsPutTheCommandedForceOnTheHand) {
  const Solid wall = slab(0.0, 0.0);
  host::SimulationConfig config = loop_of(GetParam().device, press(0.006));
  config.hand.tremor_m = 0.0;
  host::Simulation simulation(config, {&wall.object(), 1}, kToolRadius_m);
  run_for(simulation, 3.0);
  const Vec3 commanded_W = vector_of(simulation.record().force_commanded_W);
  ASSERT_GT(commanded_W.z(), 0.8);
  EXPECT_LT((motor_force(simulation) - commanded_W).norm(), 0.02 * commanded_W.norm());
}

INSTANTIATE_TEST_SUITE_P(Devices, MechanismLoop,
                         ::testing::Values(LoopCase{"cartesian", Vec3::Constant(0.05), 5e-6},
                                           LoopCase{"haply_pantograph", {0.025, 0.0, 0.02}, 35e-6},
                                           LoopCase{"phantom_premium", Vec3::Constant(0.04), 55e-6},
                                           LoopCase{"woodenhaptics", Vec3::Constant(0.05), 110e-6}),
                         [](const auto& named) { return std::string(named.param.device); });

// The right side of a slab, which is all that a paddle can press on.
TEST(HapkitLoop, PressesOnTheSideOfASlabWithTheCommandedForceAlongItsArc) {
  const Solid wall(box({0.02, 0.2, 0.2}), rendering::Sides::one,
                   rendering::Material{.stiffness_N_per_m = kStiffness_N_per_m,
                                       .damping_Ns_per_m = 0.0,
                                       .friction = rendering::cone_friction(0.0, 0.0)});
  const auto at = [](double t_s, double depth_m) {
    return host::Waypoint{.t_s = t_s, .p_W = {0.01 + kToolRadius_m - depth_m, 0.0, 0.0}};
  };
  host::SimulationConfig config =
      loop_of("hapkit", host::WishPath({at(0.0, -0.03), at(0.8, -0.03), at(1.6, 0.006)}));
  config.hand.tremor_m = 0.0;
  host::Simulation simulation(config, {&wall.object(), 1}, kToolRadius_m);
  double worst_m = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 truth_W = simulation.handle_W();
    simulation.tick();
    ASSERT_EQ(simulation.record().faults, 0U);
    if (simulation.record().mode == firmware::Mode::active) {
      worst_m = std::max(worst_m, (vector_of(simulation.record().tool_p_W) - truth_W).norm());
    }
  }
  EXPECT_LT(worst_m, 0.5 * config.device.device.encoder_resolution * 0.0657);
  const Vec3 commanded_W = vector_of(simulation.record().force_commanded_W);
  ASSERT_GT(commanded_W.x(), 0.8);
  // Across the arc the bearing holds: the motor pushes with what is along it.
  const Vec3 up_B = simulation.device().plant().p_B().normalized();
  const Vec3 along_W = commanded_W - commanded_W.dot(up_B) * up_B;
  EXPECT_LT((motor_force(simulation) - along_W).norm(), 0.02 * commanded_W.norm());
}

}  // namespace
}  // namespace tactus::testing
