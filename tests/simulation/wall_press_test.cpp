// The hand presses and strokes a flat wall through the controller: steady states have closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/simulation/slab_press.h"

namespace tactus::testing {
namespace {

using firmware::Mode;
using rendering::FrictionState;

TEST(WallPress, TheControllerHomesAndActivatesByItself) {
  const Solid wall = slab(0.0, 0.0);
  host::Simulation simulation(ideal(press(0.005)), {&wall.object(), 1}, kToolRadius_m);
  simulation.tick();
  EXPECT_EQ(simulation.record().mode, Mode::homing);
  run_for(simulation, 0.3);
  EXPECT_EQ(simulation.record().mode, Mode::active);
}

// K x = k (d - x): the wall's spring against the hand's.
TEST(WallPress, SteadyPressBalancesTheHandAgainstTheWall) {
  for (const host::HandParameters& preset : {host::kFingerHand, host::kPenHand, host::kFirmHand}) {
    const Solid wall = slab(0.0, 0.0);
    host::SimulationConfig config = ideal(press(0.008));
    config.hand = preset;
    config.hand.tremor_m = 0.0;
    host::Simulation simulation(config, {&wall.object(), 1}, kToolRadius_m);
    run_for(simulation, 3.0);
    const double k = preset.stiffness_N_per_m;
    const double depth_m = k * 0.008 / (k + kStiffness_N_per_m);
    const double encoder_m = 5e-6;
    EXPECT_NEAR(simulation.record().depth_m, depth_m, encoder_m);
    EXPECT_NEAR(simulation.record().force_commanded_W[2], kStiffness_N_per_m * depth_m,
                kStiffness_N_per_m * encoder_m);
    EXPECT_EQ(simulation.record().faults, 0U);
  }
}

TEST(WallPress, ThePressIsStillOnceSettled) {
  const Solid wall = slab(0.6, 0.4, 0.5);
  host::Simulation simulation(ideal(press(0.008)), {&wall.object(), 1}, kToolRadius_m);
  run_for(simulation, 3.0);
  double fastest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    simulation.tick();
    fastest = std::max(fastest, simulation.device().plant().v_B().norm());
  }
  EXPECT_LT(fastest, 1e-3);
}

// Sliding at a steady speed with the dynamic coefficient only: tangential over normal force is that
// coefficient.
TEST(WallPress, AStrokeFeelsTheDynamicCoefficient) {
  const double coefficient = 0.4;
  const Solid wall = slab(coefficient, coefficient);
  const host::WishPath path({at_depth(0.0, -0.05, -0.01), at_depth(0.8, -0.05, -0.01),
                             at_depth(1.5, -0.05, 0.008), at_depth(2.0, -0.05, 0.008),
                             at_depth(4.0, 0.0, 0.008), at_depth(6.0, 0.05, 0.008)});
  host::Simulation simulation(ideal(path), {&wall.object(), 1}, kToolRadius_m);
  run_for(simulation, 3.0);
  int slipping = 0;
  double ratio_sum = 0.0;
  for (int i = 0; i < 2000; ++i) {
    simulation.tick();
    const firmware::TelemetryRecord& record = simulation.record();
    ASSERT_NE(record.contact, rendering::ContactKind::none);
    if (record.friction == FrictionState::slip) {
      ++slipping;
      const double tangential = std::hypot(record.force_rendered_W[0], record.force_rendered_W[1]);
      const double ratio = tangential / record.force_rendered_W[2];
      ratio_sum += ratio;
      // Single ticks may differ where the proxy crosses the diagonal of the wall's two triangles.
      ASSERT_NEAR(ratio, coefficient, 0.05 * coefficient);
      ASSERT_LT(record.force_rendered_W[0], 0.0) << "friction must oppose the motion";
    }
  }
  ASSERT_GT(slipping, 1000);
  EXPECT_NEAR(ratio_sum / slipping, coefficient, 1e-3 * coefficient);
}

TEST(WallPress, FrictionNeverExceedsTheStaticCone) {
  const Solid wall = slab(0.6, 0.4);
  const host::WishPath path({at_depth(0.0, -0.03, -0.01), at_depth(0.8, -0.03, -0.01),
                             at_depth(1.5, -0.03, 0.008), at_depth(3.0, 0.03, 0.008),
                             at_depth(4.5, -0.03, 0.008), at_depth(5.0, -0.03, -0.01)});
  host::SimulationConfig config{.path = path};  // tremor, joint friction and all
  host::Simulation simulation(config, {&wall.object(), 1}, kToolRadius_m);
  for (int i = 0; i < 6000; ++i) {
    simulation.tick();
    const firmware::TelemetryRecord& record = simulation.record();
    const double tangential = std::hypot(record.force_rendered_W[0], record.force_rendered_W[1]);
    ASSERT_LE(tangential, 0.6 * record.force_rendered_W[2] + 1e-9)
        << "at " << record.time_s << " s";
    ASSERT_EQ(record.touch_flags, 0U);
  }
  EXPECT_EQ(simulation.record().contact, rendering::ContactKind::none);
}

// Nothing to touch: the hand carries the handle to its wish against the back-drive friction alone.
TEST(WallPress, FreeSpaceHasNoForce) {
  const Solid wall = slab(0.6, 0.4);
  host::Simulation simulation(host::SimulationConfig{.path = press(-0.005)}, {&wall.object(), 1},
                              kToolRadius_m);
  for (int i = 0; i < 3000; ++i) {
    simulation.tick();
    ASSERT_EQ(simulation.record().force_commanded_W, firmware::Triple{});
  }
  const rendering::FrictionParameters friction =
      host::cartesian_preset().device.plant.joint_friction;
  const double stiction_m = friction.static_level / host::kPenHand.stiffness_N_per_m;
  EXPECT_LT((simulation.handle_W() - simulation.wish_W()).cwiseAbs().maxCoeff(),
            stiction_m + 2.0 * host::kPenHand.tremor_m);
}

}  // namespace
}  // namespace tactus::testing
