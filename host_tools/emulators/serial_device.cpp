#include "host_tools/emulators/serial_device.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): posix_openpt is not in <cstdlib>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "host_tools/input_error.h"

namespace tactus::host {

void SerialDevice::open(const std::string& tty) {
  // A tty without wires ignores its baud rate.
  constexpr unsigned kAnyBaud = 115200;
  if (const auto opened = port_.open(tty, kAnyBaud); !opened) {
    throw InputError(fmt::format("{}: {} (errno {}); is the gadget there? see README.md", tty,
                                 hal::words(opened.error().code), opened.error().errno_value));
  }
}

SerialDevice::~SerialDevice() {
  if (host_end_ >= 0) {
    ::close(host_end_);
  }
}

std::string SerialDevice::open_pseudo_terminal() {
  const int device_end = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (device_end < 0) {
    throw InputError(fmt::format("no pseudo-terminal: {}", std::strerror(errno)));
  }
  port_.adopt(device_end);
  const char* const path =
      ::grantpt(device_end) == 0 && ::unlockpt(device_end) == 0 ? ::ptsname(device_end) : nullptr;
  host_end_ = path == nullptr ? -1 : ::open(path, O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios settings{};
  if (host_end_ < 0 || ::tcgetattr(host_end_, &settings) != 0) {
    throw InputError(fmt::format("no pseudo-terminal: {}", std::strerror(errno)));
  }
  ::cfmakeraw(&settings);
  ::tcsetattr(host_end_, TCSANOW, &settings);
  return path;
}

void SerialDevice::note(const hal::Error& error) {
  // Calls between two attempts to open it again: 0.1 s at the emulator's pace.
  constexpr unsigned kCallsBetween = 1000;
  if (error.code != hal::ErrorCode::disconnected) {
    return;
  }
  if (calls_until_reopen_ == 0) {
    calls_until_reopen_ = kCallsBetween;
    (void)port_.reopen();
  }
  --calls_until_reopen_;
}

hal::Result<std::size_t> SerialDevice::DoWrite(std::span<const std::byte> bytes,
                                               hal::TimeNs deadline_ns) {
  return port_.write(bytes, deadline_ns);
}

hal::Result<std::size_t> SerialDevice::DoRead(std::span<std::byte> buffer,
                                              hal::TimeNs deadline_ns) {
  // A host that sends without a pause must not fill the memory.
  constexpr std::size_t kMostHeld_bytes = 4096;
  const auto got = port_.read(buffer, deadline_ns);
  if (got) {
    const auto bytes = buffer.first(*got);
    arrived_.insert(arrived_.end(), bytes.begin(), bytes.end());
    if (arrived_.size() < kMostHeld_bytes) {
      return hal::failure(hal::ErrorCode::timeout);
    }
  } else {
    note(got.error());
    if (arrived_.empty()) {
      return got;
    }
  }
  const std::size_t count = std::min(buffer.size(), arrived_.size());
  std::copy_n(arrived_.begin(), count, buffer.begin());
  arrived_.erase(arrived_.begin(), arrived_.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

}  // namespace tactus::host
