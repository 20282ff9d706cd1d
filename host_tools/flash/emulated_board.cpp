#include "host_tools/flash/emulated_board.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "hal/linux/system.h"
#include "host_tools/flash/board_program.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kEmulator = "qemu-system-arm";
// The socket is looked for, and a signal waited for, so long at a time.
constexpr timespec kLook{.tv_sec = 0, .tv_nsec = 20'000'000};

// Returns a value of QEMU's options: a comma in it is written twice.
std::string option_value(const std::string& value) {
  std::string written;
  for (const char c : value) {
    written += c == ',' ? std::string(",,") : std::string(1, c);
  }
  return written;
}

void check_place(const EmulatedBoard& board) {
  constexpr std::size_t kLongestSocket = 107;
  if (find_tool(kEmulator).empty()) {
    throw InputError(
        fmt::format("{} is not installed: sudo apt install qemu-system-arm", kEmulator));
  }
  if (board.line.empty() || board.line.size() > kLongestSocket) {
    throw InputError(fmt::format("--line '{}': a socket's path has 1 to {} characters", board.line,
                                 kLongestSocket));
  }
  std::error_code error;
  if (std::filesystem::exists(std::filesystem::symlink_status(board.line, error))) {
    throw InputError(
        fmt::format("{}: it is there already: another emulator runs, or one has ended "
                    "badly; rm it, or give another --line",
                    board.line));
  }
}

// Starts a program that ends when this one does. Throws InputError if the system gives no process.
pid_t start(const std::vector<std::string>& command, const sigset_t& signals) {
  std::vector<char*> words;
  words.reserve(command.size() + 1);
  for (const std::string& word : command) {
    words.push_back(const_cast<char*>(word.c_str()));  // NOLINT(*-const-cast): execvp's type
  }
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) {
    throw InputError(
        fmt::format("{}: cannot be started: {}", command.front(), std::strerror(errno)));
  }
  if (child == 0) {
    constexpr int kNotStarted = 127;
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    ::execvp(words.front(), words.data());
    ::_exit(kNotStarted);
  }
  return child;
}

}  // namespace

std::vector<std::string> emulator_command(const EmulatedBoard& board) {
  return {kEmulator,
          "-M",
          board.machine,
          "-display",
          "none",
          "-monitor",
          "none",
          "-serial",
          fmt::format("unix:{},server=on,wait=on", option_value(board.line)),
          "-icount",
          "shift=1,sleep=on",
          "-kernel",
          board.program};
}

bool run_emulated_board(const EmulatedBoard& board, const std::function<void()>& ready) {
  check_board_program(board.program);
  check_place(board);
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) {
    ::sigaddset(&signals, signal);
  }
  const hal::SignalMask blocked(SIG_BLOCK, signals);
  const pid_t child = start(emulator_command(board), signals);
  bool is_ready = false;
  bool is_asked_to_end = false;
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (!is_ready && std::filesystem::is_socket(board.line)) {
      is_ready = true;
      ready();
    }
    const int signal = ::sigtimedwait(&signals, nullptr, &kLook);
    if (signal > 0 && signal != SIGCHLD) {
      is_asked_to_end = true;
      ::kill(child, SIGTERM);
    }
  }
  std::error_code error;
  if (is_ready) {
    std::filesystem::remove(board.line, error);
  }
  return is_asked_to_end;
}

}  // namespace tactus::host
