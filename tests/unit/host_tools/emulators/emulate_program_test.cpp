// `tactus emulate`, as a user runs it.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/run_program.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::Outcome;
using testing::TemporaryFolder;

bool contains_text(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

class EmulateProgram : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) {
    return testing::run_program(folder.path(), "emulate " + arguments);
  }
  void expect_refused(const std::string& arguments, std::string_view message) {
    const Outcome result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(contains(result.output, message));
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
  }
  TemporaryFolder folder;
};

TEST_F(EmulateProgram, SaysWhatIsWrongInOneLine) {
  expect_refused("", "tactus emulate: say which device: odrive");
  expect_refused("toaster", "toaster");
  expect_refused("odrive", "--can is required");
  expect_refused("odrive --can nocan7 --nodes 0,63", "--nodes: 63 is no address");
  expect_refused("odrive --can nocan7 --nodes 1,1", "--nodes: 1 is named twice");
  expect_refused("odrive --can nocan7 --firmware 0.4", "no ODrive firmware '0.4'");
  expect_refused("haply", "say where");
  expect_refused("haply --tty /dev/null --pty", "say where");
  expect_refused("haply --tty /nowhere", "/nowhere: no such device");
  expect_refused("moteus --can nocan7 --nodes 0", "--nodes: 0 is no address");
  expect_refused("cia402 --can nocan7 --nodes 128", "--nodes: 128 is no address");
  expect_refused("cia402 --can nocan7 --encoder magnetic --no-watchdog", "no encoder 'magnetic'");
  expect_refused("vesc --can nocan7 --nodes 255", "--nodes: 255 is no address");
  expect_refused("vesc --can nocan7 --pole-pairs 0", "--pole-pairs");
  expect_refused("falcon --function-fs /nowhere", "/nowhere/ep0");
  expect_refused("paddle --pins encoder_a=0", "an encoder has two lines");
  expect_refused("paddle --pins encoder_c=0", "there is no 'encoder_c'");
  expect_refused("paddle --bridge half", "--bridge: there is no 'half'");
  expect_refused("paddle --torque-law cubic", "--torque-law: there is no 'cubic'");
  expect_refused("haply --pty --gadget /nowhere", "/nowhere/UDC");
  const std::string haply = "haply --pty --seconds 0.1 ";
  expect_refused(haply + "--mechanism toaster", "--mechanism: there is no 'toaster'");
  expect_refused(haply + "--hand glove", "--hand: there is no 'glove'");
  expect_refused(haply + "--path wish.csv", "say whose with --hand");
  expect_refused(haply + "--hand pen --path wish.csv", "wish.csv: no such file");
  expect_refused(haply + "--ratio 1,2,3", "--ratio: write one number for all joints or 2");
  expect_refused(haply + "--ratio 0", "--ratio must be positive");
  expect_refused(haply + "--direction 2", "--direction 1 or -1");
  expect_refused(haply + "--origin 1,2", "--origin: write three numbers");
  expect_refused(haply + "--fault 2:silent@0", "this device has the axes 0 to 1");
  expect_refused(haply + "--fault 1:mute@0", "no fault 'mute'");
  expect_refused(haply + "--truth /nowhere/truth.csv", "/nowhere/truth.csv: cannot write");
  expect_refused(haply + "--seconds 0", "--seconds");
  expect_refused(haply + "--realtime 100", "--realtime");
}

// The message depends on whether this machine's kernel has CAN.
TEST_F(EmulateProgram, SaysHowToGetACanInterface) {
  const bool has_can = !contains_text(run("odrive --can lo").output, "no raw CAN");
  expect_refused("odrive --can lo",
                 has_can ? "'lo' is not a CAN interface" : "as root: modprobe can-raw");
  expect_refused("odrive --can nocan7", has_can ? "no interface 'nocan7'; make a virtual one"
                                                : "as root: modprobe can-raw");
}

TEST_F(EmulateProgram, RunsForItsTimeAndLeavesTheTruth) {
  (void)folder.write("wish.csv", "t_s,x_m,y_m,z_m\n0,0,0,0\n0.1,0.01,0,0\n");
  const Outcome result =
      run("haply --pty --hand pen --path wish.csv --offset -0.1,0.2 --fault all:silent@0.1 "
          "--seconds 0.2 --truth truth.csv");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_TRUE(result.output.starts_with("emulating a Haply board on /dev/"));
  EXPECT_TRUE(contains(result.output, "mechanism haply_pantograph, hand pen"));
  EXPECT_TRUE(contains(result.output, "truth.csv: "));
}

TEST_F(EmulateProgram, HelpEndsInExamples) {
  for (const char* const device :
       {"", "odrive ", "moteus ", "cia402 ", "vesc ", "falcon ", "haply ", "paddle "}) {
    const Outcome result = run(std::string(device) + "--help");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_TRUE(contains(result.output, "Examples"));
    EXPECT_TRUE(contains(result.output, "tactus emulate odrive --can vcan0 --nodes 0,1,2"));
  }
}

}  // namespace
}  // namespace tactus::host
