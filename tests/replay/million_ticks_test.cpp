// A million ticks of a simulated hand, device and controller, and the same ticks once more.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "host_tools/replay/replayer.h"
#include "host_tools/simulation/simulation.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

constexpr std::size_t kMillion = 1'000'000;
constexpr double kToolRadius_m = 0.002;

// Round and round over a bumpy ball for as long as it takes, pressing and letting go.
host::WishPath rounds(double seconds) {
  std::vector<host::Waypoint> points{{.t_s = 0.0, .p_W = {0.0, 0.0, 0.045}}};
  for (double t = 0.5; t < seconds + 1.0; t += 0.25) {
    const double depth = 0.034 - 0.012 * (0.5 + 0.5 * std::sin(0.9 * t));
    points.push_back({.t_s = t,
                      .p_W = {depth * std::sin(0.6 * std::sin(0.7 * t)),
                              depth * std::sin(0.5 * std::cos(1.1 * t)), depth}});
  }
  return host::WishPath(points);
}

TEST(Replay, OfAMillionTicksGivesEveryHashOnceMore) {
  const Solid ball(bumpy_sphere(0.03, 4, 0.03), rendering::Sides::one,
                   {.stiffness_N_per_m = 800.0,
                    .damping_Ns_per_m = 0.5,
                    .friction = rendering::cone_friction(0.6, 0.4)});
  const std::size_t ticks = share_of(kMillion);
  host::SimulationConfig config{.device = host::falcon_preset(),
                                .controller = firmware::falcon_config(),
                                .path = rounds(0.001 * static_cast<double>(ticks)),
                                .seed = 11};
  config.faults = {{.at_s = 3.0, .fault = host::DeviceFault::stale_sample, .ticks = 2}};
  host::Simulation simulation(config, {&ball.object(), 1}, kToolRadius_m);
  host::Replayer replayer({.config = simulation.config(),
                           .objects = {&ball.object(), 1},
                           .world = {.tool_radius_m = kToolRadius_m}});
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < ticks; ++i) {
    simulation.tick();
    const auto difference = replayer.repeat(simulation.record());
    ASSERT_FALSE(difference) << "tick " << difference->tick << ": " << difference->field << " was "
                             << difference->recorded << " and is now " << difference->replayed;
    contacts += simulation.record().contact != rendering::ContactKind::none ? 1U : 0U;
  }
  std::printf("%zu ticks, %zu in contact, last hash %016llx\n", ticks, contacts,
              static_cast<unsigned long long>(simulation.record().state_hash));
  EXPECT_GT(contacts, ticks / 5);
  EXPECT_EQ(simulation.record().faults, 0U);
}

}  // namespace
}  // namespace tactus::testing
