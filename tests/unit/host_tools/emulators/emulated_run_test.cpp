#include "host_tools/emulators/emulated_run.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "host_tools/csv/csv_table.h"
#include "host_tools/input_error.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

constexpr hal::TimeNs kMs = 1'000'000;

struct RunBench {
  explicit RunBench(const EmulatedRunConfig& config) : machine({}, 0) {
    for (EmulatedShaft& shaft : shafts) {
      machine.connect({.shaft = &shaft, .set_fault = [](EmulatorFault) {}});
    }
    run.emplace(machine, config);
  }
  std::array<EmulatedShaft, 3> shafts{};
  EmulatedMachine machine;
  std::optional<EmulatedRun> run;
};

TEST(EmulatedRun, FaultsComeAtTheirTimesInWhateverOrderTheyAreGiven) {
  RunBench bench(
      {.faults = {parse_planned_fault("all:none@0.03"), parse_planned_fault("1:silent@0.01"),
                  parse_planned_fault("all:delayed@0.02")}});
  for (int tick = 0; tick < 40; ++tick) {
    bench.run->run(tick * kMs);
    const auto& fault = bench.machine.truth().fault;
    const bool is_delayed = tick >= 20 && tick < 30;
    EXPECT_EQ(fault[0], is_delayed ? EmulatorFault::delayed : EmulatorFault::none) << tick;
    EXPECT_EQ(fault[1], is_delayed                 ? EmulatorFault::delayed
                        : tick >= 10 && tick <= 19 ? EmulatorFault::silent
                                                   : EmulatorFault::none)
        << tick;
  }
}

TEST(EmulatedRun, RefusesAFaultOfAnAxisThatIsNotThere) {
  EXPECT_THROW(RunBench({.faults = {parse_planned_fault("3:silent@1")}}), InputError);
}

TEST(EmulatedRun, KeepsTheTruthOfEveryMillisecond) {
  RunBench bench({.truth_period_ns = kMs});
  bench.run->run(5 * kMs + 700'000);
  ASSERT_EQ(bench.run->truth().size(), 6U);
  EXPECT_EQ(bench.run->truth()[5].time_ns, 5 * kMs);
}

TEST(EmulatedRun, MakesUpForASmallDelayAndLeavesOutALargeOne) {
  RunBench bench({.truth_period_ns = kMs});
  bench.run->run(0);
  bench.run->run(20 * kMs);
  EXPECT_EQ(bench.run->truth().size(), 21U);
  EXPECT_EQ(bench.run->left_out_ns(), 0);
  EXPECT_EQ(bench.run->longest_delay_ns(), 20 * kMs - 100'000);
  bench.run->run(200 * kMs);
  EXPECT_EQ(bench.run->truth().size(), 22U);
  EXPECT_EQ(bench.run->left_out_ns(), 180 * kMs - 100'000);
}

// A listener may be run rarely, since it acts on messages; those that have arrived have so after
// the steps that are made up for.
TEST(EmulatedRun, ADeviceThatListensIsRunInTheLastStepAndOnceAMillisecond) {
  RunBench bench({});
  std::vector<hal::TimeNs> heard_ns;
  std::vector<hal::TimeNs> stepped_ns;
  bench.machine.add_device([&](hal::TimeNs now_ns) { stepped_ns.push_back(now_ns); });
  bench.machine.add_listener([&](hal::TimeNs now_ns) { heard_ns.push_back(now_ns); }, 7);
  for (const hal::TimeNs now_ns : {0, 750'000, 790'000, 2'500'000}) {
    bench.run->run(now_ns);
  }
  EXPECT_EQ(heard_ns, (std::vector<hal::TimeNs>{0, 700'000, 1'700'000, 2'500'000}));
  ASSERT_EQ(stepped_ns.size(), 26U);
  EXPECT_EQ(stepped_ns.back(), 2'500'000);
}

// A torque that a message brings acts from when it came on, and not in the steps before.
TEST(EmulatedRun, ATorqueThatIsHeardLateDoesNotActOnWhatWasBefore) {
  RunBench late({.truth_period_ns = 100'000});
  RunBench never({.truth_period_ns = 100'000});
  late.machine.add_listener([&](hal::TimeNs now_ns) { late.shafts[0].torque_Nm = now_ns > 0; }, 7);
  for (RunBench* bench : {&late, &never}) {
    bench->run->run(0);
    bench->run->run(900'000);
    bench->run->run(1'000'000);
  }
  ASSERT_EQ(late.run->truth().size(), 11U);
  EXPECT_EQ(late.run->truth()[9].handle_p_B, never.run->truth()[9].handle_p_B);
  EXPECT_NE(late.run->truth()[10].handle_p_B, never.run->truth()[10].handle_p_B);
}

TEST(EmulatedRun, TruthFileHasAColumnForEverythingAboutEachJoint) {
  testing::TemporaryFolder folder;
  RunBench bench({.faults = {parse_planned_fault("2:erroring@0.002")}, .truth_period_ns = kMs});
  bench.shafts[1].torque_Nm = 0.25;
  bench.run->run(9 * kMs);
  const auto file = folder.path() / "truth.csv";
  write_truth(file, bench.run->truth(), 3);
  const std::array<std::string_view, 8> columns = {
      "t_ns",    "joint_1",    "joint_2_velocity", "shaft_1_torque_Nm",
      "fault_2", "handle_y_m", "motor_force_y_N",  "hand_force_z_N"};
  const CsvTable table = CsvTable::read(file, columns);
  ASSERT_EQ(table.rows(), 10U);
  EXPECT_EQ(table.column("t_ns")[9], 9e6);
  EXPECT_EQ(table.column("shaft_1_torque_Nm")[9], 0.25);
  EXPECT_EQ(table.column("motor_force_y_N")[9], 0.25);  // a cartesian device, ratio 1
  EXPECT_EQ(table.column("fault_2")[1], 0.0);
  EXPECT_EQ(table.column("fault_2")[2], static_cast<double>(EmulatorFault::erroring));
  EXPECT_NEAR(table.column("joint_1")[9], table.column("handle_y_m")[9], 1e-9);
  EXPECT_GT(table.column("joint_1")[9], 0.0);
}

TEST(EmulatedRun, TruthFileThatCannotBeWrittenIsTheUsersMatter) {
  EXPECT_THROW(write_truth("/nowhere/truth.csv", {}, 3), InputError);
}

}  // namespace
}  // namespace tactus::host
