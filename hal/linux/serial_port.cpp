#include "hal/linux/serial_port.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "hal/linux/system.h"

namespace tactus::hal {

namespace {

// The rates in bit/s that `open` takes, with the constants of termios.
constexpr std::array<std::pair<std::uint32_t, speed_t>, 10> kSerialSpeeds = {{
    {9600, B9600},
    {19200, B19200},
    {38400, B38400},
    {57600, B57600},
    {115200, B115200},
    {230400, B230400},
    {460800, B460800},
    {921600, B921600},
    {1000000, B1000000},
    {2000000, B2000000},
}};

// Returns true for an errno by which the kernel reports that the device behind a tty has gone.
bool means_gone(int errno_value) {
  return errno_value == EIO || errno_value == ENODEV || errno_value == ENXIO;
}

// Converts the errno of opening or of setting a tty.
std::unexpected<Error> not_opened(int errno_value) {
  switch (errno_value) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
    case EIO:
      return failure(ErrorCode::disconnected, errno_value);
    case EBUSY:
      return failure(ErrorCode::busy, errno_value);
    case EACCES:
    case EPERM:
      return failure(ErrorCode::not_permitted, errno_value);
    case ENOTTY:
    case EINVAL:
      return failure(ErrorCode::not_supported, errno_value);
    default:
      return failure(ErrorCode::io, errno_value);
  }
}

// Sets raw mode and the speed, and drops bytes of an earlier session.
bool set_raw(int descriptor, speed_t speed) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) {
    return false;
  }
  cfmakeraw(&settings);
  // A read waits for at least one byte; with 0 the kernel would report an end of file.
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  settings.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
  settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS);
  return cfsetspeed(&settings, speed) == 0 && tcsetattr(descriptor, TCSANOW, &settings) == 0 &&
         tcflush(descriptor, TCIOFLUSH) == 0;
}

}  // namespace

Result<void> LinuxSerialPort::open(std::string_view path, std::uint32_t baud) {
  const auto* const speed =
      std::ranges::find(kSerialSpeeds, baud, &std::pair<std::uint32_t, speed_t>::first);
  if (speed == kSerialSpeeds.end() || path.empty() || path.size() >= path_.size()) {
    return failure(ErrorCode::invalid_argument);
  }
  speed_ = speed->second;
  path_.fill('\0');
  std::ranges::copy(path, path_.begin());
  auto opened = open_node();
  if (!opened && opened.error().errno_value == ENOENT) {
    return failure(ErrorCode::not_found, ENOENT);
  }
  return opened;
}

void LinuxSerialPort::adopt(int descriptor) {
  path_.fill('\0');
  node_ = FileDescriptor(descriptor);
  const int flags = fcntl(descriptor, F_GETFL);
  fcntl(descriptor, F_SETFL, flags | O_NONBLOCK);
}

Result<void> LinuxSerialPort::DoReopen() {
  node_.reset();
  if (path_[0] == '\0') {
    return failure(ErrorCode::disconnected);
  }
  return open_node();
}

Result<void> LinuxSerialPort::open_node() {
  node_.reset();
  FileDescriptor node(::open(path_.data(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!node.is_open() || ioctl(node.get(), TIOCEXCL) != 0 || !set_raw(node.get(), speed_)) {
    return not_opened(errno);
  }
  node_ = std::move(node);
  return {};
}

std::unexpected<Error> LinuxSerialPort::failed(int errno_value) {
  if (means_gone(errno_value)) {
    node_.reset();
    return failure(ErrorCode::disconnected, errno_value);
  }
  return failure(ErrorCode::io, errno_value);
}

Result<bool> LinuxSerialPort::wait_for(short events, TimeNs deadline_ns) {
  pollfd waiting{.fd = node_.get(), .events = events, .revents = 0};
  const int ready = wait_for_descriptors({&waiting, 1}, deadline_ns);
  if (ready < 0) {
    return failed(errno);
  }
  return ready > 0;
}

Result<std::size_t> LinuxSerialPort::DoWrite(std::span<const std::byte> bytes, TimeNs deadline_ns) {
  std::size_t taken = 0;
  while (taken < bytes.size()) {
    if (!node_.is_open()) {
      return failure(ErrorCode::disconnected);
    }
    const auto rest = bytes.subspan(taken);
    const ssize_t written = ::write(node_.get(), rest.data(), rest.size());
    if (written >= 0) {
      taken += static_cast<std::size_t>(written);
      continue;
    }
    if (errno != EAGAIN && errno != EINTR) {
      return failed(errno);
    }
    const auto ready = wait_for(POLLOUT, deadline_ns);
    if (!ready) {
      return std::unexpected(ready.error());
    }
    if (!*ready) {
      break;
    }
  }
  if (taken == 0) {
    return failure(ErrorCode::timeout);
  }
  return taken;
}

Result<std::size_t> LinuxSerialPort::DoRead(std::span<std::byte> buffer, TimeNs deadline_ns) {
  for (;;) {
    if (!node_.is_open()) {
      return failure(ErrorCode::disconnected);
    }
    const ssize_t got = ::read(node_.get(), buffer.data(), buffer.size());
    if (got > 0) {
      return static_cast<std::size_t>(got);
    }
    if (got == 0) {  // a tty ends only when it is hung up
      return failed(ENODEV);
    }
    if (errno != EAGAIN && errno != EINTR) {
      return failed(errno);
    }
    const auto ready = wait_for(POLLIN, deadline_ns);
    if (!ready) {
      return std::unexpected(ready.error());
    }
    if (!*ready) {
      return failure(ErrorCode::timeout);
    }
  }
}

Result<void> LinuxSerialPort::DoDiscardInput() {
  if (!node_.is_open()) {
    return failure(ErrorCode::disconnected);
  }
  if (tcflush(node_.get(), TCIFLUSH) != 0) {
    return failed(errno);
  }
  return {};
}

}  // namespace tactus::hal
