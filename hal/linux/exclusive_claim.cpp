#include "hal/linux/exclusive_claim.h"

#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <iterator>
#include <utility>

namespace tactus::hal {
namespace {

constexpr std::string_view kPrefix = "tactus/";

// Returns the address as the general type that the socket calls take.
const sockaddr* general(const sockaddr_un& address) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  return reinterpret_cast<const sockaddr*>(&address);
}

// Returns the process that listens at the address, 0 if that is not known. Connecting is enough:
// the kernel notes the credentials of a listener when it begins to listen.
pid_t listener_of(const sockaddr_un& address, socklen_t size) {
  const FileDescriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  ucred credentials{};
  socklen_t length = sizeof credentials;
  const bool is_known =
      probe.is_open() && ::connect(probe.get(), general(address), size) == 0 &&
      ::getsockopt(probe.get(), SOL_SOCKET, SO_PEERCRED, &credentials, &length) == 0;
  return is_known ? credentials.pid : 0;
}

}  // namespace

ClaimOutcome ExclusiveClaim::take(std::string_view name) {
  constexpr int kProbes = 64;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // A name that begins with a zero belongs to the abstract name space.
  if (1 + kPrefix.size() + name.size() > sizeof address.sun_path) {
    return {.errno_value = ENAMETOOLONG};
  }
  char* const end = std::ranges::copy(kPrefix, std::next(static_cast<char*>(address.sun_path))).out;
  std::ranges::copy(name, end);
  const auto size =
      static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + kPrefix.size() + name.size());
  FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!socket.is_open() || ::bind(socket.get(), general(address), size) != 0) {
    const int error = errno;
    return {.holder = error == EADDRINUSE ? listener_of(address, size) : 0, .errno_value = error};
  }
  // Other programs connect to learn the holder's process; they get no answer.
  if (::listen(socket.get(), kProbes) != 0) {
    return {.errno_value = errno};
  }
  socket_ = std::move(socket);
  return {.is_held = true};
}

}  // namespace tactus::hal
