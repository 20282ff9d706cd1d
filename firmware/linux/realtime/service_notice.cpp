#include "firmware/linux/realtime/service_notice.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace tactus::firmware {

namespace {

// Returns the variable's value; empty if it is not set.
std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view{} : std::string_view(value);
}

// Returns the number of a text that is nothing else, or nothing.
std::optional<std::int64_t> positive_number(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && number > 0 ? std::optional(number) : std::nullopt;
}

}  // namespace

int ServiceNotice::open() {
  const std::string_view name = environment("NOTIFY_SOCKET");
  if (name.empty()) {
    return 0;
  }
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.size() >= sizeof(address.sun_path) || (name.front() != '/' && name.front() != '@')) {
    return EINVAL;
  }
  std::ranges::copy(name, std::begin(address.sun_path));
  if (name.front() == '@') {
    // An abstract name begins with a zero in place of the @.
    address.sun_path[0] = '\0';
  }
  hal::FileDescriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  // The socket calls take every address as this general type.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  const auto* plain = reinterpret_cast<const sockaddr*>(&address);
  if (!socket.is_open() || connect(socket.get(), plain, length) != 0) {
    return errno;
  }
  socket_ = std::move(socket);
  return 0;
}

void ServiceNotice::send(std::string_view notices) const {
  if (socket_.is_open()) {
    (void)::send(socket_.get(), notices.data(), notices.size(), MSG_NOSIGNAL);
  }
}

std::optional<hal::TimeNs> ServiceNotice::watchdog_period() {
  const std::string_view for_process = environment("WATCHDOG_PID");
  if (!for_process.empty() && positive_number(for_process) != getpid()) {
    return std::nullopt;
  }
  const auto microseconds = positive_number(environment("WATCHDOG_USEC"));
  return microseconds ? std::optional<hal::TimeNs>(*microseconds * 1000) : std::nullopt;
}

}  // namespace tactus::firmware
