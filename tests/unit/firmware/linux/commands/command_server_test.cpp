#include "firmware/linux/commands/command_server.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host_tools/remote/remote.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::firmware {
namespace {

using host::Remote;
using host::Reply;

std::filesystem::path new_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "tactus-XXXXXX").string();
  EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
  return pattern;
}

// A server before a controller whose loop runs in a thread, as fast as it comes.
class CommandServerTest : public ::testing::Test {
 public:
  CommandServerTest(const CommandServerTest&) = delete;
  CommandServerTest& operator=(const CommandServerTest&) = delete;
  ~CommandServerTest() override {
    server_->stop();
    stop_loop();
    std::filesystem::remove_all(folder_);
  }

 protected:
  CommandServerTest() {
    EXPECT_TRUE(controller_->configure(cartesian_config()));
    write_scene("left.tactus", testing::small_scene());
    const auto scene = scenes_->open_next((folder_ / "left.tactus").string());
    EXPECT_TRUE(scene);
    EXPECT_TRUE(controller_->load_scene((*scene)->objects(), {.tool_radius_m = 0.002}));
    scenes_->use_next();
  }

  void write_scene(const std::string& name, const host::BakedScene& scene) {
    const std::vector<std::byte> image = host::write_image(scene);
    std::ofstream file(folder_ / name, std::ios::binary);
    for (const std::byte byte : image) {
      file.put(static_cast<char>(byte));
    }
  }

  void serve(CommandServerConfig config = {}) {
    socket_path_ = (folder_ / host::kCommandSocket).string();
    config.socket_path = socket_path_.c_str();
    const auto started = server_->start(config);
    ASSERT_TRUE(started) << started.error().what;
  }

  void start_loop() {
    looping_ = true;
    loop_ = std::thread([this] {
      drivers::JointSample sample;
      sample.position = {0.0, 0.2, 0.0};
      while (looping_) {
        controller_->tick(sample, queue_->before_tick(*controller_));
        queue_->after_tick(*controller_);
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
    });
  }

  void stop_loop() {
    looping_ = false;
    if (loop_.joinable()) {
      loop_.join();
    }
  }

  void start() {
    serve();
    start_loop();
  }

  // Programs that ask and do not wait for the answer.
  void ask_and_go(std::size_t programs) {
    for (std::size_t i = 0; i < programs; ++i) {
      Remote remote(folder_);
      EXPECT_THROW(remote.send("status", std::chrono::milliseconds(0)), host::UnreachableError);
    }
  }

  std::string say(const std::string& line) { return Remote(folder_).send(line).text; }

  std::filesystem::path folder_ = new_folder();
  std::string socket_path_;
  std::unique_ptr<Controller> controller_ = std::make_unique<Controller>();
  std::unique_ptr<CommandQueue> queue_ = std::make_unique<CommandQueue>();
  std::unique_ptr<SceneStore> scenes_ = std::make_unique<SceneStore>();
  std::unique_ptr<CommandServer> server_ = std::make_unique<CommandServer>(*queue_, *scenes_);
  std::atomic<bool> looping_{false};
  std::thread loop_;
};

bool begins(const std::string& text, std::string_view start) {
  return text.starts_with(start);
}

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
  CommandServer second(*queue_, *scenes_);
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

TEST_F(CommandServerTest, AnObjectsParameterIsSetByName) {
  start();
  EXPECT_TRUE(begins(say("set object.right.stiffness_N_per_m 250"), "ok set tick="));
  const std::string read = say("get object.1.stiffness_N_per_m");
  EXPECT_EQ(host::field_of(read, "object.1.stiffness_N_per_m"), "250");
  EXPECT_EQ(say("set object.middle.stiffness_N_per_m 1"),
            "refused set: the scene has no such object; send list");
  EXPECT_EQ(say("set max_force_N nan"), "refused set: the value is not a finite number");
  EXPECT_EQ(say("set max_force_N 11"), "refused set: the value is out of its range, 0 to 10");
}

// Two potential fields in one place, whose forces add up.
host::BakedScene fields_in_one_place(double left_N_per_m, double right_N_per_m) {
  host::BakedScene scene = testing::small_scene();
  for (host::BakedObject& object : scene.objects) {
    object.contact = rendering::ContactMethod::potential_field;
    object.material = {};
  }
  scene.objects[0].material.stiffness_N_per_m = left_N_per_m;
  scene.objects[1].material.stiffness_N_per_m = right_N_per_m;
  return scene;
}

TEST_F(CommandServerTest, ARefusalByTheCertificateNamesWhatAddsUp) {
  ControllerConfig config = cartesian_config();
  config.certificate.count = 2;
  config.certificate.points[0] = {.stiffness_N_per_m = 1000.0};
  config.certificate.points[1] = {.damping_Ns_per_m = 4.0, .stiffness_N_per_m = 1000.0};
  ASSERT_TRUE(controller_->configure(config));
  start();
  write_scene("fields.tactus", fields_in_one_place(500.0, 300.0));
  write_scene("stiff.tactus", fields_in_one_place(500.0, 501.0));
  ASSERT_TRUE(begins(say("scene " + (folder_ / "fields.tactus").string()), "ok scene"));
  const std::string words =
      " are felt in one place and together have a stiffness of 1001 N/m, and the device is "
      "certified up to 1000 N/m with a damping of 0 N s/m; soften one of them or move them apart, "
      "certify a stiffer device with tactus certify, or take the risk with --allow-uncertified";
  EXPECT_EQ(say("set object.right.stiffness_N_per_m 501"),
            "refused set: object 'right' and object 'left'" + words);
  EXPECT_EQ(say("scene " + (folder_ / "stiff.tactus").string()),
            "refused scene: object 'left' and object 'right'" + words);
}

TEST_F(CommandServerTest, ARefusalAtAWallOfTheWorkspaceNamesItAndTheRemedy) {
  ControllerConfig config = cartesian_config();
  config.certificate.count = 2;
  config.certificate.points[0] = {.stiffness_N_per_m = 1000.0};
  config.certificate.points[1] = {.damping_Ns_per_m = 4.0, .stiffness_N_per_m = 1000.0};
  config.safety.workspace_lower_W = Vec3::Constant(-0.01);
  config.safety.workspace_upper_W = Vec3::Constant(0.01);
  config.safety.workspace_overrun_m = 1.0;
  ASSERT_TRUE(controller_->load_scene({}, {}));
  ASSERT_TRUE(controller_->configure(config));
  start();
  write_scene("soft.tactus", fields_in_one_place(499.0, 0.0));
  write_scene("stiff.tactus", fields_in_one_place(600.0, 0.0));
  ASSERT_TRUE(begins(say("scene " + (folder_ / "soft.tactus").string()), "ok scene"));
  EXPECT_EQ(say("scene " + (folder_ / "stiff.tactus").string()),
            "refused scene: object 'left' and the workspace's upper wall across x are felt in one "
            "place and together have a stiffness of 1100 N/m, and the device is certified up to "
            "1000 N/m with a damping of 1 N s/m; soften what is not a wall of the workspace or "
            "move it away from there, lower workspace_stiffness_N_per_m, certify a stiffer device "
            "with tactus certify, or take the risk with --allow-uncertified");
}

TEST_F(CommandServerTest, TheListHasEveryParameterWithItsRangeAndUnit) {
  start();
  const Reply list = Remote(folder_).send("list");
  EXPECT_EQ(list.text, "ok list");
  ASSERT_EQ(list.lines.size(), 5U + 2U * 4U);  // a cone has no viscous friction
  EXPECT_EQ(list.lines[0], "parameter max_force_N=10 least=0 greatest=10 unit=N");
  EXPECT_EQ(list.lines[5],
            "parameter object.0.stiffness_N_per_m=800 least=0 greatest=1e+06 unit=N/m object=left");
}

TEST_F(CommandServerTest, AnotherSceneIsTakenBetweenTwoTicks) {
  start();
  host::BakedScene scene = testing::small_scene();
  scene.objects.resize(1);
  scene.objects[0].name = "alone";
  write_scene("alone.tactus", scene);
  const std::string reply = say("scene " + (folder_ / "alone.tactus").string());
  EXPECT_TRUE(begins(reply, "ok scene tick=")) << reply;
  EXPECT_EQ(host::field_of(reply, "objects"), "1");
  EXPECT_TRUE(begins(say("get object.alone.damping_Ns_per_m"), "ok get"));
  EXPECT_TRUE(begins(say("get object.right.damping_Ns_per_m"), "refused"));
}

TEST_F(CommandServerTest, ASceneThatIsNoneLeavesTheOneInUse) {
  start();
  std::ofstream(folder_ / "bad.tactus") << "this is no image of a scene, as anybody can see";
  const std::string bad = say("scene " + (folder_ / "bad.tactus").string());
  EXPECT_TRUE(begins(bad, "refused scene: ")) << bad;
  const std::string missing = say("scene /no/such/file");
  EXPECT_EQ(missing, "refused scene: /no/such/file: cannot be read: No such file or directory");
  EXPECT_TRUE(begins(say("get object.right.damping_Ns_per_m"), "ok get"));
}

TEST_F(CommandServerTest, NoSceneIsTakenWhileActive) {
  start();
  Remote remote(folder_);
  remote.send("home");
  while (!remote.send("enable").is_ok) {
  }
  EXPECT_EQ(remote.send("scene " + (folder_ / "left.tactus").string()).text,
            "refused scene: the mode is active; send disable first");
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
