// The part of LinuxCanBus that opens the socket and sets its options.
#include <linux/can.h>
#include <linux/can/raw.h>
#include <linux/net_tstamp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "hal/linux/can_bus.h"

namespace tactus::hal {

namespace {

// The receive buffer of the socket. The default holds about 278 frames (measured, see
// hal/README.md): 30 ms of a full bus of 1 Mbit/s with frames of 8 bytes.
constexpr int kReceiveBuffer_bytes = 1 << 20;
// These classes are always enabled, because the state is derived from them.
constexpr std::uint32_t kOwnErrorClasses = kCanBusOff | kCanRestarted | kCanController;

Result<void> open_failure(int error) {
  switch (error) {
    case EAFNOSUPPORT:
    case EPROTONOSUPPORT:
      return failure(ErrorCode::not_supported, error);
    case EPERM:
    case EACCES:
      return failure(ErrorCode::not_permitted, error);
    case ENOBUFS:
    case ENOMEM:
    case EMFILE:
    case ENFILE:
      return failure(ErrorCode::no_memory, error);
    default:
      return failure(ErrorCode::io, error);
  }
}

Result<void> set_option(int socket, int level, int name, const void* value, std::size_t bytes) {
  if (setsockopt(socket, level, name, value, static_cast<socklen_t>(bytes)) < 0) {
    return open_failure(errno);
  }
  return {};
}

Result<void> set_option(int socket, int level, int name, int value) {
  return set_option(socket, level, name, &value, sizeof(value));
}

}  // namespace

Result<void> LinuxCanBus::open(std::string_view interface) {
  close();
  socket_ = FileDescriptor(socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (!socket_.is_open()) {
    return open_failure(errno);
  }
  auto ready = interface_.find(socket_.get(), interface);
  if (ready) {
    ready = configure_socket();
  }
  if (!ready) {
    close();
    return ready;
  }
  status_ = {};
  clear_counters();
  receive_dropped_ = 0;
  drops_seen_ = 0;
  error_classes_ = 0;
  link_down_ = false;
  const auto up = interface_.is_up(socket_.get());
  if (up && !*up) {
    link_down_ = true;
    status_.state = CanState::stopped;
  }
  return {};
}

Result<void> LinuxCanBus::configure_socket() {
  const int socket = socket_.get();
  // Without the privilege to exceed it, the system's limit applies.
  if (!set_option(socket, SOL_SOCKET, SO_RCVBUFFORCE, kReceiveBuffer_bytes)) {
    (void)set_option(socket, SOL_SOCKET, SO_RCVBUF, kReceiveBuffer_bytes);
  }
  const int stamps = SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE;
  const can_err_mask_t classes = kOwnErrorClasses;
  auto outcome = set_option(socket, SOL_SOCKET, SO_RXQ_OVFL, 1);
  if (outcome) {
    outcome = set_option(socket, SOL_SOCKET, SO_TIMESTAMPING, stamps);
  }
  if (outcome && interface_.fd()) {
    outcome = set_option(socket, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, 1);
  }
  if (outcome) {
    outcome = set_option(socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &classes, sizeof(classes));
  }
  if (!outcome) {
    return outcome;
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = interface_.index();
  if (bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) < 0) {
    return open_failure(errno);
  }
  return {};
}

Result<void> LinuxCanBus::DoSetFilters(std::span<const CanFilter> filters) {
  std::array<can_filter, kMaxCanFilters> words{};
  std::ranges::transform(filters, words.begin(), [](const CanFilter& filter) {
    return can_filter{.can_id = filter.word | (filter.inverted ? CAN_INV_FILTER : 0U),
                      .can_mask = filter.mask};
  });
  return set_option(socket_.get(), SOL_CAN_RAW, CAN_RAW_FILTER, words.data(),
                    filters.size() * sizeof(can_filter));
}

Result<void> LinuxCanBus::DoSetErrorClasses(std::uint32_t classes) {
  const can_err_mask_t mask = (classes & kCanEveryErrorClass) | kOwnErrorClasses;
  const auto outcome =
      set_option(socket_.get(), SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &mask, sizeof(mask));
  if (outcome) {
    error_classes_ = classes;
  }
  return outcome;
}

}  // namespace tactus::hal
