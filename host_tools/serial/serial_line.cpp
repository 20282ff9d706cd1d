#include "host_tools/serial/serial_line.h"

#include <asm/termbits.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "hal/linux/system.h"
#include "host_tools/remote/remote.h"

namespace tactus::host {
namespace {

constexpr std::string_view kGone =
    "the line is lost: the cable was pulled, the board has lost its power, the emulator has "
    "ended or serves another program; without this program the board takes its motors' power away "
    "by itself";

// Sets raw bytes at any rate; termios2 takes the number itself. Returns 0 or errno.
int set_raw_line(int descriptor, std::uint32_t baud) {
  struct termios2 settings{};
  if (::ioctl(descriptor, TCGETS2, &settings) != 0) {
    return errno;
  }
  settings.c_iflag = IGNBRK;
  settings.c_oflag = 0;
  settings.c_lflag = 0;
  settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (BOTHER << IBSHIFT);
  settings.c_ispeed = baud;
  settings.c_ospeed = baud;
  // A read waits for at least one byte; with 0 the kernel would report an end of file.
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  if (::ioctl(descriptor, TCSETS2, &settings) != 0 ||
      ::ioctl(descriptor, TCGETS2, &settings) != 0) {
    return errno;
  }
  // A receiver stands a difference of a few percent; an adapter that cannot do the rate keeps its
  // old one.
  constexpr std::uint32_t kParts = 33;
  const std::uint32_t off =
      settings.c_ospeed > baud ? settings.c_ospeed - baud : baud - settings.c_ospeed;
  if (off > baud / kParts) {
    return EINVAL;
  }
  return ::ioctl(descriptor, TCFLSH, TCIOFLUSH) == 0 ? 0 : errno;
}

// Opens a tty for this program alone. Returns 0 or errno. root passes TIOCEXCL, so there is a lock,
// too.
int open_tty(const SerialPlace& place, hal::FileDescriptor& opened) {
  hal::FileDescriptor tty(::open(place.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!tty.is_open()) {
    return errno;
  }
  if (::isatty(tty.get()) != 1) {
    return ENOTTY;
  }
  if (::flock(tty.get(), LOCK_EX | LOCK_NB) != 0 || ::ioctl(tty.get(), TIOCEXCL) != 0) {
    return errno;
  }
  const int error = set_raw_line(tty.get(), place.baud);
  opened = std::move(tty);
  return error;
}

// Connects to an emulator's socket. Returns 0 or errno.
int open_socket(const SerialPlace& place, hal::FileDescriptor& opened) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::span<char> room(address.sun_path);
  if (place.path.size() >= room.size()) {
    return ENAMETOOLONG;
  }
  std::ranges::copy(place.path, room.begin());
  hal::FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  // The interface of sockets takes every address as the general one.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  const auto* const general = reinterpret_cast<const sockaddr*>(&address);
  if (!socket.is_open() || ::connect(socket.get(), general, sizeof address) != 0) {
    return errno;
  }
  ::fcntl(socket.get(), F_SETFL, O_NONBLOCK);
  opened = std::move(socket);
  return 0;
}

}  // namespace

SerialLine::SerialLine(const SerialPlace& place) : place_(place) {
  const int error = place.is_socket ? open_socket(place, file_) : open_tty(place, file_);
  if (error != 0) {
    lost(serial_remedy(place, error));
  }
}

bool SerialLine::wait_for(short events, hal::TimeNs deadline_ns) const {
  pollfd waiting{.fd = file_.get(), .events = events, .revents = 0};
  return hal::wait_for_descriptors({&waiting, 1}, deadline_ns) > 0;
}

std::size_t SerialLine::read(std::span<std::byte> buffer, hal::TimeNs deadline_ns) {
  if (!wait_for(POLLIN, deadline_ns)) {
    return 0;
  }
  const ssize_t got = ::read(file_.get(), buffer.data(), buffer.size());
  if (got > 0) {
    return static_cast<std::size_t>(got);
  }
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) {
    return 0;
  }
  lost(kGone);
}

void SerialLine::write(std::span<const std::byte> bytes) {
  const hal::TimeNs deadline_ns = hal::monotonic_now_ns() + hal::kNsPerSecond;
  while (!bytes.empty()) {
    if (!wait_for(POLLOUT, deadline_ns)) {
      lost("the line takes no bytes any more; does the board still run?");
    }
    // A socket whose other end is gone would end this program by a signal.
    const ssize_t taken = place_.is_socket
                              ? ::send(file_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL)
                              : ::write(file_.get(), bytes.data(), bytes.size());
    if (taken >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(taken));
    } else if (errno != EAGAIN && errno != EINTR) {
      lost(kGone);
    }
  }
}

void SerialLine::lost(std::string_view why) const {
  throw UnreachableError(fmt::format("{}: {}", place_.path, why));
}

}  // namespace tactus::host
