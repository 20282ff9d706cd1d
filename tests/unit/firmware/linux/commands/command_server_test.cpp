#include "firmware/linux/commands/command_server.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "host_tools/remote/remote.h"
#include "host_tools/remote/reply_fields.h"
#include "tests/unit/firmware/linux/commands/command_server_rig.h"

namespace tactus::firmware {
namespace {

using host::Remote;
using host::Reply;

TEST_F(CommandServerTest, TheDoorIsAFileForItsOwnerAndItsGroup) {
  serve();
  struct stat status{};
  ASSERT_EQ(::stat(socket_path_.c_str(), &status), 0);
  EXPECT_TRUE(S_ISSOCK(status.st_mode));
  EXPECT_EQ(status.st_mode & 0777U, 0660U);
  server_->stop();
  EXPECT_FALSE(std::filesystem::exists(socket_path_));
}

TEST_F(CommandServerTest, AnUnknownGroupIsRefusedAtTheStart) {
  socket_path_ = (folder_ / host::kCommandSocket).string();
  const auto started =
      server_->start({.socket_path = socket_path_.c_str(), .group = "no-such-group-of-tactus"});
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().what, "there is no such group; add it with groupadd --system");
  EXPECT_FALSE(std::filesystem::exists(socket_path_));
}

TEST_F(CommandServerTest, ASecondServerDoesNotTakeTheDoorAndADeadOneDoesNotHoldIt) {
  serve();
  CommandServer second(*queue_, scenes_.get());
  EXPECT_FALSE(second.start({.socket_path = socket_path_.c_str()}));
  server_->stop();
  {
    const hal::FileDescriptor dead(::socket(AF_UNIX, SOCK_STREAM, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::ranges::copy(socket_path_, static_cast<char*>(address.sun_path));
    ASSERT_EQ(::bind(dead.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  EXPECT_TRUE(second.start({.socket_path = socket_path_.c_str()}));
}

TEST_F(CommandServerTest, RequestsAreAnsweredWithTheirTick) {
  start();
  Remote remote(folder_);
  const Reply home = remote.send("home");
  EXPECT_TRUE(home.is_ok) << home.text;
  EXPECT_EQ(host::field_of(home.text, "mode"), "homing");
  while (host::field_of(remote.send("status").text, "mode") != "ready") {
  }
  const Reply enable = remote.send("enable");
  EXPECT_EQ(host::field_of(enable.text, "mode"), "active") << enable.text;
  EXPECT_GT(std::stoull(*host::field_of(enable.text, "tick")),
            std::stoull(*host::field_of(home.text, "tick")));
  EXPECT_EQ(host::field_of(remote.send("estop").text, "mode"), "fault");
  const Reply refused = remote.send("enable");
  EXPECT_FALSE(refused.is_ok);
  EXPECT_TRUE(refused.text.ends_with("the mode is fault (operator_stop); send reset first"))
      << refused.text;
}

TEST_F(CommandServerTest, AServerWithoutTheSceneRefusesItsObjectsAndServesItsDevice) {
  server_ = std::make_unique<CommandServer>(*queue_, nullptr);
  start();
  const std::string words =
      "the scene and its objects belong to the first device; send it there, without --device";
  EXPECT_EQ(say("scene " + (folder_ / "left.tactus").string()), "refused scene: " + words);
  EXPECT_EQ(say("set object.0.stiffness_N_per_m 250"), "refused set: " + words);
  EXPECT_EQ(say("get object.left.stiffness_N_per_m"), "refused get: " + words);
  EXPECT_TRUE(begins(say("set max_force_N 4"), "ok set tick="));
  EXPECT_FALSE(host::field_of(say("status"), "scene"));
  for (const std::string& line : Remote(folder_).send("list").lines) {
    EXPECT_FALSE(line.contains("object.")) << line;
  }
}

TEST_F(CommandServerTest, AnEstopIsHeardBeforeWhatItsProgramStillWaitsFor) {
  serve();
  Remote busy(folder_);
  // Nothing ticks: `get` waits, and the estop stands behind it in the same bytes.
  std::thread sender([&] { busy.send("get max_force_N\nestop"); });
  while (queue_->before_tick(*controller_) != Request::estop) {
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  start_loop();
  sender.join();
}

TEST_F(CommandServerTest, ALoopThatDoesNotAnswerIsToldOf) {
  serve();
  EXPECT_EQ(say("status"), "refused status: the loop has not answered for a second; see its log");
}

TEST_F(CommandServerTest, TheEndIsToldToWhoeverWaits) {
  serve();
  std::string reply;
  std::thread waiting([&] { reply = say("status"); });
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  server_->stop();
  waiting.join();
  EXPECT_EQ(reply, "refused status: the program ends");
}

TEST_F(CommandServerTest, LinesThatAreNoCommandsAreRefusedAndTheNextOneIsTaken) {
  start();
  Remote remote(folder_);
  EXPECT_EQ(remote.send("fly").text, "refused fly: there is no such command; send help");
  EXPECT_EQ(remote.send(std::string(5000, 'x')).text,
            "refused line: it is longer than 511 characters");
  EXPECT_TRUE(remote.send("status").is_ok);
  EXPECT_EQ(remote.send("inject lost").text,
            "refused inject: this controller takes no faults from outside; start it with "
            "--allow-inject");
  EXPECT_EQ(remote.send("record off").text, "refused record: nothing here records");
}

TEST_F(CommandServerTest, TheOneThatHasBeenSilentLongestMakesRoomForANewOne) {
  start();
  std::vector<std::unique_ptr<Remote>> programs;
  for (std::size_t i = 0; i < kMaxCommandClients; ++i) {
    programs.push_back(std::make_unique<Remote>(folder_));
    EXPECT_TRUE(programs.back()->send("status").is_ok);
  }
  EXPECT_TRUE(begins(say("estop"), "ok estop"));
  EXPECT_THROW(programs.front()->send("status"), host::UnreachableError);
  EXPECT_TRUE(programs.back()->send("status").is_ok);
}

TEST_F(CommandServerTest, ManyProgramsAtOnceGetEachItsOwnAnswer) {
  start();
  std::vector<std::thread> programs;
  std::atomic<int> wrong{0};
  constexpr int kPrograms = 6;
  programs.reserve(kPrograms);
  for (int program = 0; program < kPrograms; ++program) {
    programs.emplace_back([this, program, &wrong] {
      Remote remote(folder_);
      const std::string value = std::to_string(100 + program);
      for (int i = 0; i < 50; ++i) {
        const Reply reply = remote.send("set object.left.stiffness_N_per_m " + value);
        wrong += host::field_of(reply.text, "object.0.stiffness_N_per_m") == value ? 0 : 1;
      }
    });
  }
  for (std::thread& program : programs) {
    program.join();
  }
  EXPECT_EQ(wrong, 0);
}

struct FakeRecorder {
  std::string file;
};

TEST_F(CommandServerTest, RecordingIsSwitchedByWhoeverRecords) {
  FakeRecorder recorder;
  serve(
      {.hooks = {.run = &recorder,
                 .start_recording =
                     [](void* run, std::string_view file) {
                       static_cast<FakeRecorder*>(run)->file = file;
                       return std::string_view{};
                     },
                 .stop_recording = [](void*) { return std::string_view("nothing is recorded"); }}});
  start_loop();
  EXPECT_TRUE(begins(say("record on press.mcap"), "ok record tick="));
  EXPECT_EQ(recorder.file, "press.mcap");
  EXPECT_EQ(say("record off"), "refused record: nothing is recorded");
}

TEST_F(CommandServerTest, ADeviceThatMayNotBeEnabledSaysWhyAndStaysReady) {
  serve({.hooks = {.enable_refusal = "this device was not commissioned"}});
  start_loop();
  EXPECT_TRUE(begins(say("home"), "ok home"));
  EXPECT_EQ(say("enable"), "refused enable: this device was not commissioned");
  EXPECT_EQ(say("status").find("mode=active"), std::string::npos);
}

TEST_F(CommandServerTest, HomingSaysWhatTheUserDoes) {
  serve({.hooks = {.homing_hint = "hold 'left' still at 180 deg"}});
  start_loop();
  const std::string reply = say("home");
  EXPECT_TRUE(begins(reply, "ok home"));
  EXPECT_NE(reply.find(" mode=homing hint=\"hold 'left' still at 180 deg\""), std::string::npos)
      << reply;
}

TEST_F(CommandServerTest, AProgramThatGoesMidwayHurtsNobody) {
  start();
  ask_and_go(20);
  EXPECT_TRUE(begins(say("status"), "ok status"));
}

TEST_F(CommandServerTest, ACommandWaitsForItsPlaceBehindThoseOfProgramsThatWent) {
  serve();
  ask_and_go(3 * kMaxWaiting);
  std::thread late_loop([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    start_loop();
  });
  EXPECT_TRUE(begins(say("status"), "ok status"));
  late_loop.join();
}

TEST_F(CommandServerTest, ALoopThatStandsStillIsNamedHoweverManyWait) {
  serve();
  ask_and_go(3 * kMaxWaiting);
  EXPECT_EQ(say("get max_force_N"),
            "refused get: the loop has not answered for a second; see its log");
}

TEST(Remote, ADoorThatIsNotThereIsNamedWithTheRemedy) {
  try {
    const Remote remote("/no/such/folder");
    FAIL();
  } catch (const host::UnreachableError& error) {
    EXPECT_TRUE(begins(error.what(), "/no/such/folder/command.sock: no controller runs there"))
        << error.what();
  }
}

}  // namespace
}  // namespace tactus::firmware
