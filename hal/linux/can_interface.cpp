#include "hal/linux/can_interface.h"

#include <linux/can.h>
#include <linux/can/netlink.h>
#include <linux/if_arp.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "hal/linux/system.h"

namespace tactus::hal {

namespace {

// Returns an ioctl request that names the interface.
ifreq request_for(const std::array<char, IFNAMSIZ>& name) {
  ifreq request{};
  std::memcpy(request.ifr_name, name.data(), name.size());
  return request;
}

// Builds a netlink message that changes an interface. Attributes may be nested: open() begins one
// and returns its place, close() ends it and sets its length.
class LinkMessage {
 public:
  explicit LinkMessage(int interface_index) {
    header_.nlmsg_type = RTM_NEWLINK;
    header_.nlmsg_flags = NLM_F_REQUEST | NLM_F_ACK;
    ifinfomsg link{};
    link.ifi_index = interface_index;
    append(&link, sizeof(link));
  }

  std::size_t open(std::uint16_t type) {
    const std::size_t at = size_;
    const rtattr attribute{.rta_len = 0, .rta_type = type};
    append(&attribute, sizeof(attribute));
    return at;
  }
  void close(std::size_t at) {
    const auto length = static_cast<std::uint16_t>(size_ - at);
    std::memcpy(bytes_.data() + at, &length, sizeof(length));
  }
  void add(std::uint16_t type, const void* value, std::size_t bytes) {
    const std::size_t at = open(type);
    std::memcpy(bytes_.data() + size_, value, bytes);
    size_ += bytes;
    close(at);
    size_ = NLMSG_ALIGN(size_);
  }

  std::span<const std::byte> finish() {
    header_.nlmsg_len = static_cast<std::uint32_t>(size_);
    std::memcpy(bytes_.data(), &header_, sizeof(header_));
    return {bytes_.data(), size_};
  }

 private:
  void append(const void* value, std::size_t bytes) {
    std::memcpy(bytes_.data() + size_, value, bytes);
    size_ += NLMSG_ALIGN(bytes);
  }

  nlmsghdr header_{};
  std::array<std::byte, 128> bytes_{};
  std::size_t size_ = NLMSG_HDRLEN;
};

// Converts the error of the kernel's answer, a positive errno; 0 is success.
Result<void> restart_failure(int error) {
  switch (error) {
    case 0:
      return {};
    case EPERM:
    case EACCES:
      return failure(ErrorCode::not_permitted, error);
    case EBUSY:
      return failure(ErrorCode::invalid_state, error);
    case EOPNOTSUPP:
    case EINVAL:
      return failure(ErrorCode::not_supported, error);
    case ENODEV:
      return failure(ErrorCode::disconnected, error);
    default:
      return failure(ErrorCode::io, error);
  }
}

}  // namespace

Result<void> CanInterface::find(int socket, std::string_view name) {
  if (name.empty() || name.size() >= name_.size()) {
    return failure(ErrorCode::invalid_argument);
  }
  name_ = {};
  std::ranges::copy(name, name_.begin());
  ifreq request = request_for(name_);
  if (ioctl(socket, SIOCGIFINDEX, &request) < 0) {
    return failure(errno == ENODEV ? ErrorCode::not_found : ErrorCode::io, errno);
  }
  index_ = request.ifr_ifindex;
  request = request_for(name_);
  if (ioctl(socket, SIOCGIFHWADDR, &request) < 0) {
    return failure(ErrorCode::io, errno);
  }
  // Other kinds of interfaces have names, too: eth0 is no CAN interface.
  if (request.ifr_hwaddr.sa_family != ARPHRD_CAN) {
    return failure(ErrorCode::invalid_argument);
  }
  request = request_for(name_);
  if (ioctl(socket, SIOCGIFMTU, &request) < 0) {
    return failure(ErrorCode::io, errno);
  }
  // The MTU is the size of the largest frame: 72 bytes with CAN FD, 16 without.
  fd_ = request.ifr_mtu == static_cast<int>(CANFD_MTU);
  return {};
}

Result<bool> CanInterface::is_up(int socket) const {
  ifreq request = request_for(name_);
  if (ioctl(socket, SIOCGIFFLAGS, &request) < 0) {
    return failure(errno == ENODEV ? ErrorCode::disconnected : ErrorCode::io, errno);
  }
  // The flags are a signed short used as bits.
  return (static_cast<unsigned>(request.ifr_flags) & static_cast<unsigned>(IFF_UP)) != 0;
}

Result<void> CanInterface::restart() const {
  const FileDescriptor netlink(socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  if (!netlink.is_open()) {
    return failure(ErrorCode::io, errno);
  }
  LinkMessage message(index_);
  const std::uint32_t now = 1;
  const std::size_t info = message.open(IFLA_LINKINFO);
  message.add(IFLA_INFO_KIND, "can", 3);
  const std::size_t data = message.open(IFLA_INFO_DATA);
  message.add(IFLA_CAN_RESTART, &now, sizeof(now));
  message.close(data);
  message.close(info);
  const auto bytes = message.finish();
  if (::send(netlink.get(), bytes.data(), bytes.size(), 0) < 0) {
    return failure(ErrorCode::io, errno);
  }
  struct Answer {
    nlmsghdr header;
    nlmsgerr error;
  };
  // The kernel always answers, because the message has NLM_F_ACK.
  alignas(Answer) std::array<std::byte, 512> buffer{};
  const ssize_t got = recv(netlink.get(), buffer.data(), buffer.size(), 0);
  if (got < static_cast<ssize_t>(sizeof(Answer))) {
    return failure(ErrorCode::io, got < 0 ? errno : 0);
  }
  Answer answer{};
  std::memcpy(&answer, buffer.data(), sizeof(answer));
  return restart_failure(-answer.error.error);
}

}  // namespace tactus::hal
