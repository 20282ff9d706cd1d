// The contract on pseudo-terminals: the kernel's tty without a device.
#include "hal/linux/serial_port.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "hal/linux/system.h"
#include "tests/unit/hal/serial_port_contract.h"

namespace tactus::hal {
namespace {

class MonotonicClock final : public Clock {
  TimeNs DoNowNs() const override { return monotonic_now_ns(); }
  void DoSleepUntil(TimeNs wake_ns) override { wait_for_descriptors({}, wake_ns); }
};

// The port opens a link to the slave side, so that a new pair can stand in for the device's return.
class PseudoTerminalRig {
 public:
  PseudoTerminalRig() {
    std::string pattern = "/tmp/tactus_serial_XXXXXX";
    if (mkdtemp(pattern.data()) == nullptr) {
      throw std::runtime_error("no temporary folder");
    }
    folder_ = pattern;
    plug_in();
    EXPECT_TRUE(port_.open((folder_ / "tty").native(), 115200));
  }
  PseudoTerminalRig(const PseudoTerminalRig&) = delete;
  PseudoTerminalRig& operator=(const PseudoTerminalRig&) = delete;
  ~PseudoTerminalRig() {
    unplug();
    std::filesystem::remove_all(folder_);
  }

  SerialPort& port() { return port_; }
  Clock& clock() { return clock_; }
  void answer(std::span<const std::byte> bytes) const {
    EXPECT_EQ(::write(master_, bytes.data(), bytes.size()), std::ssize(bytes));
  }
  std::size_t hear(std::span<std::byte> buffer) const {
    const ssize_t got = ::read(master_, buffer.data(), buffer.size());
    return got > 0 ? static_cast<std::size_t>(got) : 0;
  }
  void unplug() {
    if (master_ >= 0) {
      std::filesystem::remove(folder_ / "tty");
      ::close(master_);
      master_ = -1;
    }
  }
  void plug_in() {
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    std::array<char, 64> name{};
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0 ||
        ptsname_r(master_, name.data(), name.size()) != 0) {
      throw std::runtime_error("no pseudo-terminal");
    }
    std::filesystem::create_symlink(name.data(), folder_ / "tty");
  }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  MonotonicClock clock_;
  LinuxSerialPort port_;
  int master_ = -1;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Linux, SerialPortContract, PseudoTerminalRig);

template <class T>
ErrorCode code_of(const Result<T>& result) {
  return result ? throw std::runtime_error("succeeded") : result.error().code;
}

TEST(LinuxSerialPort, SaysWhyItCannotBeOpened) {
  LinuxSerialPort port;
  const PseudoTerminalRig rig;
  EXPECT_EQ(code_of(port.open((rig.folder() / "none").native(), 115200)), ErrorCode::not_found);
  EXPECT_EQ(code_of(port.open((rig.folder() / "tty").native(), 12345)),
            ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(port.open("", 115200)), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(port.open(std::string(300, 'x'), 115200)), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(port.open("/dev/null", 115200)), ErrorCode::not_supported);
}

// Root may do everything: without its rights for the while.
class AsNobody {
 public:
  AsNobody() : was_root_(geteuid() == 0) { EXPECT_TRUE(!was_root_ || seteuid(kNobody) == 0); }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;
  ~AsNobody() { EXPECT_TRUE(!was_root_ || seteuid(0) == 0); }

 private:
  static constexpr uid_t kNobody = 65534;
  bool was_root_;
};

TEST(LinuxSerialPort, NodeWithoutPermissionIsNotPermitted) {
  const PseudoTerminalRig rig;
  const auto node = (rig.folder() / "tty").native();
  std::filesystem::permissions(rig.folder(), std::filesystem::perms::all);
  ASSERT_EQ(chmod(node.c_str(), 0), 0);
  const AsNobody nobody;
  LinuxSerialPort port;
  EXPECT_EQ(code_of(port.open(node, 115200)), ErrorCode::not_permitted);
}

TEST(LinuxSerialPort, TtyThatAnotherHoldsIsBusy) {
  const PseudoTerminalRig rig;
  const auto node = (rig.folder() / "tty").native();
  std::filesystem::permissions(rig.folder(), std::filesystem::perms::all);
  ASSERT_EQ(chmod(node.c_str(), 0666), 0);
  const AsNobody nobody;
  LinuxSerialPort second;
  EXPECT_EQ(code_of(second.open(node, 115200)), ErrorCode::busy);
}

TEST(LinuxSerialPort, IsDisconnectedBeforeItIsOpened) {
  LinuxSerialPort port;
  std::array<std::byte, 4> buffer;
  EXPECT_EQ(code_of(port.read(buffer, kNoWait)), ErrorCode::disconnected);
  EXPECT_EQ(code_of(port.write(buffer, kNoWait)), ErrorCode::disconnected);
  EXPECT_EQ(code_of(port.reopen()), ErrorCode::disconnected);
}

}  // namespace
}  // namespace tactus::hal
