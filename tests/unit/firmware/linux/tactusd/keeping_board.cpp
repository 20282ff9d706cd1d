#include "tests/unit/firmware/linux/tactusd/keeping_board.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace tactus::testing {
namespace {

constexpr unsigned char kReset = 0;
constexpr unsigned char kSetup = 1;
constexpr unsigned char kExchange = 2;
constexpr unsigned char kDevice = 5;
constexpr std::size_t kSetupBytes = 26;
constexpr std::size_t kFirstOffsetByte = 10;
constexpr std::size_t kExchangeBytes = 10;
constexpr double kPushAfter_s = 1.0;
constexpr double kPushTakes_s = 0.5;
constexpr double kPush_deg = 30.0;  // both arms inward: 34 mm upward
constexpr double kTremble_deg =
    0.03;  // of a hand; a joint that stands still under torque is a fault

float float_at(const unsigned char* bytes) {
  float value = 0.0F;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

}  // namespace

KeepingBoard::KeepingBoard() : board_end_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  EXPECT_EQ(::grantpt(board_end_.get()), 0);
  EXPECT_EQ(::unlockpt(board_end_.get()), 0);
  std::array<char, 64> name{};
  EXPECT_EQ(::ptsname_r(board_end_.get(), name.data(), name.size()), 0);
  port_ = name.data();
  host_end_ = hal::FileDescriptor(::open(port_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  termios settings{};
  ::tcgetattr(host_end_.get(), &settings);
  ::cfmakeraw(&settings);
  ::tcsetattr(host_end_.get(), TCSANOW, &settings);
  thread_ = std::thread([this] { run(); });
}

KeepingBoard::~KeepingBoard() {
  ending_ = true;
  thread_.join();
}

bool KeepingBoard::pushes_within(double seconds) const {
  constexpr double kPushing_Nm = 0.02;
  const hal::TimeNs until_ns = hal::monotonic_now_ns() + static_cast<hal::TimeNs>(seconds * 1e9);
  while (torque_Nm_ < kPushing_Nm && hal::monotonic_now_ns() < until_ns) {
    ::usleep(1000);
  }
  return torque_Nm_ >= kPushing_Nm;
}

void KeepingBoard::run() {
  // A board has a processor of its own: before tactusd, where there is the right to it.
  const sched_param first{.sched_priority = 90};
  (void)::sched_setscheduler(0, SCHED_FIFO, &first);
  while (!ending_) {
    if (!hal::wait_readable(board_end_.get(), hal::monotonic_now_ns() + 20'000'000)) {
      continue;
    }
    std::array<unsigned char, 256> room{};
    const ssize_t got = ::read(board_end_.get(), room.data(), room.size());
    if (got > 0) {
      arrived_.insert(arrived_.end(), room.begin(), room.begin() + got);
      take();
    }
  }
}

void KeepingBoard::take() {
  const auto drop = [this](std::size_t bytes) {
    arrived_.erase(arrived_.begin(), arrived_.begin() + static_cast<std::ptrdiff_t>(bytes));
  };
  while (arrived_.size() >= 2) {
    if (arrived_[0] == kReset) {
      drop(2);
    } else if (arrived_[0] == kSetup) {
      if (arrived_.size() < kSetupBytes) {
        return;
      }
      offset_deg_ = {float_at(&arrived_[kFirstOffsetByte]),
                     float_at(&arrived_[kFirstOffsetByte + 8])};
      pushed_at_setup_ = pushed();
      drop(kSetupBytes);
    } else if (arrived_[0] == kExchange) {
      if (arrived_.size() < kExchangeBytes) {
        return;
      }
      torque_Nm_ = std::max(std::abs(static_cast<double>(float_at(&arrived_[2]))),
                            std::abs(static_cast<double>(float_at(&arrived_[6]))));
      drop(kExchangeBytes);
      answer();
    } else {
      drop(1);
    }
  }
}

double KeepingBoard::pushed() const {
  if (first_command_ns_ == 0) {
    return 0.0;
  }
  const double since_s = static_cast<double>(hal::monotonic_now_ns() - first_command_ns_) * 1e-9;
  return kPush_deg * std::clamp((since_s - kPushAfter_s) / kPushTakes_s, 0.0, 1.0) +
         kTremble_deg * std::sin(50.0 * since_s);
}

void KeepingBoard::answer() {
  if (first_command_ns_ == 0) {
    first_command_ns_ = hal::monotonic_now_ns();
  }
  const auto moved_deg = static_cast<float>(pushed() - pushed_at_setup_);
  const std::array<float, 2> angles_deg{offset_deg_[0] - moved_deg, offset_deg_[1] + moved_deg};
  std::array<unsigned char, 1 + sizeof angles_deg> bytes{kDevice};
  std::memcpy(&bytes[1], angles_deg.data(), sizeof angles_deg);
  EXPECT_EQ(::write(board_end_.get(), bytes.data(), bytes.size()),
            static_cast<ssize_t>(bytes.size()));
}

}  // namespace tactus::testing
