// LinuxCanBus on a scripted kernel: the functions below take the place of the C library's, so that
// errors come in an order that no real interface gives on demand.
#include "hal/linux/can_bus.h"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/if_arp.h>
#include <linux/netlink.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstring>
#include <deque>

namespace {

// The answers of the scripted kernel.
struct Kernel {
  // The errors of the next calls of sendmmsg; then it takes every frame.
  std::deque<int> send_errors;
  // The answer to the next recv, in bytes; below 0 the call fails with that errno.
  int netlink_answer = 0;
  // The number of dropped frames that comes with each received one.
  std::uint32_t drops = 0;
};

Kernel kernel;

}  // namespace

extern "C" {

int socket(int /*domain*/, int /*type*/, int /*protocol*/) noexcept {
  return dup(STDERR_FILENO);
}

int setsockopt(int /*socket*/, int /*level*/, int /*name*/, const void* /*value*/,
               socklen_t /*bytes*/) noexcept {
  return 0;
}

int bind(int /*socket*/, const sockaddr* /*address*/, socklen_t /*bytes*/) noexcept {
  return 0;
}

int ioctl(int /*socket*/, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  auto& interface = *va_arg(arguments, ifreq*);
  va_end(arguments);
  switch (request) {
    case SIOCGIFHWADDR:
      interface.ifr_hwaddr.sa_family = ARPHRD_CAN;
      break;
    case SIOCGIFMTU:
      interface.ifr_mtu = CANFD_MTU;
      break;
    case SIOCGIFFLAGS:
      interface.ifr_flags = IFF_UP;
      break;
    default:
      interface.ifr_ifindex = 7;
      break;
  }
  return 0;
}

int sendmmsg(int /*socket*/, mmsghdr* /*messages*/, unsigned vlen, int /*flags*/) {
  if (kernel.send_errors.empty()) {
    return static_cast<int>(vlen);
  }
  errno = kernel.send_errors.front();
  kernel.send_errors.pop_front();
  return -1;
}

// Gives one classic frame without data, with the count of dropped ones.
int recvmmsg(int /*socket*/, mmsghdr* messages, unsigned /*count*/, int /*flags*/,
             timespec* /*timeout*/) {
  msghdr& header = messages[0].msg_hdr;
  std::memset(header.msg_iov[0].iov_base, 0, sizeof(can_frame));
  messages[0].msg_len = sizeof(can_frame);
  auto& ancillary = *static_cast<cmsghdr*>(header.msg_control);
  ancillary = {.cmsg_len = CMSG_LEN(sizeof(kernel.drops)),
               .cmsg_level = SOL_SOCKET,
               .cmsg_type = SO_RXQ_OVFL};
  std::memcpy(CMSG_DATA(&ancillary), &kernel.drops, sizeof(kernel.drops));
  header.msg_controllen = CMSG_SPACE(sizeof(kernel.drops));
  return 1;
}

ssize_t send(int /*socket*/, const void* /*buf*/, size_t n, int /*flags*/) {
  return static_cast<ssize_t>(n);
}

ssize_t recv(int /*socket*/, void* buf, size_t n, int /*flags*/) {
  if (kernel.netlink_answer < 0) {
    errno = -kernel.netlink_answer;
    return -1;
  }
  std::memset(buf, 0, n);
  return kernel.netlink_answer;
}

}  // extern "C"

namespace tactus::hal {
namespace {

constexpr int kAnswer_bytes = sizeof(nlmsghdr) + sizeof(nlmsgerr);

class CanFailure : public ::testing::Test {
 protected:
  CanFailure() {
    kernel = {};
    EXPECT_TRUE(bus_.open("can0"));
  }

  LinuxCanBus bus_;
  CanFrame frame_{.id = 1};
};

TEST_F(CanFailure, AnInterruptedSendDoesNotCountAsALinkThatWasDown) {
  kernel.send_errors = {EINTR, EINTR, ENETDOWN};
  EXPECT_TRUE(bus_.send(frame_));
  EXPECT_EQ(bus_.counters().sent, 1U);
}

TEST_F(CanFailure, ALinkThatIsUpAndFailsTwiceIsDisconnected) {
  kernel.send_errors = {ENETDOWN, EINTR, ENETDOWN};
  EXPECT_EQ(bus_.send(frame_).error(), (Error{ErrorCode::disconnected, ENETDOWN}));
}

TEST_F(CanFailure, CountersBeginAnewWithEachOpening) {
  std::array<CanReceived, 1> one;
  kernel.drops = 5;
  ASSERT_TRUE(bus_.send(frame_));
  ASSERT_TRUE(bus_.receive(one, kNoWait));
  ASSERT_EQ(bus_.counters().receive_dropped, 5U);
  ASSERT_TRUE(bus_.open("can0"));
  EXPECT_EQ(bus_.counters().receive_dropped, 0U);
  EXPECT_EQ(bus_.counters().received, 0U);
  EXPECT_EQ(bus_.counters().sent, 0U);
  kernel.drops = 2;
  ASSERT_TRUE(bus_.receive(one, kNoWait));
  EXPECT_EQ(bus_.counters().receive_dropped, 2U);
}

TEST_F(CanFailure, AnAnswerThatIsTooShortHasNoErrorOfTheSystem) {
  kernel.netlink_answer = kAnswer_bytes;
  ASSERT_TRUE(bus_.restart());
  errno = ENOENT;
  kernel.netlink_answer = kAnswer_bytes - 1;
  EXPECT_EQ(bus_.restart().error(), (Error{ErrorCode::io, 0}));
  kernel.netlink_answer = -ENOBUFS;
  EXPECT_EQ(bus_.restart().error(), (Error{ErrorCode::io, ENOBUFS}));
}

}  // namespace
}  // namespace tactus::hal
