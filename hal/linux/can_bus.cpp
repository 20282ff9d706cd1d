// The part of LinuxCanBus that sends and receives. The socket is opened in can_bus_opening.cpp.
#include "hal/linux/can_bus.h"

#include <linux/can.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "hal/linux/can_wire.h"

namespace tactus::hal {

namespace {

// Returns the difference between CLOCK_REALTIME, which the kernel's time stamps use, and
// CLOCK_MONOTONIC, ns.
TimeNs realtime_minus_monotonic_ns() {
  timespec real{};
  clock_gettime(CLOCK_REALTIME, &real);
  return to_ns(real) - monotonic_now_ns();
}

// The buffers of one batch in either direction, on the stack.
template <std::size_t kCount>
struct Batch {
  std::array<CanWireFrame, kCount> wire;
  std::array<iovec, kCount> pieces{};
  std::array<mmsghdr, kCount> messages{};

  void aim(std::size_t i, std::size_t bytes) {
    pieces[i] = {.iov_base = &wire[i].frame, .iov_len = bytes};
    messages[i].msg_hdr.msg_iov = &pieces[i];
    messages[i].msg_hdr.msg_iovlen = 1;
  }
};

}  // namespace

Result<std::size_t> LinuxCanBus::DoSend(std::span<const CanFrame> frames) {
  if (status_.state == CanState::bus_off) {
    return failure(ErrorCode::bus_off);
  }
  std::size_t sent = 0;
  bool was_down = false;
  while (sent < frames.size()) {
    Batch<kBatch> batch;
    const std::size_t count = std::min(kBatch, frames.size() - sent);
    for (std::size_t i = 0; i < count; ++i) {
      batch.wire[i] = to_wire(frames[sent + i]);
      batch.aim(i, batch.wire[i].bytes);
    }
    const int taken =
        sendmmsg(socket_.get(), batch.messages.data(), static_cast<unsigned>(count), MSG_DONTWAIT);
    if (taken > 0) {
      sent += static_cast<std::size_t>(taken);
      continue;
    }
    if (sent > 0) {
      return sent;
    }
    if (const auto again = may_send_again(errno, was_down); !again) {
      return std::unexpected(again.error());
    }
  }
  if (link_down_) {
    (void)check_link();
  }
  return sent;
}

// Judges a failed send. Succeeds if it may be tried again; otherwise returns the error. `was_down`
// says whether an attempt before this one failed because of the link, and becomes true if this one
// did.
Result<void> LinuxCanBus::may_send_again(int error, bool& was_down) {
  switch (error) {
    case ENOBUFS:
    case EAGAIN:
      return failure(ErrorCode::queue_full, error);
    case ENETDOWN:
    case ENXIO:
    case ENODEV: {
      // The socket reports once that the link was down, even if it is up again.
      const auto link = check_link();
      return link && std::exchange(was_down, true) ? failure(ErrorCode::disconnected, error) : link;
    }
    case EBADF:
      return failure(ErrorCode::disconnected, error);
    case EINTR:
      return {};
    default:
      return failure(ErrorCode::io, error);
  }
}

Result<std::size_t> LinuxCanBus::DoReceive(std::span<CanReceived> received, TimeNs deadline_ns) {
  if (!socket_.is_open()) {
    return failure(ErrorCode::disconnected, EBADF);
  }
  while (true) {
    const auto count = take_waiting(received);
    if (!count || *count > 0) {
      return count;
    }
    if (link_down_) {
      if (const auto up = check_link(); !up) {
        return std::unexpected(up.error());
      }
    }
    if (!wait_readable(socket_.get(), deadline_ns)) {
      return failure(ErrorCode::timeout);
    }
  }
}

// Receives the waiting items without waiting and returns their number, which may be 0.
Result<std::size_t> LinuxCanBus::take_waiting(std::span<CanReceived> received) {
  Batch<kBatch> batch;
  alignas(cmsghdr) std::array<std::array<std::byte, 128>, kBatch> control;
  std::size_t count = 0;
  while (count < received.size()) {
    const std::size_t room = std::min(kBatch, received.size() - count);
    for (std::size_t i = 0; i < room; ++i) {
      batch.aim(i, CANFD_MTU);
      batch.messages[i].msg_hdr.msg_control = control[i].data();
      batch.messages[i].msg_hdr.msg_controllen = control[i].size();
    }
    const int got = recvmmsg(socket_.get(), batch.messages.data(), static_cast<unsigned>(room),
                             MSG_DONTWAIT, nullptr);
    if (got < 0) {
      // The error of a link that went down comes before the frames that were received before it.
      if (errno == ENETDOWN || errno == ENODEV) {
        link_down_ = true;
        continue;
      }
      if (errno == EINTR) {
        continue;
      }
      if (errno == EAGAIN || count > 0) {
        return count;
      }
      return failure(ErrorCode::io, errno);
    }
    const TimeNs offset_ns = realtime_minus_monotonic_ns();
    for (std::size_t i = 0; i < static_cast<std::size_t>(got); ++i) {
      const CanAncillary ancillary = read_ancillary(batch.messages[i].msg_hdr);
      if (ancillary.tells_drops) {
        note_drops(ancillary.drops);
      }
      CanReceived& item = received[count];
      // The kernel begins to add time stamps a little after the first socket requested them.
      item.time_ns =
          ancillary.realtime_ns > 0 ? ancillary.realtime_ns - offset_ns : monotonic_now_ns();
      const canfd_frame& wire = batch.wire[i].frame;
      if ((wire.can_id & CAN_ERR_FLAG) != 0) {
        item.kind = CanReceived::Kind::error;
        item.error = error_from_wire(wire);
      } else {
        item.kind = CanReceived::Kind::frame;
        item.frame = from_wire(wire, batch.messages[i].msg_len == CANFD_MTU);
      }
      count += hand_out(item) ? 1U : 0U;
    }
    if (static_cast<std::size_t>(got) < room) {
      return count;
    }
  }
  return count;
}

// Succeeds if the link is up; otherwise returns link_down or disconnected.
Result<void> LinuxCanBus::check_link() {
  const auto up = interface_.is_up(socket_.get());
  if (!up) {
    return std::unexpected(up.error());
  }
  link_down_ = !*up;
  status_ = {};
  if (link_down_) {
    status_.state = CanState::stopped;
    return failure(ErrorCode::link_down, ENETDOWN);
  }
  return {};
}

// Returns true if the caller shall get the item: a frame, or a report of an enabled class.
bool LinuxCanBus::hand_out(CanReceived& item) {
  if (item.kind == CanReceived::Kind::frame) {
    return true;
  }
  note(item.error);
  return (item.error.classes & error_classes_) != 0;
}

void LinuxCanBus::note_drops(std::uint32_t total) {
  receive_dropped_ += total - drops_seen_;
  drops_seen_ = total;
}

void LinuxCanBus::note(const CanErrorReport& report) {
  if ((report.classes & kCanBusOff) != 0) {
    status_.state = CanState::bus_off;
  } else if ((report.classes & kCanRestarted) != 0) {
    status_.state = CanState::error_active;
  } else if ((report.classes & kCanController) != 0) {
    if ((report.controller & (kCanReceivePassive | kCanTransmitPassive)) != 0) {
      status_.state = CanState::error_passive;
    } else if ((report.controller & (kCanReceiveWarning | kCanTransmitWarning)) != 0) {
      status_.state = CanState::error_warning;
    } else if ((report.controller & kCanBackToActive) != 0) {
      status_.state = CanState::error_active;
    }
  }
  if ((report.classes & kCanErrorCounters) != 0) {
    status_.transmit_errors = report.transmit_errors;
    status_.receive_errors = report.receive_errors;
  }
}

Result<void> LinuxCanBus::DoRestart() {
  const auto up = interface_.is_up(socket_.get());
  if (!up) {
    return std::unexpected(up.error());
  }
  if (!*up) {
    return failure(ErrorCode::link_down, ENETDOWN);
  }
  const auto outcome = interface_.restart();
  if (outcome) {
    status_ = {};
  }
  return outcome;
}

}  // namespace tactus::hal
