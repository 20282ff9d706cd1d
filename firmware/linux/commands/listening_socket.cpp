#include "firmware/linux/commands/listening_socket.h"

#include <grp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>

namespace tactus::firmware {
namespace {

// The process's file mode mask decides the mode of the file that bind() makes.
constexpr mode_t kMaskFor0660 = 0117;
// The number of programs that may wait to be accepted.
constexpr int kQueue = 4;

std::unexpected<ListenError> listen_error(std::string_view what, int error) {
  return std::unexpected(ListenError{.what = what, .errno_value = error});
}

sockaddr_un address_of(std::string_view path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::ranges::copy(path, static_cast<char*>(address.sun_path));
  return address;
}

// Returns the address as the general type that the socket calls take.
const sockaddr* general(const sockaddr_un& address) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  return reinterpret_cast<const sockaddr*>(&address);
}

// Returns true if a program listens at the address. A file without one is left over from a crash.
bool has_listener(const sockaddr_un& address, int type) {
  const hal::FileDescriptor probe(::socket(AF_UNIX, type | SOCK_CLOEXEC, 0));
  return probe.is_open() && ::connect(probe.get(), general(address), sizeof address) == 0;
}

}  // namespace

std::expected<void, ListenError> ListeningSocket::open(const char* path, const char* group) {
  return open(path, group, SOCK_STREAM);
}

std::expected<void, ListenError> ListeningSocket::open_datagrams(const char* path,
                                                                 const char* group) {
  return open(path, group, SOCK_DGRAM);
}

std::expected<void, ListenError> ListeningSocket::open(const char* path, const char* group,
                                                       int type) {
  const std::string_view name = path;
  if (name.empty() || name.size() >= path_.size()) {
    return listen_error("the socket's path is empty or longer than 107 characters", ENAMETOOLONG);
  }
  const sockaddr_un address = address_of(name);
  if (has_listener(address, type)) {
    return listen_error("another program listens there; end it, or give another --run-dir",
                        EADDRINUSE);
  }
  struct stat status{};
  if (::lstat(path, &status) == 0) {
    if (!S_ISSOCK(status.st_mode)) {
      return listen_error("there is a file in the socket's place; remove it", EEXIST);
    }
    // Nobody listens there any more: the file is left over from a program that was killed.
    ::unlink(path);
  }
  path_.fill('\0');
  std::ranges::copy(name, path_.begin());
  auto bound = bind_and_listen(group, type);
  if (!bound) {
    close();
  }
  return bound;
}

std::expected<void, ListenError> ListeningSocket::bind_and_listen(const char* group, int type) {
  socket_ = hal::FileDescriptor(::socket(AF_UNIX, type | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket_.is_open()) {
    path_.fill('\0');
    return listen_error("the system gives no socket", errno);
  }
  const sockaddr_un address = address_of(path_.data());
  const mode_t before = ::umask(kMaskFor0660);
  const bool is_bound = ::bind(socket_.get(), general(address), sizeof address) == 0;
  const int error = errno;
  ::umask(before);
  if (!is_bound) {
    path_.fill('\0');
    return listen_error("cannot make the socket's file; the folder has to be there and writable",
                        error);
  }
  if (group != nullptr && *group != '\0') {
    const struct group* const entry = ::getgrnam(group);
    if (entry == nullptr) {
      return listen_error("there is no such group; add it with groupadd --system", ENOENT);
    }
    if (::chown(path_.data(), static_cast<uid_t>(-1), entry->gr_gid) != 0) {
      return listen_error("the socket cannot be given to the group; run as root or as its member",
                          errno);
    }
  }
  if (type == SOCK_STREAM && ::listen(socket_.get(), kQueue) != 0) {
    return listen_error("nobody can connect to the socket", errno);
  }
  return {};
}

void ListeningSocket::close() {
  socket_.reset();
  remove_file();
}

void ListeningSocket::remove_file() {
  if (path_[0] != '\0') {
    ::unlink(path_.data());
    path_.fill('\0');
  }
}

hal::FileDescriptor ListeningSocket::accept() const {
  return hal::FileDescriptor(
      ::accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
}

}  // namespace tactus::firmware
