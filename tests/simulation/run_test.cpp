// A whole run, from the user's names to the summary.
#include "host_tools/simulation/run.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "host_tools/input_error.h"
#include "host_tools/simulation/wish_path_file.h"
#include "tests/simulation/slab_press.h"

namespace tactus::testing {
namespace {

TEST(Run, TheDefaultPathTouchesStrokesAndLeaves) {
  for (const char* device : {"cartesian", "falcon"}) {
    const Solid ball(icosphere(0.04, 4), rendering::Sides::one,
                     {.stiffness_N_per_m = 800.0,
                      .damping_Ns_per_m = 0.5,
                      .friction = rendering::cone_friction(0.6, 0.4)});
    const host::RunPlan plan =
        host::plan_run({.devices = {device}}, {&ball.object(), 1}, kToolRadius_m);
    EXPECT_TRUE(plan.warnings.empty());
    EXPECT_EQ(plan.seconds, 10.0);
    host::Simulation simulation(plan.devices, {&ball.object(), 1}, kToolRadius_m);
    const host::RunSummary summary =
        host::run(simulation, plan.seconds, 1000.0, [](const host::Simulation&) {}).front();
    EXPECT_EQ(summary.ticks, 10000U);
    EXPECT_EQ(summary.faults, 0U);
    EXPECT_GT(summary.contact_ticks, 5000U);
    EXPECT_LT(summary.contact_ticks, 8000U);
    EXPECT_GT(summary.slip_ticks, 300U);
    EXPECT_EQ(simulation.record().contact, rendering::ContactKind::none);
    // The wish lies 5 mm deep, more where the front slopes.
    EXPECT_LT(summary.max_depth_m, 0.005);
    EXPECT_NEAR(summary.max_force_N, 800.0 * summary.max_depth_m, 0.5 * summary.max_force_N);
  }
}

// The middle of a ring's box is its hole.
TEST(Run, TheDefaultPathFindsARingAndGoesOnAsLongAsTheRun) {
  const Solid ring(torus(0.03, 0.01, 64, 32), rendering::Sides::one, {.stiffness_N_per_m = 800.0});
  for (const char* device : {"cartesian", "hapkit"}) {
    const host::RunPlan plan =
        host::plan_run({.devices = {device}, .seconds = 25.0}, {&ring.object(), 1}, kToolRadius_m);
    host::Simulation simulation(plan.devices, {&ring.object(), 1}, kToolRadius_m);
    std::uint64_t late_ticks = 0;
    host::run(simulation, plan.seconds, 1000.0, [&](const host::Simulation& now) {
      const firmware::TelemetryRecord& record = now.record();
      late_ticks += record.time_s > 12.0 && record.contact != rendering::ContactKind::none ? 1 : 0;
    });
    EXPECT_GT(late_ticks, 5000U) << device;
  }
}

// A pantograph stays on its plane, a paddle presses on the right side and does not stroke.
TEST(Run, TheDefaultPathSuitsEveryMechanism) {
  for (const std::string_view device : firmware::kPresetNames) {
    const Solid ball(icosphere(0.04, 4), rendering::Sides::one,
                     {.stiffness_N_per_m = 800.0,
                      .damping_Ns_per_m = 0.5,
                      .friction = rendering::cone_friction(0.6, 0.4)});
    const host::RunPlan plan =
        host::plan_run({.devices = {std::string(device)}}, {&ball.object(), 1}, kToolRadius_m);
    EXPECT_TRUE(plan.warnings.empty()) << device;
    host::Simulation simulation(plan.devices, {&ball.object(), 1}, kToolRadius_m);
    const host::RunSummary summary =
        host::run(simulation, plan.seconds, 1000.0, [](const host::Simulation&) {}).front();
    EXPECT_EQ(summary.faults, 0U) << device;
    EXPECT_GT(summary.contact_ticks, 4000U) << device;
    EXPECT_LT(summary.max_depth_m, 0.005) << device;
    EXPECT_EQ(simulation.record().contact, rendering::ContactKind::none) << device;
  }
}

TEST(Run, TheSummaryNamesFaultsForPeopleAndPrograms) {
  const Solid wall = slab(0.6, 0.4);
  const host::RunPlan plan = host::plan_run({.seconds = 4.0, .faults = {"estop@3.5x10"}},
                                            {&wall.object(), 1}, kToolRadius_m);
  host::Simulation simulation(plan.devices, {&wall.object(), 1}, kToolRadius_m);
  const host::RunSummary summary =
      host::run(simulation, plan.seconds, 1000.0, [](const host::Simulation&) {}).front();
  EXPECT_NEAR(summary.first_fault_s, 3.5, 0.002);
  EXPECT_NE(host::summary_text(summary).find("emergency stop"), std::string::npos);
  EXPECT_NE(host::summary_json(summary).find(R"("faults":["emergency_stop"])"), std::string::npos);
  EXPECT_EQ(summary.mode, firmware::Mode::fault);
}

TEST(Run, FaultsAreReadFromText) {
  const auto [device, event] = host::parse_fault("stale@2.5x3");
  EXPECT_EQ(device, 0U);
  EXPECT_EQ(event.fault, host::DeviceFault::stale_sample);
  EXPECT_EQ(event.at_s, 2.5);
  EXPECT_EQ(event.ticks, 3U);
  EXPECT_EQ(host::parse_fault("nan@0").event.ticks, 1U);
  EXPECT_EQ(host::parse_fault("3:lost@4").device, 2U);
  for (const char* bad : {"", "stale", "stale@", "stale@x", "@2", "burn@2", "stale@2x", "stale@2x0",
                          "stale@-1", "stale@nan", "0:lost@1", ":lost@1", "x:lost@1"}) {
    EXPECT_THROW(host::parse_fault(bad), host::InputError) << bad;
  }
}

TEST(Run, UnknownNamesAndUselessNumbersAreRefused) {
  const Solid wall = slab(0.6, 0.4);
  const std::span<const rendering::Object> objects(&wall.object(), 1);
  EXPECT_THROW(host::plan_run({.devices = {"omega"}}, objects, kToolRadius_m), host::InputError);
  EXPECT_THROW(host::plan_run({.hands = {"paw"}}, objects, kToolRadius_m), host::InputError);
  EXPECT_THROW(host::plan_run({.compensated_share = 0.95}, objects, kToolRadius_m),
               host::InputError);
  EXPECT_THROW(host::plan_run({.seconds = 0.0}, objects, kToolRadius_m), host::InputError);
  EXPECT_THROW(host::plan_run({.paths = {"/no/such.csv"}}, objects, kToolRadius_m),
               host::InputError);
  const host::RunPlan slow = host::plan_run({.rate_hz = 10.0}, objects, kToolRadius_m);
  EXPECT_THROW(host::Simulation(slow.devices, objects, kToolRadius_m), host::InputError);
}

TEST(Run, APathBeyondTheStopsIsWarnedOf) {
  const Solid wall = slab(0.6, 0.4);
  const std::string file = ::testing::TempDir() + "tactus_wide_wish.csv";
  std::ofstream(file) << "t_s,x_m,y_m,z_m\n0,-0.2,0,0.05\n1,0.2,0,0.05\n";
  const host::RunPlan plan = host::plan_run({.paths = {file}}, {&wall.object(), 1}, kToolRadius_m);
  ASSERT_EQ(plan.warnings.size(), 1U);
  EXPECT_NE(plan.warnings[0].find("0.400 m along x"), std::string::npos) << plan.warnings[0];
  EXPECT_EQ(plan.seconds, 1.0);
}

TEST(Run, AWishPathThatGoesBackInTimeIsRefusedByLine) {
  const std::string file = ::testing::TempDir() + "tactus_backward_wish.csv";
  std::ofstream(file) << "t_s,x_m,y_m,z_m\n0,0,0,0\n1,0,0,0\n0.5,0,0,0\n";
  try {
    host::read_wish_path(file);
    FAIL() << "accepted";
  } catch (const host::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("backward_wish.csv:4: column t_s"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace tactus::testing
