// `tactus sim` with several devices, as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "host_tools/files/atomic_file.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

class SeveralDevicesSimTest : public FolderTest {
 protected:
  void SetUp() override { run("bake '" + kGrasp + "/scene.toml' -o grasp.tactus"); }

  // Runs the program, and returns what it printed.
  std::string run(const std::string& arguments, int exit_code = 0) {
    const testing::Outcome outcome = testing::run_program(folder(), arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << "\n" << outcome.output;
    return outcome.output;
  }
  std::string sim(const std::string& arguments, int exit_code = 0) {
    return run(fmt::format("sim grasp.tactus --device falcon --hand firm --path '{0}/thumb.csv' "
                           "--path '{0}/finger.csv' {1}",
                           kGrasp, arguments),
               exit_code);
  }
  // Returns the number of lines of a file.
  std::ptrdiff_t lines(const std::string& name) {
    return std::ranges::count(read_file(file(name)), '\n');
  }

  const std::string kGrasp = testing::in_repository("host_tools/examples/grasp");
};

TEST_F(SeveralDevicesSimTest, WritesTheFilesOfEachAndOfTheBodies) {
  const std::string output = sim(
      "--seconds 1 -o run.csv --hashes hashes.csv --record run.mcap --explain steps.csv --bodies "
      "bodies.csv --body-energy energy.csv");
  EXPECT_NE(output.find("device 1:\n"), std::string::npos) << output;
  EXPECT_NE(output.find("device 2:\n"), std::string::npos) << output;
  for (const char* const name : {"run.csv", "run.2.csv", "hashes.csv", "hashes.2.csv"}) {
    EXPECT_EQ(lines(name), 1001) << name;
  }
  EXPECT_EQ(lines("bodies.csv"), 1001);  // one body
  EXPECT_EQ(lines("energy.csv"), 1001);
  EXPECT_GT(lines("steps.2.csv"), 1001);
  EXPECT_NE(run("replay run.mcap run.2.mcap").find("ticks 0 to 999"), std::string::npos);
  EXPECT_NE(run("replay run.2.mcap", 2).find("device 2 of 2"), std::string::npos);
  EXPECT_NE(run("replay run.mcap run.2.mcap --set max_force_N=1", 2).find("one device"),
            std::string::npos);
}

TEST_F(SeveralDevicesSimTest, StopsAllForAFaultOfOne) {
  const std::string output = sim("--seconds 1.5 --fault 2:estop@1");
  EXPECT_NE(output.find("another device of this controller"), std::string::npos) << output;
  EXPECT_NE(output.find("emergency stop"), std::string::npos) << output;
}

TEST_F(SeveralDevicesSimTest, RefusesWhatDoesNotGoTogether) {
  EXPECT_NE(run("sim grasp.tactus --device falcon --device falcon", 2).find("need a path each"),
            std::string::npos);
  EXPECT_NE(sim("--device falcon --device falcon", 2).find("3 devices and 2 --path"),
            std::string::npos);
  EXPECT_NE(sim("--hand pen --hand pen", 2).find("give one for each path"), std::string::npos);
  EXPECT_NE(sim("--fault 3:estop@1", 2).find("there are 2 devices"), std::string::npos);
  EXPECT_NE(sim("--seconds 0.1 -o /dev/stdout", 2).find("name a file"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file("run.csv")));
}

}  // namespace
}  // namespace tactus::host
