// The program tactusd before two boards that keep their torque.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "host_tools/remote/remote.h"
#include "host_tools/remote/reply_fields.h"
#include "tests/support/run_program.h"
#include "tests/unit/firmware/linux/tactusd/tactusd_bench.h"

namespace tactus::firmware {
namespace {

namespace fs = std::filesystem;
using testing::start_pushing;
using testing::TactusdBench;
using testing::wait_for_end;

std::string mode_in(const fs::path& run_dir) {
  return host::field_of(host::Remote(run_dir).send("status").text, "mode").value_or("");
}

std::string faults_in(const fs::path& run_dir) {
  return host::field_of(host::Remote(run_dir).send("status").text, "faults").value_or("");
}

// Waits until no board has torque; what is on the lines has then arrived.
bool loses_torque(const TactusdBench& bench) {
  for (int i = 0; i < 200 && bench.torque_Nm() != 0.0; ++i) {
    ::usleep(10'000);
  }
  return bench.torque_Nm() == 0.0;
}

TEST(TactusdWithTwoDevices, HasSocketsForEachAndOneScene) {
  const auto [bench, process] = start_pushing(2);
  const fs::path first = bench->folder();
  const fs::path second = first / "2";
  EXPECT_EQ(mode_in(first), "active") << bench->log();
  EXPECT_EQ(mode_in(second), "active") << bench->log();

  host::Remote remote(second);
  EXPECT_TRUE(remote.send("set max_force_N 1.5").is_ok);
  EXPECT_EQ(host::field_of(remote.send("get max_force_N").text, "max_force_N"), "1.5");
  EXPECT_NE(host::field_of(host::Remote(first).send("get max_force_N").text, "max_force_N"), "1.5");

  for (const char* const line :
       {"scene scene.tactus", "set object.wall.stiffness_N_per_m 100", "get object.0.contact"}) {
    const host::Reply reply = remote.send(line);
    EXPECT_FALSE(reply.is_ok) << line;
    EXPECT_NE(reply.text.find("first device"), std::string::npos) << reply.text;
  }
  EXPECT_TRUE(host::Remote(first).send("set object.wall.stiffness_N_per_m 100").is_ok);
  ::kill(process, SIGTERM);
  EXPECT_EQ(wait_for_end(process), 0) << bench->log();
  EXPECT_EQ(bench->torque_Nm(), 0.0);
}

TEST(TactusdWithTwoDevices, AreFoundByTheNamesOfTheirImages) {
  const auto [bench, process] = start_pushing(2);
  const auto tactus = [&](const std::string& words) {
    return testing::run_program(bench->folder(), words + " --run-dir .");
  };
  EXPECT_EQ(tactus("set max_force_N 1.5 --device device2").exit_code, 0);
  EXPECT_EQ(tactus("set max_force_N 1.25 --device device").exit_code, 0);
  EXPECT_NE(tactus("get max_force_N --device 2").output.find("1.5"), std::string::npos);
  EXPECT_NE(tactus("get max_force_N").output.find("1.25"), std::string::npos);

  const testing::Outcome unknown = tactus("status --device thumb");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.output.find("\"thumb\""), std::string::npos) << unknown.output;
  EXPECT_NE(unknown.output.find("device, device2"), std::string::npos) << unknown.output;
  EXPECT_NE(tactus("status --device 11").output.find("10"), std::string::npos);
  ::kill(process, SIGTERM);
  EXPECT_EQ(wait_for_end(process), 0) << bench->log();
}

TEST(TactusdWithTwoDevices, AStopOfOneTakesTheTorqueFromBoth) {
  const auto [bench, process] = start_pushing(2);
  EXPECT_TRUE(host::send_stop(bench->folder() / "2").is_ok);
  EXPECT_TRUE(loses_torque(*bench)) << bench->log();
  EXPECT_EQ(faults_in(bench->folder() / "2"), "operator_stop");
  EXPECT_EQ(faults_in(bench->folder()), "other_device");
  ::kill(process, SIGTERM);
  EXPECT_EQ(WEXITSTATUS(wait_for_end(process)), 1) << bench->log();
  EXPECT_NE(bench->log().find("device2.tactus is in mode fault"), std::string::npos)
      << bench->log();
}

TEST(TactusdWithTwoDevices, NoEndLeavesTorqueOnEither) {
  for (const int signal : {SIGINT, SIGSEGV}) {
    const auto [bench, process] = start_pushing(2);
    ::kill(process, signal);
    const int status = wait_for_end(process);
    EXPECT_TRUE(signal == SIGINT ? WIFEXITED(status) : WIFSIGNALED(status)) << status;
    EXPECT_TRUE(loses_torque(*bench)) << signal << bench->log();
  }
}

TEST(TactusdWithTwoDevices, RecordsBothSoThatTheyReplayTogetherAndSoDoTheirFlights) {
  const auto [bench, process] = start_pushing(2, {"--record", "run.mcap"});
  EXPECT_TRUE(host::send_stop(bench->folder()).is_ok);
  EXPECT_TRUE(loses_torque(*bench)) << bench->log();
  ::usleep(500'000);  // the ticks after the fault, and the thread that writes them
  ::kill(process, SIGTERM);
  EXPECT_EQ(WEXITSTATUS(wait_for_end(process)), 1) << bench->log();

  const auto replayed = testing::run_program(bench->folder(), "replay run.mcap run.2.mcap");
  EXPECT_EQ(replayed.exit_code, 0) << replayed.output;

  std::vector<std::string> flights;
  for (const auto& entry : fs::directory_iterator(bench->folder())) {
    if (entry.path().filename().string().starts_with("flight-")) {
      flights.push_back(entry.path().filename().string());
    }
  }
  ASSERT_EQ(flights.size(), 2U) << bench->log();
  // "flight-TIME-TICK.mcap" is longer than no other: the first device's name comes first by length.
  std::ranges::sort(flights, {}, [](const std::string& name) { return name.size(); });
  const auto flown =
      testing::run_program(bench->folder(), "replay " + flights[0] + " " + flights[1]);
  EXPECT_EQ(flown.exit_code, 0) << flown.output;
}

TEST(TactusdWithTwoDevices, DoesNotStartWithOneBoardForBoth) {
  const TactusdBench bench;
  const int status = wait_for_end(bench.start({"device.tactus"}));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  const std::string log = bench.log();
  EXPECT_NE(log.find("port is also that of connection \"usb\" of device 1"), std::string::npos)
      << log;
}

TEST(TactusdWithTwoDevices, TakesOneSceneOnly) {
  const TactusdBench bench;
  const int status = wait_for_end(bench.start({"scene.tactus"}));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_NE(bench.log().find("one scene is all that fits"), std::string::npos) << bench.log();
}

}  // namespace
}  // namespace tactus::firmware
