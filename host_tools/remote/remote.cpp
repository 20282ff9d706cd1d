#include "host_tools/remote/remote.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <grp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

namespace tactus::host {
namespace {

// Returns the name of the group that may use the socket, else its number, for the remedy.
std::string group_of(const std::string& path) {
  struct stat status{};
  if (::stat(path.c_str(), &status) != 0) {
    return "of its file";
  }
  const struct group* const group = ::getgrgid(status.st_gid);
  return group == nullptr ? fmt::format("{}", status.st_gid) : std::string(group->gr_name);
}

// Returns the reason for the user, and the command that mends it where there is one.
std::string remedy(const std::string& path, int error) {
  switch (error) {
    case ENOENT:
      return "no controller runs there; start tactusd, or tactus sim SCENE --serve, or give its "
             "--run-dir";
    case ECONNREFUSED:
      return "the program that listened there has ended; start tactusd again";
    case EACCES: {
      const std::string group = group_of(path);
      return fmt::format(
          "it is for the group {}; join it with: sudo usermod -aG {} $USER, and log in again",
          group, group);
    }
    default:
      return std::strerror(error);
  }
}

// Connects to a Unix socket; `type` is SOCK_STREAM or SOCK_DGRAM. Throws UnreachableError.
hal::FileDescriptor connect_to(const std::string& path, int type) {
  hal::FileDescriptor socket(::socket(AF_UNIX, type | SOCK_CLOEXEC, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::span<char> room(address.sun_path);
  if (path.size() >= room.size()) {
    throw UnreachableError(path + ": a socket's path has at most 107 characters");
  }
  std::ranges::copy(path, room.begin());
  // The interface of sockets takes every address as the general one.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  const auto* const general = reinterpret_cast<const sockaddr*>(&address);
  // Without a name of its own a datagram's sender gets no reply; the system chooses one.
  if (type == SOCK_DGRAM && ::bind(socket.get(), general, sizeof address.sun_family) != 0) {
    throw UnreachableError(fmt::format("{}: {}", path, std::strerror(errno)));
  }
  if (::connect(socket.get(), general, sizeof address) != 0) {
    throw UnreachableError(fmt::format("{}: {}", path, remedy(path, errno)));
  }
  return socket;
}

// Returns the number that is the whole text.
std::optional<std::size_t> number_of(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.begin(), text.end(), number);
  return error == std::errc{} && end == text.end() ? std::optional(number) : std::nullopt;
}

// Returns a sentence with the names in the folder of names.
std::string list_names(const std::filesystem::path& names) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(names)) {
    found.push_back(entry.path().filename().string());
  }
  std::ranges::sort(found);
  return found.empty() ? "no device has a name of its own"
                       : fmt::format("there are {}", fmt::join(found, ", "));
}

}  // namespace

std::filesystem::path run_folder_of(const std::filesystem::path& run_dir, std::size_t device) {
  return device == 1 ? run_dir : run_dir / std::to_string(device);
}

std::filesystem::path run_folder_of(const std::filesystem::path& run_dir,
                                    const std::string& device) {
  if (const std::optional<std::size_t> number = number_of(device)) {
    return run_folder_of(run_dir, *number);
  }
  const std::filesystem::path names = run_dir / kNamesFolder;
  std::error_code error;
  if (const auto target = std::filesystem::read_symlink(names / device, error); !error) {
    return (names / target).lexically_normal();
  }
  if (!std::filesystem::is_directory(names, error)) {
    const int reason = error ? error.value() : ENOENT;
    throw UnreachableError(
        fmt::format("{}: {}", run_dir.string(), remedy(run_dir.string(), reason)));
  }
  throw UnreachableError(fmt::format(
      "{}: no device is named \"{}\", or several are; {}, and --device takes a number, too",
      run_dir.string(), device, list_names(names)));
}

Remote::Remote(const std::filesystem::path& run_dir)
    : path_((run_dir / kCommandSocket).string()), socket_(connect_to(path_, SOCK_STREAM)) {}

void Remote::lost(std::string_view why) const {
  throw UnreachableError(fmt::format("{}: {}", path_, why));
}

Reply Remote::send(const std::string& line, std::chrono::milliseconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  const std::string bytes = line + '\n';
  if (::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(bytes.size())) {
    lost("the controller has ended");
  }
  Reply reply;
  for (;;) {
    std::string next = receive_line(deadline);
    if (next.starts_with("ok ") || next.starts_with("refused ")) {
      reply.is_ok = next.starts_with("ok ");
      reply.text = std::move(next);
      return reply;
    }
    reply.lines.push_back(std::move(next));
  }
}

// Returns the next line without its newline; bytes after it stay in `received_` for the next call.
std::string Remote::receive_line(std::chrono::steady_clock::time_point deadline) {
  for (;;) {
    if (const std::size_t end = received_.find('\n'); end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return line;
    }
    const auto left = deadline - std::chrono::steady_clock::now();
    const auto left_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(left).count();
    if (left_ns <= 0 || !hal::wait_readable(socket_.get(), hal::monotonic_now_ns() + left_ns)) {
      lost("no reply; is the controller's machine overloaded?");
    }
    std::array<char, 4096> buffer{};
    const ssize_t got = ::recv(socket_.get(), buffer.data(), buffer.size(), 0);
    if (got <= 0) {
      lost("the controller has ended");
    }
    received_.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

Reply send_stop(const std::filesystem::path& run_dir, std::chrono::milliseconds patience) {
  const std::string path = (run_dir / kStopSocket).string();
  const hal::FileDescriptor socket = connect_to(path, SOCK_DGRAM);
  constexpr std::string_view kStop = "estop";
  // A full queue is full of stops: the controller has this one all the same.
  if (::send(socket.get(), kStop.data(), kStop.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0 &&
      errno != EAGAIN) {
    throw UnreachableError(fmt::format("{}: {}", path, remedy(path, errno)));
  }
  const auto patience_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(patience).count();
  std::array<char, 1024> buffer{};
  ssize_t got = -1;
  if (hal::wait_readable(socket.get(), hal::monotonic_now_ns() + patience_ns)) {
    got = ::recv(socket.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  }
  if (got <= 0) {
    throw UnreachableError(path + ": no reply to the stop; cut the power of the motors");
  }
  Reply reply;
  reply.text = std::string(buffer.data(), static_cast<std::size_t>(got));
  reply.text.erase(reply.text.find_last_not_of('\n') + 1);
  reply.is_ok = reply.text.starts_with("ok ");
  return reply;
}

}  // namespace tactus::host
