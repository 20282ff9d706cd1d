#include "host_tools/flash/emulator_bridge.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <span>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// The board's bytes come one by one; after the first some more are waited for.
constexpr timespec kGather{.tv_sec = 0, .tv_nsec = 300'000};

// A pipe. Our end does not wait.
struct BridgePipe {
  hal::FileDescriptor read_end;
  hal::FileDescriptor write_end;
};

BridgePipe make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw InputError(fmt::format("no pipe to the emulator: {}", std::strerror(errno)));
  }
  return {.read_end = hal::FileDescriptor(ends[0]), .write_end = hal::FileDescriptor(ends[1])};
}

void never_wait(const hal::FileDescriptor& descriptor) {
  ::fcntl(descriptor.get(), F_SETFL, O_NONBLOCK);
}

// Returns a socket that listens at the path. Throws InputError.
hal::FileDescriptor listen_at(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::ranges::copy(path, std::span(address.sun_path).begin());
  hal::FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  // The interface of sockets takes every address as the general one.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  const auto* const general = reinterpret_cast<const sockaddr*>(&address);
  if (!socket.is_open() || ::bind(socket.get(), general, sizeof address) != 0 ||
      ::listen(socket.get(), 4) != 0) {
    throw InputError(fmt::format("{}: no socket can be made: {}", path, std::strerror(errno)));
  }
  return socket;
}

// Becomes the emulator. It does not return.
[[noreturn]] void become(std::vector<std::string>& command, const sigset_t& signals, int input,
                         int output, int monitor) {
  constexpr int kNotStarted = 127;
  std::vector<char*> words;
  words.reserve(command.size() + 1);
  for (std::string& word : command) {
    words.push_back(word.data());
  }
  words.push_back(nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  ::dup2(input, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  if (monitor == kMonitorDescriptor) {
    ::fcntl(monitor, F_SETFD, 0);
  } else {
    ::dup2(monitor, kMonitorDescriptor);
  }
  ::execvp(words.front(), words.data());
  ::_exit(kNotStarted);
}

}  // namespace

bool EmulatorBridge::Waiting::read_from(int descriptor) {
  if (!is_empty()) {
    return true;
  }
  const ssize_t got = ::read(descriptor, room.data(), room.size());
  begin = 0;
  end = got > 0 ? static_cast<std::size_t>(got) : 0;
  return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
}

bool EmulatorBridge::Waiting::write_to(int descriptor) {
  if (is_empty()) {
    return true;
  }
  const ssize_t taken = ::write(descriptor, &room.at(begin), end - begin);
  if (taken > 0) {
    begin += static_cast<std::size_t>(taken);
  }
  return taken >= 0 || errno == EAGAIN || errno == EINTR;
}

EmulatorBridge::EmulatorBridge(std::string path, std::vector<std::string> command,
                               const sigset_t& signals)
    : path_(std::move(path)), command_(std::move(command)), signals_(signals) {
  socket_ = listen_at(path_);
  // A reader that is gone is then an error of the write.
  std::signal(SIGPIPE, SIG_IGN);
}

EmulatorBridge::~EmulatorBridge() {
  ::unlink(path_.c_str());
  if (emulator_ > 0) {
    ::kill(emulator_, SIGTERM);
    ::waitpid(emulator_, nullptr, 0);
  }
}

void EmulatorBridge::start_emulator() {
  BridgePipe to = make_pipe();
  BridgePipe from = make_pipe();
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw InputError(fmt::format("no socket to the emulator: {}", std::strerror(errno)));
  }
  hal::FileDescriptor ours(ends[0]);
  const hal::FileDescriptor monitor(ends[1]);
  emulator_ = ::fork();
  if (emulator_ < 0) {
    throw InputError(
        fmt::format("{}: cannot be started: {}", command_.front(), std::strerror(errno)));
  }
  if (emulator_ == 0) {
    become(command_, signals_, to.read_end.get(), from.write_end.get(), monitor.get());
  }
  to_board_ = std::move(to.write_end);
  from_board_ = std::move(from.read_end);
  never_wait(to_board_);
  never_wait(from_board_);
  pace_ = EmulatorPace(std::move(ours));
}

void EmulatorBridge::accept_program() {
  pollfd present{.fd = program_.get(), .events = POLLRDHUP, .revents = 0};
  if (program_.is_open() && ::poll(&present, 1, 0) > 0) {
    return;  // its last bytes go to the board before the next program comes
  }
  hal::FileDescriptor program(
      ::accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  // A line has one program; a second one finds it closed.
  if (!program.is_open() || program_.is_open()) {
    return;
  }
  // Its first bytes are there before the board runs.
  program_ = std::move(program);
  if (emulator_ == 0) {
    start_emulator();
  }
}

void EmulatorBridge::let_program_go() {
  program_.reset();
  for_board_.begin = for_board_.end = 0;
  for_program_.begin = for_program_.end = 0;
}

void EmulatorBridge::to_board() {
  if (!for_board_.read_from(program_.get())) {
    let_program_go();
  }
  for_board_.write_to(to_board_.get());
}

bool EmulatorBridge::from_board() {
  ::nanosleep(&kGather, nullptr);
  if (!for_program_.read_from(from_board_.get())) {
    return false;
  }
  // Without a program the bytes go nowhere, as on a line without a reader.
  if (!program_.is_open()) {
    for_program_.begin = for_program_.end;
  } else if (!for_program_.write_to(program_.get())) {
    let_program_go();
  }
  return true;
}

bool EmulatorBridge::turn(int asked_to_end) {
  const auto events = [](bool is_wanted, short event) {
    return static_cast<short>(is_wanted ? event : 0);
  };
  const auto program_events = static_cast<short>(events(for_board_.is_empty(), POLLIN) |
                                                 events(!for_program_.is_empty(), POLLOUT));
  std::array<pollfd, 6> files{{
      {.fd = asked_to_end, .events = POLLIN, .revents = 0},
      {.fd = socket_.get(), .events = POLLIN, .revents = 0},
      {.fd = program_.get(), .events = program_events, .revents = 0},
      {.fd = for_program_.is_empty() ? from_board_.get() : -1, .events = POLLIN, .revents = 0},
      {.fd = for_board_.is_empty() ? -1 : to_board_.get(), .events = POLLOUT, .revents = 0},
      {.fd = pace_.descriptor(), .events = POLLIN, .revents = 0},
  }};
  const hal::TimeNs latest_ns = hal::monotonic_now_ns() + hal::kNsPerSecond;
  hal::wait_for_descriptors(files,
                            emulator_ == 0 ? latest_ns : std::min(latest_ns, pace_.due_ns()));
  if (files[0].revents != 0) {
    is_asked_to_end_ = true;
    return false;
  }
  if (files[1].revents != 0) {
    accept_program();
  }
  if (emulator_ == 0) {
    return true;
  }
  pace_.turn(hal::monotonic_now_ns());
  if (program_.is_open() && (files[2].revents != 0 || files[4].revents != 0)) {
    to_board();
  }
  const bool has_output = files[3].revents != 0 || (files[2].revents & POLLOUT) != 0;
  return !has_output || from_board();
}

}  // namespace tactus::host
