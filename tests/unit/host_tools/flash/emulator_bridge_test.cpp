#include "host_tools/flash/emulator_bridge.h"

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/folder_test.h"

namespace tactus::host {
namespace {

// A bridge to a program in place of the emulator, in a thread.
class EmulatorBridgeTest : public FolderTest {
 protected:
  void start(const std::string& program) {
    ::sigemptyset(&signals_);
    bridge_ = std::make_unique<EmulatorBridge>(
        file("board.sock"), std::vector<std::string>{"/bin/sh", "-c", program}, signals_);
    thread_ = std::jthread([this] {
      while (bridge_->turn(end_.get())) {
      }
    });
  }

  // Waits until the bridge has ended by itself.
  void wait_for_end() {
    thread_.join();
    thread_ = std::jthread([] {});
  }

  // Ends the bridge and returns true if it ended because it was asked to.
  bool end() {
    const std::uint64_t one = 1;
    (void)!::write(end_.get(), &one, sizeof one);
    thread_.join();
    return bridge_->is_asked_to_end();
  }

  [[nodiscard]] hal::FileDescriptor connect_to_board() const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::ranges::copy(file("board.sock"), std::begin(address.sun_path));
    // The emulator must not keep it open.
    hal::FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
    const auto* const general = reinterpret_cast<const sockaddr*>(&address);
    EXPECT_EQ(::connect(socket.get(), general, sizeof address), 0);
    return socket;
  }

  // Sends a text to the board and returns the first of its bytes that come back.
  static std::string echo_of(const hal::FileDescriptor& line, const std::string& text) {
    EXPECT_EQ(::write(line.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
    std::string heard;
    std::array<char, 4096> room{};
    while (heard.size() < text.size() &&
           hal::wait_readable(line.get(), hal::monotonic_now_ns() + 5 * hal::kNsPerSecond)) {
      const ssize_t got = ::read(line.get(), room.data(), room.size());
      if (got <= 0) {
        break;
      }
      heard.append(room.data(), static_cast<std::size_t>(got));
    }
    return heard;
  }

 private:
  sigset_t signals_{};
  hal::FileDescriptor end_{::eventfd(0, EFD_CLOEXEC)};
  std::unique_ptr<EmulatorBridge> bridge_;
  std::jthread thread_;
};

TEST_F(EmulatorBridgeTest, TheEmulatorStartsWithTheFirstProgramAndStaysForTheNext) {
  start("echo started >>'" + file("starts") + "'; exec cat");
  EXPECT_FALSE(std::filesystem::exists(file("starts")));
  {
    const hal::FileDescriptor line = connect_to_board();
    EXPECT_EQ(echo_of(line, "hello"), "hello");
  }
  const hal::FileDescriptor line = connect_to_board();
  EXPECT_EQ(echo_of(line, "again"), "again");
  EXPECT_EQ(std::filesystem::file_size(file("starts")), std::string("started\n").size());
  EXPECT_TRUE(end());
}

TEST_F(EmulatorBridgeTest, ABoardThatTalksWithoutAReaderIsNotHeldUp) {
  // More than any pipe holds, before the second program comes.
  start("read first; head -c 3000000 /dev/zero; echo done >'" + file("done") + "'; exec cat");
  {
    const hal::FileDescriptor line = connect_to_board();
    ASSERT_EQ(::write(line.get(), "go\n", 3), 3);
  }
  for (int i = 0; i < 1000 && !std::filesystem::exists(file("done")); ++i) {
    ::usleep(10'000);
  }
  EXPECT_TRUE(std::filesystem::exists(file("done")));
  EXPECT_TRUE(end());
}

TEST_F(EmulatorBridgeTest, AnEmulatorThatEndsEndsTheBridge) {
  start("read first");
  const hal::FileDescriptor line = connect_to_board();
  ASSERT_EQ(::write(line.get(), "go\n", 3), 3);
  wait_for_end();
  EXPECT_FALSE(end());
}

}  // namespace
}  // namespace tactus::host
