#include "firmware/linux/commands/stop_listener.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "firmware/linux/commands/command_server.h"
#include "hal/linux/system.h"
#include "host_tools/remote/remote.h"
#include "host_tools/remote/reply_fields.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::firmware {
namespace {

using host::Reply;
using host::send_stop;

constexpr std::chrono::milliseconds kTick(1);
constexpr int kLoopPriority = 80;
constexpr hal::TimeNs kBlocked_ns = 3 * hal::kNsPerSecond;

// Sets the priority of tactusd's loop, if this process has the right to it.
void take_priority(int priority) {
  const sched_param wanted{.sched_priority = priority};
  (void)::sched_setscheduler(0, priority == 0 ? SCHED_OTHER : SCHED_FIFO, &wanted);
}

void print_histogram(const std::vector<hal::TimeNs>& times_ns) {
  constexpr std::array kEdges_ms{0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 1e9};
  std::printf("from the stop to the reply of the tick that had it, under load, %zu stops:\n",
              times_ns.size());
  double from_ms = 0.0;
  for (const double to_ms : kEdges_ms) {
    const auto inside = std::ranges::count_if(times_ns, [&](hal::TimeNs time_ns) {
      const double time_ms = static_cast<double>(time_ns) * 1e-6;
      return time_ms >= from_ms && time_ms < to_ms;
    });
    std::printf("  from %4.1f ms: %3d\n", from_ms, static_cast<int>(inside));
    from_ms = to_ms;
  }
  std::printf("  longest %.2f ms\n", static_cast<double>(std::ranges::max(times_ns)) * 1e-6);
}

// A loop of 1 kHz that homes and enables by itself, with commands and the stop before it.
class StopTest : public ::testing::Test {
 public:
  StopTest(const StopTest&) = delete;
  StopTest& operator=(const StopTest&) = delete;
  ~StopTest() override {
    looping_ = false;
    loop_.join();
    server_->stop();
    std::filesystem::remove_all(folder_);
  }

 protected:
  StopTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tactus-stop-XXXXXX").string();
    EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    EXPECT_TRUE(controller_->configure(cartesian_config()));
    const std::vector<std::byte> image = host::write_image(testing::small_scene());
    std::ofstream file(folder_ / "scene.tactus", std::ios::binary);
    for (const std::byte byte : image) {
      file.put(static_cast<char>(byte));
    }
    file.close();
    const std::string commands = (folder_ / host::kCommandSocket).string();
    const std::string stop = (folder_ / host::kStopSocket).string();
    const CommandServerConfig config{
        .socket_path = commands.c_str(),
        .stop_socket_path = stop.c_str(),
        .stop_priority = kLoopPriority - 1,
        .hooks = {.start_recording = block,
                  .stop_recording = [](void*) { return std::string_view{}; }}};
    EXPECT_TRUE(server_->start(config));
    loop_ = std::thread([this] { loop(); });
  }

  // Blocks the command thread for 3 s, like a disk that does not answer.
  static std::string_view block(void* /*run*/, std::string_view /*file*/) {
    std::this_thread::sleep_for(std::chrono::nanoseconds(kBlocked_ns));
    return {};
  }

  void loop() {
    take_priority(kLoopPriority);
    drivers::JointSample sample;
    sample.position = {0.0, 0.2, 0.0};
    while (looping_) {
      const Request asked = queue_->before_tick(*controller_);
      sample.status = homing_takes_long_ ? drivers::kDeviceNotReady : drivers::kDeviceOk;
      const Request by_itself =
          mode_ == Mode::fault ? Request::reset : request_toward_active(mode_);
      controller_->tick(sample, asked == Request::none && recovers_ ? by_itself : asked);
      queue_->after_tick(*controller_);
      mode_ = controller_->mode();
      std::this_thread::sleep_for(kTick);
    }
  }

  void wait_for(Mode mode) const {
    const hal::TimeNs until_ns = hal::monotonic_now_ns() + 10 * hal::kNsPerSecond;
    while (mode_ != mode && hal::monotonic_now_ns() < until_ns) {
      std::this_thread::sleep_for(kTick);
    }
    ASSERT_EQ(mode_, mode);
  }

  // One client that says a line as fast as it can, or connects anew for each, until the end.
  std::thread client(std::function<std::string()> line, bool anew) {
    return std::thread([this, line = std::move(line), anew] {
      while (loading_) {
        try {
          host::Remote remote(folder_);
          do {
            remote.send(line(), std::chrono::milliseconds(200));
          } while (loading_ && !anew);
        } catch (const host::UnreachableError&) {
          std::this_thread::sleep_for(kTick);
        }
      }
    });
  }

  std::filesystem::path folder_;
  std::unique_ptr<Controller> controller_ = std::make_unique<Controller>();
  std::unique_ptr<CommandQueue> queue_ = std::make_unique<CommandQueue>();
  std::unique_ptr<SceneStore> scenes_ = std::make_unique<SceneStore>();
  std::unique_ptr<CommandServer> server_ = std::make_unique<CommandServer>(*queue_, scenes_.get());
  std::atomic<bool> looping_{true};
  std::atomic<bool> loading_{true};
  std::atomic<bool> recovers_{true};
  std::atomic<bool> homing_takes_long_{false};
  std::atomic<Mode> mode_{Mode::init};
  std::thread loop_;
};

TEST_F(StopTest, IsAFileForItsOwnerAndItsGroup) {
  struct stat status{};
  ASSERT_EQ(::stat((folder_ / host::kStopSocket).c_str(), &status), 0);
  EXPECT_TRUE(S_ISSOCK(status.st_mode));
  EXPECT_EQ(status.st_mode & 0777U, 0660U);
  server_->stop();
  EXPECT_FALSE(std::filesystem::exists(folder_ / host::kStopSocket));
}

TEST_F(StopTest, IsAnsweredWithTheTickThatHadIt) {
  wait_for(Mode::active);
  recovers_ = false;
  const Reply reply = send_stop(folder_);
  EXPECT_TRUE(reply.is_ok) << reply.text;
  EXPECT_EQ(host::field_of(reply.text, "mode"), "fault");
  EXPECT_TRUE(host::field_of(reply.text, "tick")) << reply.text;
  EXPECT_EQ(mode_, Mode::fault);
}

TEST_F(StopTest, IsHeardWhileTheCommandThreadHangsInAFile) {
  wait_for(Mode::active);
  const hal::TimeNs before_ns = hal::monotonic_now_ns();
  std::thread blocked([this] {
    try {
      host::Remote(folder_).send("record on x.mcap", std::chrono::milliseconds(10'000));
    } catch (const host::UnreachableError& error) {
      EXPECT_STRNE(error.what(), "");  // it is not answered: the thread that would do so hangs
    }
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  // The command socket does not answer, the stop does.
  EXPECT_THROW(host::Remote(folder_).send("status", std::chrono::milliseconds(300)),
               host::UnreachableError);
  recovers_ = false;
  EXPECT_TRUE(send_stop(folder_).is_ok);
  EXPECT_EQ(mode_, Mode::fault);
  EXPECT_LT(hal::monotonic_now_ns() - before_ns, kBlocked_ns);
  // The end does not wait for it either.
  EXPECT_FALSE(server_->stop());
  EXPECT_LT(hal::monotonic_now_ns() - before_ns, kBlocked_ns);
  blocked.join();
  // The thread that was left alone uses the server until it returns.
  std::this_thread::sleep_for(
      std::chrono::nanoseconds(kBlocked_ns + 500'000'000 - (hal::monotonic_now_ns() - before_ns)));
}

TEST_F(StopTest, IsHeardDuringHoming) {
  homing_takes_long_ = true;
  wait_for(Mode::homing);
  recovers_ = false;
  EXPECT_TRUE(send_stop(folder_).is_ok);
  EXPECT_EQ(mode_, Mode::fault);
}

TEST_F(StopTest, TakesThePlaceOfEveryRequestThatWaits) {
  recovers_ = false;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::vector<std::thread> clients;
  clients.reserve(4);
  for (int i = 0; i < 4; ++i) {
    clients.push_back(client([] { return "home"; }, false));
  }
  for (int i = 0; i < 20; ++i) {
    const Reply reply = send_stop(folder_);
    EXPECT_TRUE(reply.is_ok) << reply.text;
    EXPECT_EQ(host::field_of(reply.text, "mode"), "fault") << reply.text;
  }
  loading_ = false;
  for (std::thread& each : clients) {
    each.join();
  }
}

TEST_F(StopTest, AnyDatagramIsAStopAndSendersWithoutAnAddressHurtNobody) {
  wait_for(Mode::active);
  recovers_ = false;
  const hal::FileDescriptor nameless(::socket(AF_UNIX, SOCK_DGRAM, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::ranges::copy((folder_ / host::kStopSocket).string(), static_cast<char*>(address.sun_path));
  ASSERT_EQ(::sendto(nameless.get(), "", 0, 0, reinterpret_cast<const sockaddr*>(&address),
                     sizeof address),
            0);
  wait_for(Mode::fault);
  EXPECT_TRUE(send_stop(folder_).is_ok);
}

TEST_F(StopTest, IsRefusedInWordsByALoopThatStandsStill) {
  looping_ = false;
  loop_.join();
  const Reply reply = send_stop(folder_);
  EXPECT_EQ(reply.text, "refused estop: the loop has not answered; cut the power");
  loop_ = std::thread([] {});
}

// The histogram is for people; a busy machine has its own times.
TEST_F(StopTest, IsHeardUnderEveryLoadThatClientsCanMake) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.tactus").c_str(), 0600), 0);
  std::ofstream(folder_ / "large.tactus") << "no image";
  ASSERT_EQ(::truncate((folder_ / "large.tactus").c_str(), off_t{200} << 20), 0);
  const auto scene = [this](const char* name) {
    return [this, name] { return "scene " + (folder_ / name).string(); };
  };
  std::vector<std::thread> clients;
  for (int i = 0; i < 20; ++i) {
    clients.push_back(client([] { return "list\nlist\nlist\nlist"; }, false));
    clients.push_back(client([] { return "status"; }, true));
  }
  clients.push_back(client(scene("pipe.tactus"), true));
  clients.push_back(client(scene("large.tactus"), true));
  clients.push_back(client(scene("scene.tactus"), true));
  std::vector<std::unique_ptr<host::Remote>> silent;
  for (int i = 0; i < 200; ++i) {
    try {
      silent.push_back(std::make_unique<host::Remote>(folder_));
    } catch (const host::UnreachableError& error) {
      EXPECT_STRNE(error.what(), "");  // beyond the places that there are
    }
  }
  std::vector<hal::TimeNs> times_ns;
  constexpr int kStops = 300;
  take_priority(kLoopPriority - 2);
  for (int i = 0; i < kStops; ++i) {
    const hal::TimeNs before_ns = hal::monotonic_now_ns();
    const Reply reply = send_stop(folder_, std::chrono::milliseconds(10'000));
    times_ns.push_back(hal::monotonic_now_ns() - before_ns);
    EXPECT_TRUE(reply.is_ok) << reply.text;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  take_priority(0);
  loading_ = false;
  for (std::thread& each : clients) {
    each.join();
  }
  print_histogram(times_ns);
}

}  // namespace
}  // namespace tactus::firmware
