// The same seed gives the same bits.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/simulation/slab_press.h"

namespace tactus::testing {
namespace {

std::vector<std::uint64_t> hashes(const host::DevicePreset& device,
                                  const firmware::ControllerConfig& controller,
                                  std::uint64_t seed) {
  const Solid ball = Solid(icosphere(0.03, 3), rendering::Sides::one,
                           {.stiffness_N_per_m = 800.0,
                            .damping_Ns_per_m = 0.5,
                            .friction = rendering::cone_friction(0.6, 0.4)});
  const host::WishPath path({{.t_s = 0.0, .p_W = {0.0, 0.0, 0.045}},
                             {.t_s = 0.5, .p_W = {0.0, 0.0, 0.045}},
                             {.t_s = 1.0, .p_W = {0.0, 0.0, 0.025}},
                             {.t_s = 2.0, .p_W = {0.02, 0.01, 0.015}}});
  host::SimulationConfig config{
      .device = device, .controller = controller, .path = path, .seed = seed};
  host::Simulation simulation(config, {&ball.object(), 1}, kToolRadius_m);
  std::vector<std::uint64_t> chain;
  bool touched = false;
  for (int i = 0; i < 2500; ++i) {
    simulation.tick();
    chain.push_back(simulation.record().state_hash);
    touched = touched || simulation.record().contact != rendering::ContactKind::none;
  }
  EXPECT_TRUE(touched);
  EXPECT_EQ(simulation.record().faults, 0U);
  return chain;
}

TEST(Determinism, TheSameSeedGivesTheSameHashEveryTick) {
  EXPECT_EQ(hashes(host::cartesian_preset(), firmware::cartesian_config(), 5),
            hashes(host::cartesian_preset(), firmware::cartesian_config(), 5));
  EXPECT_EQ(hashes(host::falcon_preset(), firmware::falcon_config(), 5),
            hashes(host::falcon_preset(), firmware::falcon_config(), 5));
}

// The paddle is moved from the side by tests of its own.
TEST(Determinism, EveryMechanismGivesTheSameHashesAgain) {
  for (const char* name : {"haply_pantograph", "phantom_premium", "woodenhaptics"}) {
    EXPECT_EQ(hashes(*host::device_preset(name), *firmware::preset_config(name), 5),
              hashes(*host::device_preset(name), *firmware::preset_config(name), 5))
        << name;
  }
}

TEST(Determinism, AnotherSeedGivesOtherHashes) {
  EXPECT_NE(hashes(host::cartesian_preset(), firmware::cartesian_config(), 5).back(),
            hashes(host::cartesian_preset(), firmware::cartesian_config(), 6).back());
}

}  // namespace
}  // namespace tactus::testing
