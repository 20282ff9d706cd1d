// A run is the same whatever file it is read from: the recording, a recorder's table, and the table
// of `tactus sim`, which other code writes with nine digits.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "host_tools/input_error.h"
#include "host_tools/plot/run_data.h"
#include "tests/support/folder_test.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

class RunReader : public FolderTest {
 protected:
  void run(const std::string& arguments) const {
    const testing::Outcome outcome = testing::run_program(folder(), arguments);
    ASSERT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.output;
  }
  // Simulates a touch with friction, from before homing on.
  void simulate() const {
    std::ofstream(file("scene.toml"))
        << "[[object]]\nname = \"ball\"\nprimitive = \"sphere\"\nradius_m = 0.03\n"
           "stiffness_N_per_m = 500.0\n[object.friction]\nstatic = 0.5\ndynamic = 0.3\n";
    run("bake --quiet scene.toml -o scene.tactus");
    run("sim scene.tactus --seconds 4 --record run.mcap -o sim.csv");
  }
};

TEST_F(RunReader, ARecordingIsTheTableOfTheSameRun) {
  simulate();
  const RunData recorded = read_run(file("run.mcap"));
  const RunData table = read_run(file("sim.csv"));
  ASSERT_EQ(recorded.rows.size(), table.rows.size());
  EXPECT_TRUE(recorded.has_commanded && table.has_commanded);
  EXPECT_FALSE(recorded.is_cut);
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const RunRow& a = recorded.rows[i];
    const RunRow& b = table.rows[i];
    ASSERT_NEAR(a.t_s, b.t_s, 1e-8);
    ASSERT_LT((a.proxy_W - b.proxy_W).norm(), 1e-8) << "row " << i;
    ASSERT_LT((a.force_W - b.force_W).norm(), 1e-7) << "row " << i;
    ASSERT_NEAR(a.force_N, b.force_N, 1e-7);
    ASSERT_NEAR(a.commanded_N, b.commanded_N, 1e-7);
    ASSERT_NEAR(a.depth_m, b.depth_m, 1e-8);
    ASSERT_EQ(a.contact, b.contact) << "row " << i;
    ASSERT_EQ(a.located, b.located) << "row " << i;
    ASSERT_EQ(a.friction, b.friction) << "row " << i;
    contacts += a.contact ? 1U : 0U;
  }
  EXPECT_GT(contacts, 100U);
}

TEST_F(RunReader, ARecordersTableIsItsRecordingToTheBit) {
  simulate();
  run("export run.mcap -o table.csv");
  const RunData recorded = read_run(file("run.mcap"));
  const RunData table = read_run(file("table.csv"));
  ASSERT_EQ(recorded.rows.size(), table.rows.size());
  EXPECT_TRUE(table.has_commanded);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    ASSERT_EQ(recorded.rows[i].t_s, table.rows[i].t_s);
    ASSERT_EQ(recorded.rows[i].proxy_W, table.rows[i].proxy_W);
    ASSERT_EQ(recorded.rows[i].force_W, table.rows[i].force_W);
    ASSERT_EQ(recorded.rows[i].commanded_N, table.rows[i].commanded_N);
    ASSERT_EQ(recorded.rows[i].located, table.rows[i].located) << "row " << i;
    ASSERT_EQ(recorded.rows[i].friction, table.rows[i].friction);
  }
}

TEST_F(RunReader, WordsOfAModeTellWhereTheToolIsKnown) {
  constexpr std::string_view kHeading =
      "time_s,mode,contact,friction,proxy_x_m,proxy_y_m,proxy_z_m,rendered_x_N,rendered_y_N,"
      "rendered_z_N,depth_m\n";
  std::ofstream(file("run.csv")) << kHeading << "0,init,0,0,0,0,0,0,0,0,0\n"
                                 << "1,homing,0,0,0,0,0,0,0,0,0\n"
                                 << "2,ready,0,0,0,0,0,0,0,0,0\n"
                                 << "3,fault,0,0,0,0,0,0,0,0,0\n";
  const RunData run = read_run(file("run.csv"));
  EXPECT_FALSE(run.has_commanded);
  ASSERT_EQ(run.rows.size(), 4U);
  EXPECT_FALSE(run.rows[0].located);
  EXPECT_FALSE(run.rows[1].located);
  EXPECT_TRUE(run.rows[2].located);
  EXPECT_TRUE(run.rows[3].located);
  std::ofstream(file("run.csv")) << kHeading << "0,asleep,0,0,0,0,0,0,0,0,0\n";
  EXPECT_THROW(read_run(file("run.csv")), InputError);
}

TEST_F(RunReader, TheProgramTakesTheSceneInsideARecording) {
  simulate();
  run("plot run.mcap -o inside_");
  run("plot run.mcap --scene scene.tactus -o given_");
  EXPECT_TRUE(std::filesystem::exists(file("inside__path.png")));
  const testing::Outcome same = testing::run_command(
      folder(), "cmp inside__path.png given__path.png && cmp inside__force.png given__force.png");
  EXPECT_EQ(same.exit_code, 0) << same.output;

  const testing::Outcome steps = testing::run_program(folder(), "plot run.mcap --explain --tick 5");
  EXPECT_EQ(steps.exit_code, 2);
  EXPECT_NE(steps.output.find("tactus replay run.mcap --explain steps.csv"), std::string::npos)
      << steps.output;
  const testing::Outcome table = testing::run_program(folder(), "plot sim.csv");
  EXPECT_EQ(table.exit_code, 2);
  EXPECT_NE(table.output.find("--scene is required"), std::string::npos) << table.output;
}

}  // namespace
}  // namespace tactus::host
